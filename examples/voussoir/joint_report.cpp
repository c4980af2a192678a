// SPDX-License-Identifier: MIT
#include "joint_report.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <voussoir/core/units.hpp>
#include <voussoir/design/joint_sets.hpp>

#include "joint_laws.hpp"
#include "mapped_rock.hpp"

namespace voussoir::program {

namespace {

std::string number(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// A set that runs along the section.
bool is_left_out(const Input& input, std::size_t set) {
  return !input.is_spatial() && !section_set(input.joint_sets[set], input.tunnel);
}

/// What became of the joints: how often one went into a block, and why a cut was not made.
std::string slicing_text(const SlicingReport& slicing, const Input& input) {
  std::string text = counted(slicing.joints, "joint") + ", of which " +
                     std::to_string(slicing.joints - slicing.outside_joints) +
                     " reach into the domain: " + counted(slicing.cuts, "cut") + " made, " +
                     std::to_string(slicing.refused_too_small) +
                     " refused for a part smaller than blocks.min_inscribed_radius = " +
                     format_quantity(input.blocks.min_inscribed_radius, dimension::length) + ", " +
                     std::to_string(slicing.refused_too_long) + " for a part longer than " +
                     "blocks.max_elongation = " + number(input.blocks.max_elongation);
  if (slicing.coincident > 0)
    text += ", " + std::to_string(slicing.coincident) + " merged with an existing joint";
  return text;
}

}  // namespace

void check_slicing(const Input& input, const SlicingReport& slicing,
                   std::vector<std::string>& warnings) {
  const bool asked = !input.joint_sets.empty() || !input.joints_file.empty();
  if (!asked) return;
  const std::string text = slicing_text(slicing, input);
  if (slicing.joints == slicing.outside_joints) {
    warnings.push_back("the rock is one block without joints, though there are joint sets: " +
                       text);
  } else if (slicing.cuts == 0 && input.joints_file.empty()) {
    // Traces may all end in whole rock: what of them cuts nothing is said with its metres.
    throw InvalidInput("no joint cuts the rock, which stays one block: " + text +
                       "\n   = accepted: limits in [blocks] that let joints cut");
  } else if (2 * slicing.refused_too_long > slicing.offered_cuts() ||
             50 * slicing.cuts < slicing.offered_cuts()) {
    // Far more cuts than blocks are refused for size in any dense network: that is its saturation.
    warnings.push_back("most joints leave no trace in the rock: " + text);
  }
  if (slicing.blocks_too_long > 0)
    warnings.push_back(
        counted(slicing.blocks_too_long, "block") + " longer than blocks.max_elongation = " +
        number(input.blocks.max_elongation) + ", as the domain is: no joint cut them shorter");
}

void add_random_sources(const Input& input, std::size_t mapped, const std::vector<int>& set_of,
                        const SlicingReport& slicing, std::vector<JointSource>& all,
                        std::vector<std::string>& warnings) {
  std::vector<JointSource> sources;
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    sources.push_back({input.joint_sets[k].name});
    sources.back().law = law_of_set(input, static_cast<int>(k));
  }
  for (std::size_t k = mapped; k < set_of.size(); ++k) {
    JointSource& source = sources[static_cast<std::size_t>(set_of[k])];
    const JointFate fate = slicing.fates[k];
    ++source.asked;
    source.used += fate == JointFate::used;
    source.outside += fate == JointFate::outside;
    source.refused += fate == JointFate::refused;
  }
  for (const JointSource& source : sources)
    if (source.asked > 0 && source.used == 0 && source.refused > 0)
      throw InvalidInput(source.name + ": none of its " + counted(source.asked, "joint") +
                         " cuts the rock: " + std::to_string(source.outside) +
                         " outside the domain, " + std::to_string(source.refused) +
                         " refused for parts too small or too long, or where a joint was already" +
                         "\n   = accepted: limits in [blocks] that let them cut, or a source of "
                         "joints that are not there yet");
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const bool is_mapped = std::any_of(all.begin(), all.end(), [&](const JointSource& source) {
      return source.mapped && source.mapped->set == static_cast<int>(k);
    });
    if (input.joint_sets[k].is_random() && !is_left_out(input, k))
      all.push_back(std::move(sources[k]));
    else if (!input.joint_sets[k].is_random() && !is_mapped)
      warnings.push_back("joint_set[" + std::to_string(k) + "] " + sources[k].name +
                         " has no joint: no trace of joints.file names it, and none of "
                         "intensity, spacing, P32 and P30");
  }
}

}  // namespace voussoir::program
