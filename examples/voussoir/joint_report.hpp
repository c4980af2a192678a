// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/rockmass/mapped_slicing.hpp>
#include <voussoir/rockmass/slicing.hpp>

#include "input.hpp"

/// What became of the joints that were asked for, in 2-D and 3-D.
namespace voussoir::program {

/// What became of the joints of one source: random ones of a set, or those of a set that were
/// mapped. And what the set is made of.
struct JointSource {
  std::string name;
  std::size_t asked = 0;    ///< joints
  std::size_t used = 0;     ///< that cut a block
  std::size_t outside = 0;  ///< that do not reach the domain
  std::size_t refused = 0;  ///< for parts too small or too long, or where a joint was already
  JointLawInput law = {};   ///< mechanics taken
  std::optional<MappedSet> mapped = {};  ///< none: they are random
};

/// What the maker of the rock must be told about it.
struct DescribedRock {
  std::vector<JointSource> joints = {};
  std::vector<std::string> warnings = {};
  std::string joints_read =
      {};  ///< how the file of traces was read, in words; empty: there is none
  std::vector<std::string> in_section = {};  ///< how sets by azimuth show there, a line each
};

/// No result without its rock: joints asked for and not used are said.
/// @throws InvalidInput  no joint cuts the rock
void check_slicing(const Input& input, const SlicingReport& slicing,
                   std::vector<std::string>& warnings);

/// Adds what became of the random joints of every set, after `mapped` others.
/// @param set_of  of every joint the index of its set
/// @throws InvalidInput  none of one set is used
void add_random_sources(const Input& input, std::size_t mapped, const std::vector<int>& set_of,
                        const SlicingReport& slicing, std::vector<JointSource>& sources,
                        std::vector<std::string>& warnings);

}  // namespace voussoir::program
