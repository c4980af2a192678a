// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>
#include <voussoir/model/point_loads.hpp>

namespace voussoir::detail {

/// Moves the faces of a contact in motion apart, along its normal, until its springs hold no more
/// energy than `most` [J]: how far their overlap is not counted is chosen anew at every contact
/// update, and is nothing where the area or the depth have not grown since the last one.
///
/// Between updates springs are conservative. An update that finds a larger area, another face or an
/// overlap that nobody has seen would give the blocks energy that nothing has brought; so it
/// finds them as deep as what they have brought has pressed them.
///
/// Contacts with in-situ stress are left alone: their energy is that of the rock around them.
/// @param contact  the way is written there, too
/// @param most  >= 0
/// @cost   some evaluations of the energy of all points, if they hold too much
template <int Dim, class Group>
void limit_energy(const Group& group, typename Group::Contact& contact,
                  const std::vector<MovingBody<Dim>>& bodies,
                  std::vector<typename Group::Point>& points, double most) {
  const auto at = contact.place(bodies[static_cast<std::size_t>(contact.a)].pose,
                                bodies[static_cast<std::size_t>(contact.b)].pose);
  for (const auto& p : points)
    if (p.initial.normal != 0) return;
  const double deepest =
      std::max(0.0, detail::deepest<Dim>(contact, points.data(), points.size(), at));
  // Of energy the root: where all points are closed it falls in proportion to the way.
  const auto root_after = [&](double way) {
    return std::sqrt(std::max(0.0, group.stored_energy(contact, points, at, way)));
  };
  const double wanted = std::sqrt(most);
  double low = 0, high = deepest, at_high = 0;
  double above = root_after(0) - wanted, below = wanted;
  if (!(above > 0)) return;
  // Regula falsi, the side that stays halved (Illinois), until the root is met from below.
  for (int last = 0; wanted - at_high > 1e-12 * wanted && high - low > 1e-14 * deepest;) {
    const double way = low + (high - low) * above / (above + below);
    const double root = root_after(way);
    if (root > wanted) {
      low = way;
      above = root - wanted;
      if (std::exchange(last, 1) == 1) below *= 0.5;
    } else {
      high = way;
      at_high = root;
      below = wanted - root;
      if (std::exchange(last, -1) == -1) above *= 0.5;
    }
  }
  for (auto& p : points) p.zero[0] -= high;
  contact.uncounted = high;
}

}  // namespace voussoir::detail
