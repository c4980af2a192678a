// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "input.hpp"

/// The joint sets of an input as the rock is cut by them: planes, or their traces in the section.
namespace voussoir::program {

/// Closer to the section than this its traces would be anywhere [rad]: 5 degrees.
inline constexpr double least_angle_to_section = 0.0872664625997165;

/// Area of joints per volume [1/m]. @pre the set is random
[[nodiscard]] double p32_of(const JointSetInput& set, const TunnelInput& tunnel);
/// Of the discs whose traces have the extent of the set in the mean, or down the dip of
/// rectangles [m].
[[nodiscard]] double mean_extent(const JointSetInput& set);

/// The traces of a set in the section; none where it runs along the section within
/// `least_angle_to_section`.
[[nodiscard]] std::optional<JointSet> section_set(const JointSetInput& set,
                                                  const TunnelInput& tunnel);
/// How a set that was given by azimuth shows in the section, a line; empty for others.
[[nodiscard]] std::string section_text(const JointSetInput& set, const TunnelInput& tunnel);

/// Whether a set is drawn in the section alone, "E" or "W" without a tunnel.trend: in 3-D its
/// joints go on along the tunnel, and one file is one rock in both.
[[nodiscard]] bool is_of_section(const Input& input, const JointSetInput& set);

/// The planes of a set, their azimuths counted from the tunnel, which runs to the North of the
/// model.
[[nodiscard]] SpatialJointSet spatial_set(const JointSetInput& set, const TunnelInput& tunnel);

}  // namespace voussoir::program
