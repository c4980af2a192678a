// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "input.hpp"
#include "input_section.hpp"

/// The tables of a model of blocks that are laid one by one: masonry, a dry wall, blocks on a
/// slope.
namespace voussoir::program {

/// Whether the file describes such a model: it has [[block]] or [blocks] file.
[[nodiscard]] bool has_laid_blocks(Section& file);

/// Reads blocks, loads and displacements into `input.laid`, and checks that they fit together.
/// Tables that speak of rock around a tunnel are refused.
/// @param directory  where `blocks.file` is relative to
void read_laid_blocks(Section& file, Input& input, const std::filesystem::path& directory);

}  // namespace voussoir::program
