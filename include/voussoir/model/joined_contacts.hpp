// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/contact_area.hpp>
#include <voussoir/geometry/contact_facet.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>

namespace voussoir {

namespace detail {

/// The same facet seen from the other side.
[[nodiscard]] inline Segment seen_from_behind(const Segment& facet) {
  return {facet.end, facet.start};
}
[[nodiscard]] inline SpatialFacet seen_from_behind(SpatialFacet facet) {
  std::reverse(facet.vertices.begin(), facet.vertices.end());
  return facet;
}

/// True if a facet looks the way of another and lies in its plane: that of one cut, or of two that
/// are the same to a tolerance [m].
template <class Geometry>
[[nodiscard]] bool is_in_plane_of(const ContactFacet<Geometry>& plane,
                                  const ContactFacet<Geometry>& other, double tolerance) {
  const auto normal = normalized(plane.facet.area_vector());
  if (!(dot_product(normal, other.facet.area_vector()) > 0)) return false;
  if (plane.cut >= 0 && plane.cut == other.cut) return true;
  const auto corners = corners_of(other.facet);
  return std::all_of(corners.begin(), corners.end(), [&](const auto& corner) {
    return std::abs(dot_product(normal, corner - corners_of(plane.facet).front())) <= tolerance;
  });
}

/// Shares the facets of the same two bodies out among the planes in which these touch.
///
/// The largest facet tells the plane best, whoever comes first; then that of those left, and so on.
/// @param facets   area vectors from a to b; empty afterwards
/// @param laws     of each, an index: facets of different laws make different contacts
/// @param visit    visit(area, law) for every contact
template <class Geometry, class Visit>
void join_facets(std::vector<ContactFacet<Geometry>>& facets, std::vector<int>& laws,
                 double tolerance, Visit&& visit) {
  while (!facets.empty()) {
    std::size_t largest = 0;
    for (std::size_t k = 1; k < facets.size(); ++k)
      if (facets[k].facet.measure() > facets[largest].facet.measure()) largest = k;
    std::swap(facets.front(), facets[largest]);
    std::swap(laws.front(), laws[largest]);
    const ContactFacet<Geometry> plane = facets.front();
    const int law = laws.front();
    ContactArea<Geometry::dim> area;
    std::size_t left = 0;
    for (std::size_t k = 0; k < facets.size(); ++k) {
      if (k == 0 || (laws[k] == law && is_in_plane_of(plane, facets[k], tolerance))) {
        area.add(std::move(facets[k].facet));
      } else {
        if (left != k) facets[left] = std::move(facets[k]);
        laws[left++] = laws[k];
      }
    }
    facets.resize(left, plane);
    laws.resize(left);
    visit(area, law);
  }
}

}  // namespace detail

/// Goes through the contacts of a mass, sorted by their bodies: all facets of the same two bodies
/// on one plane are one contact.
///
/// How a body has been cut into parts, and with it the number of facets, depends on the order of
/// the cuts; the contacts do not, and a mirrored mass has the mirrored ones.
/// @param found      facets as a detector finds them, in any order
/// @param tolerance  of the domain: facets that are off a plane by no more lie in it [m]
/// @param law_of     law_of(cut): index of the law of the joint that made this cut
/// @param visit      visit(a, b, area, law): the area is a facet where there is only one, else a
///                   `ContactArea`; its area vector points from a to b
template <class Geometry, class LawOf, class Visit>
void visit_joined(const std::vector<ContactFacet<Geometry>>& found, double tolerance,
                  LawOf&& law_of, Visit&& visit) {
  const std::vector<int> order =
      order_by_bodies(found, [](const auto& c) { return std::pair<int, int>(c.a, c.b); });
  const auto at = [&](std::size_t k) -> const ContactFacet<Geometry>& {
    return found[static_cast<std::size_t>(order[k])];
  };
  std::vector<ContactFacet<Geometry>> facets;
  std::vector<int> laws;
  for (std::size_t k = 0; k < order.size();) {
    const ContactFacet<Geometry>& first = at(k);
    std::size_t end = k + 1;
    while (end < order.size() && std::minmax(at(end).a, at(end).b) == std::minmax(first.a, first.b))
      ++end;
    if (end == k + 1) {
      visit(first.a, first.b, first.facet, law_of(first.cut));
    } else {
      for (std::size_t i = k; i < end; ++i) {
        facets.push_back(at(i));
        if (at(i).a != first.a)
          facets.back().facet = detail::seen_from_behind(std::move(facets.back().facet));
        laws.push_back(law_of(at(i).cut));
      }
      detail::join_facets(facets, laws, tolerance,
                          [&](const auto& area, int law) { visit(first.a, first.b, area, law); });
    }
    k = end;
  }
}

/// Goes through the contacts of bodies with the edges of the domain, body by body: all that a body
/// has of one side is one contact.
/// @param facets  those of one body one after the other, as `boundary_facets` has them
/// @param visit   visit(body, side, area), area as above
template <class Geometry, class Visit>
void visit_joined(const std::vector<BoundaryFacet<Geometry>>& facets, Visit&& visit) {
  for (std::size_t k = 0; k < facets.size();) {
    std::size_t end = k + 1;
    while (end < facets.size() && facets[end].body == facets[k].body) ++end;
    for (std::size_t i = k; i < end; ++i) {
      const auto of_side = [&](const auto& f) { return f.side == facets[i].side; };
      const auto first = facets.begin() + static_cast<std::ptrdiff_t>(k),
                 here = facets.begin() + static_cast<std::ptrdiff_t>(i),
                 last = facets.begin() + static_cast<std::ptrdiff_t>(end);
      if (std::any_of(first, here, of_side)) continue;  // went with an earlier one
      if (std::none_of(here + 1, last, of_side)) {
        visit(facets[i].body, facets[i].side, facets[i].facet);
        continue;
      }
      ContactArea<Geometry::dim> area;
      for (auto f = here; f != last; ++f)
        if (of_side(*f)) area.add(f->facet);
      visit(facets[i].body, facets[i].side, area);
    }
    k = end;
  }
}

}  // namespace voussoir
