// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "input.hpp"
#include "input_section.hpp"

/// Readers of the tables of an input file that describe supports, and when they are installed: the
/// keys with their dimensions and ranges, one line each. Defaults are in input.hpp.
namespace voussoir::program {

void read_bolts(Section& s, Input& input, BoltsInput& bolts);
void read_lining(Section& s, Input& input, LiningInput& lining);
/// After the supports, which it installs by their names.
/// @param is_round  in a table [[round]], which says what it excavates
void read_stage(Section& s, Input& input, StageInput& stage, bool is_round,
                const std::filesystem::path& directory);
void read_diagram(Section& s, DiagramInput& diagram);

}  // namespace voussoir::program
