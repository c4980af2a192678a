// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace voussoir_bench {

/// Counts over a table of cases that were also followed by the varied reference
/// (all_blocks_in_motion.hpp), printed on the error stream.
///
/// *Decided* is a case in which all variations that were followed have one verdict and, where rock
/// falls and the rest stands, areas within a tenth of the largest; the others are marginal by the
/// reference. The *agreement* of a procedure is told on those that are decided, by the same
/// measure. *Hit rate*: those of the marginal cases that the run itself calls so. *False alarms*:
/// those of the decided ones that it does.
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
