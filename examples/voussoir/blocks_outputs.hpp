// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "blocks_analysis.hpp"

/// What the program writes of laid blocks: tables, JSON and a picture, units in every name.
namespace voussoir::program {

[[nodiscard]] std::string blocks_run_json(const Input& input, const BlocksRun& run);
/// One row per block: where it has moved.
[[nodiscard]] std::string blocks_csv(const Input& input, const BlocksRun& run);
/// One row per contact: its forces, and where they act.
[[nodiscard]] std::string contacts_csv(const Input& input, const BlocksRun& run);
/// The blocks with the forces between them.
[[nodiscard]] std::string laid_blocks_svg(const Input& input, const BlocksRun& run);
/// The results in a few lines for a terminal.
[[nodiscard]] std::string blocks_summary(const Input& input, const BlocksRun& run);

}  // namespace voussoir::program
