// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/part_of.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/wall_outline.hpp>

namespace voussoir::detail {

/// Rock that a joint next to the outline leaves as a skin on the wall, on one block with the rock
/// beside it: a joint of nearly the direction of an edge, a little behind it.
///
/// Whether a skin is an arm of a block, a bridge between two halves of one, or a slab of its own is
/// a matter of where joints end beside the opening. It is dropped as the slab is, or a joint that
/// runs a micrometre behind the wall would hold up, and hold together, what one on the wall parts.
template <class Geometry>
class ThinRock {
 public:
  static constexpr int dim = Geometry::dim;
  using Shape = typename Geometry::Shape;
  using Opening = typename Geometry::Opening;

  /// Outlives none of its arguments.
  /// @param smallest  area or volume below which pieces at the wall are dropped [m^2], [m^3]
  ThinRock(const Opening& opening, double smallest, double tolerance)
      : outline_(opening), thickness_(skin_thickness(dim, smallest)), tolerance_(tolerance) {
    if constexpr (dim == 3) {
      const Vec3& along = opening.axis().along();
      const double origin = dot_product(along, opening.axis().origin());
      if (std::isfinite(opening.to())) ends_.push_back({along, origin + opening.to()});
      if (std::isfinite(opening.from())) ends_.push_back({-along, -origin - opening.from()});
    }
  }

  /// Takes the skin off.
  /// @param part    of a body, as it was before carving
  /// @param pieces  what is left of the part; fewer or smaller ones after
  /// @param cuts    those along the skin are added
  /// @return  what was taken off, piece by piece
  /// @cost    faces x outline edges; cuts where there is skin
  [[nodiscard]] std::vector<Shape> take_off(const Shape& part, std::vector<Shape>& pieces,
                                            std::vector<Cut>& cuts) const {
    std::vector<Shape> skin;
    if (!(thickness_ > tolerance_)) return skin;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const int cut = part.cut(k);
      if (cut < 0 || cuts[static_cast<std::size_t>(cut)].kind != Cut::Kind::joint) continue;
      for (std::size_t e = 0; e < outline_.size(); ++e)
        if (const auto region = between(part.half_space(k), e))
          take_off(*region, e, pieces, cuts, skin);
    }
    return skin;
  }

 private:
  using Region = std::vector<HalfSpace<dim>>;

  /// Tangent of the greatest angle at which a joint still runs along an edge.
  static constexpr double along_an_edge = 0.05;

  /// What is behind an edge and nearer to it than `thickness_` on a line towards the joint; none if
  /// the joint does not run along the edge, or runs too far behind it.
  [[nodiscard]] std::optional<Region> between(const HalfSpace<dim>& joint, std::size_t e) const {
    const HalfSpace<dim> edge = outline_.template in_space<dim>(outline_.within(e, 0));
    const double facing = dot_product(joint.normal, edge.normal);
    if (!(facing > 0)) return {};
    // From the edge to the joint it is (offset - normal x) / facing at a point x of the edge, and
    // this less slope x with x anywhere behind that point.
    const Vec<dim> slope = joint.normal / facing - edge.normal;
    const double tilt = length_of(slope);
    if (!(tilt < along_an_edge)) return {};
    const double limit = joint.offset / facing - edge.offset - thickness_;
    const double length = outline_.start(e + 1) - outline_.start(e);
    const HalfSpace<2> before = outline_.before(e, 0);
    Region region = ends_;
    region.push_back(outline_.template in_space<dim>(outline_.before(e, length)));
    region.push_back(outline_.template in_space<dim>({-before.normal, -before.offset}));
    if (tilt > 1e-9) {
      region.push_back({-slope / tilt, -limit / tilt});
    } else if (limit > 0) {
      return {};
    }
    return region;
  }

  void take_off(const Region& region, std::size_t e, std::vector<Shape>& pieces,
                std::vector<Cut>& cuts, std::vector<Shape>& skin) const {
    for (std::size_t p = 0; p < pieces.size();) {
      if (!has_skin(pieces[p], region, e)) {
        ++p;
        continue;
      }
      Shape inside = std::move(pieces[p]);
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(p));
      std::vector<Shape> rest;
      for (const HalfSpace<dim>& side : region)
        if (auto parts = inside.split(side, static_cast<int>(cuts.size()), tolerance_)) {
          cuts.push_back({Cut::Kind::outline, static_cast<int>(e)});
          inside = std::move(parts->first);
          rest.push_back(std::move(parts->second));
        }
      skin.push_back(std::move(inside));
      pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(p), rest.begin(), rest.end());
      p += rest.size();
    }
  }

  [[nodiscard]] bool has_skin(const Shape& piece, const Region& region, std::size_t e) const {
    std::optional<Shape> inside = piece;
    for (std::size_t k = 0; inside && k < region.size(); ++k)
      inside = part_of(*inside, region[k], tolerance_);
    if (!inside) return false;
    // On the far side of the opening, too, there is rock between the lines that bound an edge.
    const double depth =
        outline_.depth(e, outline_.in_section(Vec<dim>(mass_properties(*inside).centroid)));
    return depth > 0 && depth < thickness_;
  }

  WallOutline outline_;
  double thickness_;  ///< [m]
  double tolerance_;  ///< [m]
  Region ends_;       ///< of an opening in 3-D
};

}  // namespace voussoir::detail
