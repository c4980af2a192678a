// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/section_check.hpp>

/// Whether a layer of shotcrete holds a single block at the wall.
///
/// Source: Barrett & McCreath (1995), Shotcrete support design in blocky ground: towards a
/// deterministic approach, Tunn. Undergr. Space Technol. 10(1), 79-89: the four ways in which it
/// fails and their order. Strengths and the shapes of what bends are those stated here.
namespace voussoir::design {

/// Shotcrete on rock.
struct ShotcreteLayer {
  ConcreteSection section;       ///< 1 m wide
  double adhesion = 0;           ///< to the rock, characteristic [Pa], > 0
  double adhesion_width = 0.03;  ///< of the strip along the edge of a block that peels [m], > 0
};

/// Of what a layer would fail first.
enum class ShotcreteMode { adhesion, direct_shear, flexure, punching };
[[nodiscard]] inline const char* to_string(ShotcreteMode mode) {
  constexpr const char* words[] = {"adhesion", "direct shear", "flexure", "punching"};
  return words[static_cast<std::size_t>(mode)];
}

/// Loads of a block that each way bears, in 2-D per metre of tunnel [N/m], in 3-D [N].
struct ShotcreteCapacity {
  double adhesion = 0;      ///< around the edge of the block, as long as the layer sticks
  double direct_shear = 0;  ///< through the layer along that edge
  double flexure = 0;       ///< of the layer once it has come off: it spans the block
  double punching = std::numeric_limits<double>::infinity();  ///< at plates; infinite: not asked

  /// A layer that sticks fails in shear or peels; one that has peeled bends and is punched, and
  /// holds on if that bears more. Shear is asked of either.
  [[nodiscard]] double value() const {
    return std::min(direct_shear, std::max(adhesion, std::min(flexure, punching)));
  }
  [[nodiscard]] ShotcreteMode mode() const {
    const double peeled = std::min(flexure, punching);
    if (direct_shear <= std::max(adhesion, peeled)) return ShotcreteMode::direct_shear;
    if (adhesion >= peeled) return ShotcreteMode::adhesion;
    return flexure <= punching ? ShotcreteMode::flexure : ShotcreteMode::punching;
  }
};

/// Moment that a layer bears without thrust, the inner face in tension [N m/m]: as it cracks, f_ctd
/// t^2 / 6, or what bars or fibres bear after that.
[[nodiscard]] inline double bending_resistance(const ConcreteSection& section) {
  const double cracking =
      section.design_tension() * section.width * section.thickness * section.thickness / 6;
  return std::max(cracking, 1 / SectionCapacity(section).utilisation({0, -1}).value);
}

/// Of a layer whose bending is known.
/// @param edge     of the block, along which the layer peels or is sheared [m], in 2-D [m/m]
[[nodiscard]] inline ShotcreteCapacity shotcrete_capacity(const ShotcreteLayer& layer, double edge,
                                                          double flexure) {
  require(layer.adhesion > 0, "adhesion of shotcrete", layer.adhesion, "> 0 Pa");
  require(layer.adhesion_width > 0, "width of adhesion", layer.adhesion_width, "> 0 m");
  require(layer.section.width == 1, "width of a layer of shotcrete", layer.section.width, "1 m");
  return {edge * layer.adhesion_width * layer.adhesion / layer.section.partial_factor,
          edge * shear_resistance(layer.section, {}), flexure};
}

/// A block as long as the tunnel: two edges, and a strip from one to the other that carries an even
/// load, simply supported, 8 m_R / span.
/// @param span  from edge to edge [m], > 0
/// @throws InvalidInput
[[nodiscard]] inline ShotcreteCapacity shotcrete_over_strip(const ShotcreteLayer& layer,
                                                            double span) {
  require(span > 0, "span of shotcrete", span, "> 0 m");
  return shotcrete_capacity(layer, 2, 8 * bending_resistance(layer.section) / span);
}

/// A block with a face in the wall. Of all faces of that area a circle has the shortest edge, 2
/// sqrt(pi A). It bends as a circular plate, elastic, simply supported, under an even load: 16 pi
/// m_R / (3 + nu) = 15.7 m_R with nu = 0.2, whatever its size; a square bears 22.6 m_R.
/// @param area  of the face [m^2], > 0
/// @throws InvalidInput
[[nodiscard]] inline ShotcreteCapacity shotcrete_over_face(const ShotcreteLayer& layer,
                                                           double area) {
  require(area > 0, "face of a block", area, "> 0 m2");
  return shotcrete_capacity(layer, 2 * std::sqrt(std::numbers::pi * area),
                            16 * std::numbers::pi / 3.2 * bending_resistance(layer.section));
}

/// What the plate of one bolt bears of a layer that hangs on it [N]: the shear strength of the
/// layer along a perimeter half its thickness from a square plate, 4 (c + t).
/// @param section  of the layer, 1 m wide
/// @param plate    c, its width [m], > 0
[[nodiscard]] inline double punching_resistance(const ConcreteSection& section, double plate) {
  require(plate > 0, "width of a plate", plate, "> 0 m");
  return 4 * (plate + section.thickness) * shear_resistance(section, {});
}

/// Whether a lining lies at an angle about the centre of its opening [rad], 0 to 2 pi.
[[nodiscard]] inline bool covers(const LiningInput& lining, double angle) {
  if (!lining.arc) return true;
  constexpr double turn = 2 * std::numbers::pi;
  const double from_start = angle - lining.arc->from;
  return from_start - turn * std::floor(from_start / turn) <= lining.arc->to - lining.arc->from;
}

/// The shotcrete of a lining, per metre, as old as when it is first loaded.
/// @pre  its concrete is given
[[nodiscard]] inline ConcreteSection shotcrete_of(const LiningInput& lining, double thickness) {
  ConcreteSection section = *lining.concrete;
  if (lining.age) section = lining.age->aged(std::move(section), lining.age->when_loaded);
  section.thickness = thickness;
  section.width = 1;
  return section;
}

/// What a block at the wall takes of the shotcrete over it.
struct ShotcreteUse {
  double value = 0;  ///< [-]
  ShotcreteMode mode = ShotcreteMode::adhesion;
};

/// Of the first lining of the tunnel over it whose concrete and adhesion are given; none: there is
/// no such lining. Plates are not asked.
/// @param angle         of its face at the centre, from the right-hand springing [rad], 0 to 2 pi
/// @param load          in 2-D [N/m], in 3-D [N]
/// @param free_measure  of its face [m], [m^2]
[[nodiscard]] inline std::optional<ShotcreteUse> shotcrete_use(const AnalysisInput& input,
                                                               double angle, double load,
                                                               double free_measure) {
  for (const LiningInput& lining : input.linings) {
    if (lining.opening != 0 || !lining.concrete || !lining.adhesion || !covers(lining, angle))
      continue;
    const ShotcreteLayer layer{shotcrete_of(lining, lining.thickness), *lining.adhesion,
                               lining.adhesion_width};
    const ShotcreteCapacity capacity = input.is_spatial()
                                           ? shotcrete_over_face(layer, free_measure)
                                           : shotcrete_over_strip(layer, free_measure);
    return ShotcreteUse{std::max(0.0, load) / capacity.value(), capacity.mode()};
  }
  return std::nullopt;
}

}  // namespace voussoir::design
