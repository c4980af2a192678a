// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/detail/connected_parts.hpp>
#include <voussoir/rockmass/detail/thin_rock.hpp>
#include <voussoir/rockmass/opening_box.hpp>
#include <voussoir/rockmass/opening_checks.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/welding.hpp>

namespace voussoir {

namespace detail {

// What carving asks of an opening, in 2-D and 3-D: its outline piece by piece, and
// whether a piece runs through the inside of a block.

[[nodiscard]] inline Segment outline_piece(const SimplePolygon& opening, std::size_t k,
                                           const Domain<2>&) {
  return opening.edge(k);
}
[[nodiscard]] inline JointPlane outline_piece(const PrismaticOpening& opening, std::size_t k,
                                              const Domain<3>& domain) {
  return opening.side(k, largest_entry(larger_of(magnitudes(domain.low), magnitudes(domain.high))) +
                             domain.diameter() + length_of(opening.axis().origin()));
}
[[nodiscard]] inline HalfSpace<2> plane_of(const Segment& edge) {
  return left_of(edge.start, edge.end);
}
[[nodiscard]] inline const HalfSpace<3>& plane_of(const JointPlane& side) { return side.plane; }

/// True if the piece runs through the inside of the shape, further than `tolerance`.
[[nodiscard]] inline bool crosses(const ConvexPolygon& shape, const Segment& segment,
                                  double tolerance) {
  std::optional<Segment> inside = segment;
  for (std::size_t k = 0; inside && k < shape.size(); ++k)
    inside = split(*inside, shape.half_space(k), tolerance).below;
  return inside && inside->length() > tolerance;
}
[[nodiscard]] inline bool crosses(const ConvexPolyhedron& shape, const JointPlane& side,
                                  double tolerance) {
  std::optional<JointPlane> inside = side;
  for (std::size_t k = 0; inside && k < shape.size(); ++k)
    inside = split(std::move(*inside), shape.half_space(k), tolerance).below;
  return inside && inside->area() > tolerance * tolerance;
}

}  // namespace detail

/// Takes an opening out of the rock by slicing along its outline.
///
/// The pieces of a block that remain outside stay one rigid body as long as they touch each other;
/// where a block falls apart each connected group becomes a body of its own. Outline cuts do not
/// obey the block limits, so bodies at the wall smaller than `smallest` are dropped, and what is
/// left of larger ones as a skin between the wall and a joint along it, thinner than a tenth of the
/// side of a smallest body: they leave holes in the wall, which lie in `RockMass::dropped`.
/// New corners are welded with the corners nearby; bodies that no edge of the outline cuts stay as
/// they are, bit for bit. Of which body each is what is left: `RockMass::origins`.
///
/// @param smallest  area (2-D) or volume (3-D) below which a body at the wall is dropped [m^2],
///                  [m^3]
/// In 3-D the opening may leave the domain on any side, along its axis or with its section: an open
/// cut, or half a tunnel on a plane of symmetry.
///
/// @throws InvalidInput  see `check_opening` and `check_in_one_piece`; or nothing would be taken
///                       out, or be left
/// @throws Stopped
/// @cost  one bounding test per body; cuts near the outline only
///
/// Source: the clump variant of Boon's block generator (construction joints). Removing whole blocks
/// by their centroid leaves a ragged wall; making every piece a body leaves slivers that fall.
template <class Geometry>
[[nodiscard]] RockMass<Geometry> carve(RockMass<Geometry> mass,
                                       const typename Geometry::Opening& opening, double smallest,
                                       const Progress& progress = {}) {
  constexpr int dim = Geometry::dim;
  using Shape = typename Geometry::Shape;
  const Domain<dim>& domain = mass.domain;
  check_opening(opening, mass);
  const double tolerance = domain.tolerance(), removed_before = mass.carving.removed_measure;
  // So that whoever has a corner within the tolerance of a new one is looked at.
  const detail::OpeningBox box(opening, 2 * tolerance);
  std::vector<decltype(detail::outline_piece(opening, 0, domain))> outline;
  for (std::size_t e = 0; e < opening.size(); ++e)
    outline.push_back(detail::outline_piece(opening, e, domain));
  const detail::ThinRock<Geometry> thin_rock(opening, smallest, tolerance);
  CarvingReport& report = mass.carving;
  std::vector<Body<Geometry>> kept;
  kept.reserve(mass.bodies.size());
  mass.origins.clear();
  const auto keep = [&](Body<Geometry> body, std::size_t origin) {
    kept.push_back(std::move(body));
    mass.origins.push_back(static_cast<int>(origin));
  };
  std::vector<std::size_t> beside, cut;  // indices of kept bodies
  StopCheck stop(progress);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    Body<Geometry>& body = mass.bodies[b];
    stop();
    if (std::all_of(body.parts.begin(), body.parts.end(),
                    [&](const Shape& part) { return box.is_apart_from(part); })) {
      keep(std::move(body), b);
      continue;
    }
    std::vector<Shape> pieces, skin;
    bool is_cut = false;
    for (const Shape& part : body.parts) {
      std::vector<Shape> of_part{part};
      for (std::size_t e = 0; e < outline.size(); ++e) {
        const std::size_t count = of_part.size();
        for (std::size_t p = 0; p < count; ++p) {
          if (!detail::crosses(of_part[p], outline[e], tolerance)) continue;
          auto parts = of_part[p].split(detail::plane_of(outline[e]),
                                        static_cast<int>(mass.cuts.size()), tolerance);
          if (!parts) continue;
          mass.cuts.push_back({Cut::Kind::outline, static_cast<int>(e)});
          of_part[p] = std::move(parts->first);
          of_part.push_back(std::move(parts->second));
        }
      }
      const bool was_split = of_part.size() > 1;
      const std::size_t taken = std::erase_if(of_part, [&](const Shape& piece) {
        const MassProperties<dim> properties = mass_properties(piece);
        const bool inside = opening.contains(properties.centroid);
        if (inside) report.removed_measure += properties.measure;
        return inside;
      });
      if (was_split || taken > 0) {
        is_cut = true;
        for (Shape& piece : thin_rock.take_off(part, of_part, mass.cuts))
          skin.push_back(std::move(piece));
      }
      std::move(of_part.begin(), of_part.end(), std::back_inserter(pieces));
    }
    if (!is_cut) {
      beside.push_back(kept.size());
      keep(std::move(body), b);
      continue;
    }
    if (pieces.empty() && skin.empty()) {
      ++report.removed_bodies;
      continue;
    }
    ++report.cut_bodies;
    const auto drop = [&](Body<Geometry> rest) {
      ++report.dropped_pieces;
      report.dropped_measure += rest.properties.measure;
      mass.dropped.push_back(std::move(rest));
    };
    const auto body_of = [](std::vector<Shape> parts) {
      Body<Geometry> rest;
      rest.properties = mass_properties(parts);
      rest.parts = std::move(parts);
      return rest;
    };
    for (auto& group : detail::connected_groups(skin, mass.cuts, tolerance))
      drop(body_of(std::move(group)));
    auto groups = detail::connected_groups(pieces, mass.cuts, tolerance);
    if (groups.size() > 1) report.separated_bodies += groups.size() - 1;
    for (auto& group : groups) {
      Body<Geometry> rest = body_of(std::move(group));
      if (rest.properties.measure < smallest) {
        drop(std::move(rest));
      } else {
        cut.push_back(kept.size());
        keep(std::move(rest), b);
      }
    }
  }
  if (kept.empty()) throw InvalidInput("opening: no rock is left around it");
  detail::check_taken_out(opening, report.removed_measure - removed_before);
  VertexWelder<dim> welder(tolerance);
  for (const auto* bodies : {&beside, &cut})
    for (const std::size_t k : *bodies)
      for (Shape& part : kept[k].parts) part.move_vertices(welder);
  VOUSSOIR_ASSERT(mass.origins.size() == kept.size(), "every body has one that it comes from");
  mass.bodies = std::move(kept);
  mass.openings.push_back(opening);
  check_in_one_piece(mass);
  return mass;
}

}  // namespace voussoir
