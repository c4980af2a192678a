// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>
#include <voussoir/core/progress.hpp>
#include <voussoir/design/rock.hpp>
#include <voussoir/rockmass/mapped_slicing.hpp>

#include "input.hpp"
#include "joint_report.hpp"

/// Rock with the mapped joints of `joints.file`.
namespace voussoir::program {

/// Reads the file of traces. What is to be said of it goes into `rock`.
/// @throws InvalidInput  it cannot be read, or none of its traces reaches the domain
[[nodiscard]] std::vector<MappedTrace> read_mapped_traces(const Input& input,
                                                          const Domain<2>& domain,
                                                          const Progress& progress,
                                                          DescribedRock& rock);

/// What became of the mapped joints: a source for every set that has some, and what is to be said.
void report_mapped(const Input& input, const JointedRock<Planar>& made, DescribedRock& rock);

/// "bedding", of the set with an index; "no set" of -1.
[[nodiscard]] std::string set_name(const Input& input, int set);

/// "3 traces".
[[nodiscard]] std::string counted(std::size_t count, const std::string& what);

}  // namespace voussoir::program
