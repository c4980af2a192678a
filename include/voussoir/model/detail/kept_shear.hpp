// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>

namespace voussoir::detail {

/// Adds to the initial shear forces of points what is missing of a whole, each its share by weight.
/// Nothing is added where friction would not let it act.
/// @param shear_now  shear_now() is the sum of the points' shear forces [N]
template <int Dim, class Points, class ShearNow>
void match_shear(const Vec<Dim - 1>& wanted, Points& points, ShearNow&& shear_now) {
  const Vec<Dim - 1> missing = wanted - shear_now();
  const double least = 1e-12 * wanted.norm();
  if (points.empty() || !(missing.norm() > least)) return;
  double weight = 0;
  for (const auto& p : points) weight += p.weight;
  std::vector<Vec<Dim - 1>> before;
  for (auto& p : points) {
    before.push_back(p.initial.tangential);
    p.initial.tangential += (p.weight / weight) * missing;
  }
  if ((wanted - shear_now()).norm() <= 1e-6 * missing.norm() + least) return;
  auto initial = before.begin();
  for (auto& p : points) p.initial.tangential = *initial++;
}

/// Gives the new points of a contact in motion the shear force of the old ones.
/// @param old_points  of `old` alone
template <int Dim, class Group>
void keep_shear(const Group& group, const typename Group::Contact& old,
                std::span<const typename Group::Point> old_points,
                const typename Group::Contact& contact, const std::vector<MovingBody<Dim>>& bodies,
                std::vector<typename Group::Point>& points) {
  const auto shear_of = [&](const typename Group::Contact& c, const auto& of) {
    const auto at = c.place(bodies[static_cast<std::size_t>(c.a)].pose,
                            bodies[static_cast<std::size_t>(c.b)].pose);
    return group.shear_of(c, of, at);
  };
  match_shear<Dim>(shear_of(old, old_points), points, [&] { return shear_of(contact, points); });
}

}  // namespace voussoir::detail
