// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "case_outputs.hpp"

/// A sweep: its tables, a table for the screen and a picture.
namespace voussoir::program {

/// A varied key as a column: its values as numbers with the unit in the name, where all have one
/// unit.
struct KeyColumn {
  std::string name;
  std::vector<std::string> cells;
  std::string unit = {};
  bool is_number = false;
};
[[nodiscard]] KeyColumn column_of(const VariedKey& varied);
/// "_GPa_per_m" of "GPa/m".
[[nodiscard]] std::string unit_suffix(const std::string& unit);
/// The cells of a combination of varied keys.
[[nodiscard]] std::vector<std::string> key_cells(const std::vector<KeyColumn>& columns,
                                                 std::size_t combination);

/// @param results  of all cases, in the order of the plan
[[nodiscard]] CaseOutputs sweep_outputs(const CasePlan& plan,
                                        const std::vector<TunnelResult>& results);

}  // namespace voussoir::program
