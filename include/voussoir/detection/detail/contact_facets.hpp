// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>
#include <voussoir/detection/contact_search.hpp>
#include <voussoir/geometry/contact_facet.hpp>
#include <voussoir/geometry/cut_facing.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>

namespace voussoir::detail {

/// A detector whose `contact` has no area, with that of its `facing_contact` instead.
template <class Detector>
struct ByFacing {
  using role = typename Detector::role;

  template <int Dim>
  class Pair : public Detector::template Pair<Dim> {
   public:
    using Base = typename Detector::template Pair<Dim>;

    explicit Pair(const PlacedShapes<Dim>& shapes) : Base(shapes), shapes_(&shapes) {}

    [[nodiscard]] Contact<Dim> contact(std::size_t a, std::size_t b, typename Base::Memory& memory,
                                       double reach) {
      Contact<Dim> found = Base::facing_contact(a, b, memory, reach);
      points_.assign(found.polygon.begin(), found.polygon.end());
      for (Vec<Dim>& point : points_) point += shapes_->grid_point(a);
      found.polygon = points_;
      return found;
    }

   private:
    const PlacedShapes<Dim>* shapes_;
    std::vector<Vec<Dim>> points_;
  };
};

template <class Mass>
struct GeometryOf;
template <template <class> class Mass, class Geometry>
struct GeometryOf<Mass<Geometry>> {
  using type = Geometry;
};

/// The contacts between the bodies of a mass, each part of a body a shape of its own.
template <class Detector, class Mass>
[[nodiscard]] auto contact_facets(const Mass& mass) {
  using Geometry = typename GeometryOf<Mass>::type;
  constexpr int dim = Geometry::dim;
  PlacedShapes<dim> shapes;
  std::vector<int> body_of;
  std::vector<const typename Geometry::Shape*> parts;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const auto& part : mass.bodies[b].parts) {
      shapes.add(part, mass.bodies[b].properties.centroid);
      body_of.push_back(static_cast<int>(b));
      parts.push_back(&part);
    }
  // Welded vertices of one place differ by nothing, planes through them by roundings.
  const double tolerance = mass.domain.tolerance(), reach = 10 * tolerance;
  ContactSearch<Detector, dim> search(reach, 0);
  const ContactList<dim>& found = search.run(shapes);
  std::vector<ContactFacet<Geometry>> facets;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const int a = body_of[found[k].a], b = body_of[found[k].b];
    if (a == b) continue;
    const auto polygon = found.polygon(k);
    double outline = 0, low = 0, high = 0;
    for (std::size_t p = 0; p < polygon.size(); ++p) {
      outline += (polygon[p] - polygon[p == 0 ? polygon.size() - 1 : p - 1]).norm();
      const double height = found[k].normal.dot(polygon[p] - polygon[0]);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    // Inclined faces that share an edge are within reach along a strip beside it.
    if (high - low > 0.2 * reach) continue;
    const int cut = cut_facing(*parts[found[k].a], found[k].normal);
    if constexpr (dim == 2) {
      if (found[k].measure <= tolerance) continue;
      facets.push_back({a, b, {polygon[0], polygon[1]}, cut});
    } else {
      if (2 * found[k].measure <= tolerance * (outline + tolerance)) continue;
      facets.push_back({a, b, {{polygon.begin(), polygon.end()}}, cut});
    }
  }
  return facets;
}

}  // namespace voussoir::detail
