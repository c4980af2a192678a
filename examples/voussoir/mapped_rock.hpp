// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>
#include <voussoir/core/progress.hpp>
#include <voussoir/rockmass/mapped_slicing.hpp>

#include "analysis.hpp"
#include "input.hpp"

/// Rock with the mapped joints of `joints.file`.
namespace voussoir::program {

/// Reads the file of traces. What is to be said of it goes into `rock`.
/// @throws InvalidInput  it cannot be read, or none of its traces reaches the domain
[[nodiscard]] std::vector<MappedTrace> read_mapped_traces(const Input& input,
                                                          const Domain<2>& domain,
                                                          const Progress& progress,
                                                          GeneratedRock& rock);

/// Slices by traces, then by random joints: fills `rock`, with a source for every set that was
/// mapped.
void slice_by_traces(const Input& input, const Domain<2>& domain, std::vector<MappedTrace> traces,
                     const std::vector<Joint>& random, const Progress& progress,
                     GeneratedRock& rock);

/// "bedding", of the set with an index; "no set" of -1.
[[nodiscard]] std::string set_name(const Input& input, int set);

/// "3 traces".
[[nodiscard]] std::string counted(std::size_t count, const std::string& what);

}  // namespace voussoir::program
