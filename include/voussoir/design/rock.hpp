// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/joint_sets.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/design/size_estimate.hpp>
#include <voussoir/geometry/joint_plane.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/mapped_slicing.hpp>
#include <voussoir/rockmass/mapped_traces.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/rockmass/trace_coverage.hpp>

/// The rock of an analysis: cut by the joints that were mapped and by random ones.
namespace voussoir::design {

/// Rock that is cut, and what became of the joints.
template <class Geometry>
struct JointedRock {
  RockMass<Geometry> mass;
  std::size_t mapped_joints = 0;       ///< that come first in `mass.joints`; random ones follow
  std::vector<MappedSet> mapped = {};  ///< of sets that have mapped joints
  std::size_t duplicates = 0;          ///< traces left out: a longer one runs along them
};

/// Half of what the smallest block measures from its middle, unless it is given: a bridge of rock
/// that is narrower holds no block [m].
[[nodiscard]] inline double snap_of(const AnalysisInput& input) {
  return input.mapped.snap.value_or(0.5 * input.blocks.min_inscribed_radius);
}

/// Slices the rock of a section: by mapped traces, then by the sets.
/// @throws InvalidInput  it comes to too many blocks
/// @throws Stopped       `progress` said so
[[nodiscard]] VOUSSOIR_DESIGN_INLINE JointedRock<Planar> rock_of(const AnalysisInput& input,
                                                                 const Progress& progress = {});
/// Slices the rock of an analysis in 3-D, by the sets alone.
/// @throws Stopped       `progress` said so
[[nodiscard]] VOUSSOIR_DESIGN_INLINE JointedRock<Spatial> spatial_rock_of(
    const AnalysisInput& input, const Progress& progress = {});

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// Pieces of traces in the domain: they are cut in a quarter of a minute.
inline constexpr std::size_t most_pieces = 200'000;

/// The random joints of a section; `Joint::set` by the sets of the input.
VOUSSOIR_DESIGN_INLINE std::vector<Joint> random_joints(const AnalysisInput& input,
                                                        const Domain<2>& domain,
                                                        const Progress& progress) {
  std::vector<JointSet> sets;
  std::vector<int> index;  // of a random set among those of the input
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& s = input.joint_sets[k];
    if (!s.is_random()) continue;
    const auto shown = section_set(s, input.tunnel);
    if (!shown) continue;  // it runs along the section
    sets.push_back(*shown);
    index.push_back(static_cast<int>(k));
  }
  auto random = joint_network(sets, domain, input.model.seed, progress);
  for (Joint& joint : random) joint.set = index[static_cast<std::size_t>(joint.set)];
  return random;
}

/// Mapped joints come first: what was seen takes precedence over what was drawn at random.
VOUSSOIR_DESIGN_INLINE JointedRock<Planar> rock_of_traces(const AnalysisInput& input,
                                                          const Domain<2>& domain,
                                                          const std::vector<Joint>& random,
                                                          const Progress& progress) {
  const BlockLimits limits{input.blocks.min_inscribed_radius, input.blocks.max_elongation};
  std::vector<Joint> all = straight_pieces(input.mapped.traces);
  std::size_t inside = 0;
  for (const Joint& piece : all) inside += inside_of(domain, piece.trace).has_value();
  all.insert(all.end(), random.begin(), random.end());
  const double blocks = estimated_blocks(all, domain, limits.min_inscribed_radius);
  if (blocks > largest_count || static_cast<double>(all.size()) > largest_count)
    throw InvalidInput(message(
        {"mapped and random joints: the rock has ", all.size(), " joints and would come to about ",
         std::round(blocks),
         " blocks\n   = accepted: at most 1000000 of either in the domain: a smaller domain, fewer "
         "joints, or a larger least inscribed radius of blocks"}));
  if (inside > most_pieces)
    throw InvalidInput(message(
        {"mapped joints: ", inside, " pieces of traces lie in the domain\n   = accepted: at most ",
         most_pieces, ": a smaller domain, or a map without traces shorter than blocks"}));
  const MappedRule rule{snap_of(input), input.mapped.dead_ends};
  const MappedJoints mapped = mapped_joints(input.mapped.traces, domain, rule, progress);
  std::vector<SimplePolygon> openings;
  for (std::size_t k = 0; k <= input.openings.size(); ++k)
    if (is_modelled(input, k)) openings.push_back(opening_in_section(input, k));
  MappedRock made = slice_mapped(domain, mapped, random, limits, openings, progress);
  JointedRock<Planar> rock;
  rock.mass = std::move(made.mass);
  rock.mapped_joints = rock.mass.joints.size() - random.size();
  rock.mapped = std::move(made.sets);
  rock.duplicates = mapped.duplicates;
  return rock;
}

[[nodiscard]] inline Domain<2> section_of(const Domain<3>& domain) {
  return {{domain.low.x(), domain.low.z()}, {domain.high.x(), domain.high.z()}};
}

/// A joint of the section that goes on along the tunnel without end.
VOUSSOIR_DESIGN_INLINE JointPlane along_the_tunnel(const Segment& trace, const JointSetInput& set,
                                                   const Domain<3>& domain) {
  const Vec2 centre = trace.centre(), half = 0.5 * (trace.end - trace.start);
  const Vec3 middle(centre.x(), 0.5 * (domain.low.y() + domain.high.y()), centre.y()),
      down(half.x(), 0, half.y());
  const Vec2 across = normalized(perpendicular(half));
  if (std::isinf(set.extent)) return unbounded_joint(middle, Vec3(across.x(), 0, across.y()));
  return joint_rectangle(middle, down, Vec3(0, domain.size().y(), 0));
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE JointedRock<Planar> rock_of(const AnalysisInput& input,
                                                   const Progress& progress) {
  const Domain<2> domain = section_domain(input);
  const std::vector<Joint> random = detail::random_joints(input, domain, progress);
  if (!input.mapped.traces.empty()) return detail::rock_of_traces(input, domain, random, progress);
  JointedRock<Planar> rock;
  rock.mass = slice(domain, random,
                    {input.blocks.min_inscribed_radius, input.blocks.max_elongation}, progress);
  return rock;
}

VOUSSOIR_DESIGN_INLINE JointedRock<Spatial> spatial_rock_of(const AnalysisInput& input,
                                                            const Progress& progress) {
  const Domain<3> domain = spatial_domain(input);
  const Domain<2> section = detail::section_of(domain);
  std::vector<SpatialJoint> joints;
  int index = 0;  // among the random sets, as in the section
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& set = input.joint_sets[k];
    if (!set.is_random()) continue;
    const auto add = [&](JointPlane trace) {
      joints.push_back({std::move(trace), static_cast<int>(k)});
    };
    if (is_of_section(input, set))
      for (const Joint& joint :
           generate(*section_set(set, input.tunnel), index, section, input.model.seed, progress))
        add(detail::along_the_tunnel(joint.trace, set, domain));
    else
      for (SpatialJoint& joint :
           generate(spatial_set(set, input.tunnel), index, domain, input.model.seed, progress))
        add(std::move(joint.trace));
    ++index;
  }
  // One random order, that of the section where all sets are of it: see `joint_network`.
  Random(input.model.seed, 0).shuffle(joints);
  JointedRock<Spatial> rock;
  rock.mass = slice<Spatial>(
      domain, joints, {input.blocks.min_inscribed_radius, input.blocks.max_elongation}, progress);
  return rock;
}

#endif

}  // namespace voussoir::design
