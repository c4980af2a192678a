// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/rockmass/trace_in_section.hpp>

/// The joint sets of an input as the rock is cut by them: planes, or their traces in the section.
namespace voussoir::design {

/// Closer to the section than this its traces would be anywhere [rad]: 5 degrees.
inline constexpr double least_angle_to_section = 0.0872664625997165;

/// Area of joints per volume [1/m]. @pre the set is random
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double p32_of(const JointSetInput& set,
                                                   const TunnelInput& tunnel);
/// Of the discs whose traces have the extent of the set in the mean, or down the dip of
/// rectangles [m].
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double mean_extent(const JointSetInput& set);

/// The traces of a set in the section; none where it runs along the section within
/// `least_angle_to_section`.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<JointSet> section_set(const JointSetInput& set,
                                                                         const TunnelInput& tunnel);
/// How a set that was given by azimuth shows in the section, a line; empty for others.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string section_text(const JointSetInput& set,
                                                              const TunnelInput& tunnel);

/// Whether a set is drawn in the section alone, "E" or "W" without a tunnel.trend: in 3-D its
/// joints go on along the tunnel, and one file is one rock in both.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE bool is_of_section(const AnalysisInput& input,
                                                        const JointSetInput& set);

/// The planes of a set, their azimuths counted from the tunnel, which runs to the North of the
/// model.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SpatialJointSet spatial_set(const JointSetInput& set,
                                                                 const TunnelInput& tunnel);

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

VOUSSOIR_DESIGN_INLINE TraceInSection trace_of(const JointSetInput& set,
                                               const TunnelInput& tunnel) {
  return trace_in_section(set.plane, tunnel.trend.value_or(0), tunnel.plunge);
}

/// Standard deviation of the dip of the traces, to first order [rad].
VOUSSOIR_DESIGN_INLINE double trace_deviation(const JointSetInput& set, const TunnelInput& tunnel,
                                              const TraceInSection& trace) {
  // The normals of Fisher's distribution stray by 1 / sqrt(K) to either side.
  if (set.fisher)
    return std::min(1 / (std::sqrt(*set.fisher) * trace.sine), 0.25 * std::numbers::pi);
  if (trace.sine == 1) return set.sd;
  const double across =
      std::abs(elementary::sine(set.plane.dip_direction - tunnel.trend.value_or(0)));
  return std::min(set.sd * across / (trace.sine * trace.sine), 0.25 * std::numbers::pi);
}

/// Of the part of their planes that is parted: as if all of each were, so far apart [m].
VOUSSOIR_DESIGN_INLINE double parted_spacing(const JointSetInput& set) {
  return *set.spacing / set.persistence.value_or(1);
}

/// As it is given, or by the number of joints and the mean area of one [1/m].
VOUSSOIR_DESIGN_INLINE std::optional<double> given_p32(const JointSetInput& set) {
  if (set.p32 || !set.p30) return set.p32;
  const double across = mean_extent(set);
  return *set.p30 * (set.strike_extent ? set.extent * *set.strike_extent
                                       : 0.25 * std::numbers::pi * across * across);
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE double mean_extent(const JointSetInput& set) {
  // The traces of discs on planes at random through them are pi/4 of the diameter in the mean.
  return set.strike_extent ? set.extent : set.extent * 4 / std::numbers::pi;
}

VOUSSOIR_DESIGN_INLINE double p32_of(const JointSetInput& set, const TunnelInput& tunnel) {
  if (const auto given = detail::given_p32(set)) return *given;
  if (set.spacing) return 1 / detail::parted_spacing(set);
  return set.intensity.value_or(0) * set.extent / detail::trace_of(set, tunnel).sine;
}

VOUSSOIR_DESIGN_INLINE std::optional<JointSet> section_set(const JointSetInput& set,
                                                           const TunnelInput& tunnel) {
  const TraceInSection trace = detail::trace_of(set, tunnel);
  if (trace.sine < elementary::sine(least_angle_to_section)) return std::nullopt;
  JointSet shown{set.name, trace.dip, trace.direction, detail::trace_deviation(set, tunnel, trace)};
  shown.extent = set.extent;
  shown.spacing_law = set.spacing_law;
  if (set.spacing_sd) shown.spacing_deviation = *set.spacing_sd / *set.spacing;
  if (set.intensity)
    shown.intensity = *set.intensity;
  else if (set.spacing)
    shown.spacing = detail::parted_spacing(set) / trace.sine;
  else if (std::isinf(set.extent))
    shown.spacing = 1 / (p32_of(set, tunnel) * trace.sine);
  else
    shown.intensity = p32_of(set, tunnel) * trace.sine / set.extent;
  return shown;
}

VOUSSOIR_DESIGN_INLINE std::string section_text(const JointSetInput& set,
                                                const TunnelInput& tunnel) {
  const auto degrees = [](double angle) {
    return significant_text(angle * 180 / std::numbers::pi, 3) + " deg";
  };
  if (!set.is_random()) return "";
  const auto shown = section_set(set, tunnel);
  if (!shown)
    return set.name + ": runs along the section, within " + degrees(least_angle_to_section) +
           ": it has no traces there, and is left out";
  const TraceInSection trace = detail::trace_of(set, tunnel);
  if (trace.sine == 1) return "";
  std::string text = set.name + ": dip " + degrees(set.plane.dip) + " towards " +
                     degrees(set.plane.dip_direction) + " is an apparent dip of " +
                     degrees(shown->dip) + " to the " +
                     (shown->dip_direction == DipDirection::east ? "right" : "left");
  if (shown->spacing > 0) text += ", joints " + significant_text(shown->spacing, 3) + " m apart";
  return text + " in the section";
}

VOUSSOIR_DESIGN_INLINE bool is_of_section(const AnalysisInput& input, const JointSetInput& set) {
  return !set.is_azimuth && !input.tunnel.trend;
}

VOUSSOIR_DESIGN_INLINE SpatialJointSet spatial_set(const JointSetInput& set,
                                                   const TunnelInput& tunnel) {
  double towards = set.plane.dip_direction - tunnel.trend.value_or(0);
  if (towards < 0) towards += 2 * std::numbers::pi;
  SpatialJointSet made{set.name, set.plane.dip, towards};
  if (set.fisher)
    made.fisher_concentration = *set.fisher;
  else
    made.dip_deviation = set.sd;
  made.spacing_law = set.spacing_law;
  if (set.spacing_sd) made.spacing_deviation = *set.spacing_sd / *set.spacing;
  if (set.spacing)
    made.spacing = detail::parted_spacing(set);
  else
    made.area_per_volume = p32_of(set, tunnel);
  if (std::isfinite(set.extent)) {
    if (set.strike_extent)
      made.shape = RectangularJoints{*set.strike_extent, set.extent};
    else
      made.shape = DiscJoints{mean_extent(set)};
  }
  return made;
}

#endif

}  // namespace voussoir::design
