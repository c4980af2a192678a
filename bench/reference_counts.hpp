// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace voussoir_bench {

/// Counts over a table of cases that were also followed by the varied reference
/// (all_blocks_in_motion.hpp), printed on the error stream.
///
///   decided    all variations that were followed have one verdict and, where rock falls and the
///   rest stands, areas
///              within a tenth of the largest; else the case is marginal by the reference
///   agreement  of each procedure with the reference, on those that are decided, by the same
///   measure hit rate   of the marginal cases, those that the run itself calls marginal false
///   alarms  of the decided ones, those that it does
///
/// @param lines       of a CSV table, the head first; others like it are passed over, so that
///                    pieces can be put together with `cat`. Of each procedure and variation a
///                    column of its name has the verdict, NAME_m2 the fallen area; `marginal` is 1
///                    where the run says so
/// @param procedures  their names
/// @throws voussoir::InvalidInput  a column is missing; a row is not as long as the head
void print_counts(const std::vector<std::string>& lines,
                  const std::vector<std::string>& procedures);

/// The lines of a file, or of several, one after the other.
/// @throws voussoir::InvalidInput  it cannot be read
[[nodiscard]] std::vector<std::string> lines_of(const std::vector<std::string>& files);

}  // namespace voussoir_bench
