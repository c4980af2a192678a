// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/plane_axis.hpp>
#include <voussoir/detection/detail/plane_pair.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// Half the gradient of a's barrier less that of b's, over the sum of the weights 1 / room.
template <int Dim>
[[nodiscard]] Vec<Dim> barrier_gradients(const PlanePair<Dim>& planes) {
  using Lanes = typename PlanePair<Dim>::Lanes;
  std::array<Lanes, Dim + 1> sums;
  sums.fill(Lanes::all(0));
  for (std::size_t group = 0; group < planes.padded_count(); group += lane_count) {
    const Lanes weight = Lanes::all(1) / planes.room(group);
    const Lanes signed_weight = planes.side(group) * weight;
    for (int axis = 0; axis < Dim; ++axis) {
      Lanes& sum = sums[static_cast<std::size_t>(axis)];
      sum = sum + signed_weight * planes.normal(axis, group);
    }
    sums[Dim] = sums[Dim] + weight;
  }
  Vec<Dim> n;
  for (int axis = 0; axis < Dim; ++axis) n[axis] = sums[static_cast<std::size_t>(axis)].sum();
  return n / sums[Dim].sum();
}

/// The unit gradient of a's rounded inner particle less that of b's.
/// @param rounding  radius of the corners of the inner particles [m], > 0
template <int Dim>
[[nodiscard]] Vec<Dim> rounded_gradients(const PlanePair<Dim>& planes, double rounding) {
  Vec<Dim> difference = zeros<Vec<Dim>>();
  for (const bool of_a : {true, false}) {
    const std::size_t first = of_a ? 0 : planes.count_a();
    const std::size_t last = of_a ? planes.count_a() : planes.count();
    Vec<Dim> gradient = zeros<Vec<Dim>>();
    std::size_t nearest = first;
    for (std::size_t plane = first; plane < last; ++plane) {
      gradient += std::fmax(rounding - planes.room_of(plane), 0.0) * planes.normal_of(plane);
      if (planes.room_of(plane) < planes.room_of(nearest)) nearest = plane;
    }
    const double length = gradient.norm();
    // Inside the inner particle its potential is flat.
    const Vec<Dim> n = length > 0 ? Vec<Dim>(gradient / length) : planes.normal_of(nearest);
    difference += of_a ? n : Vec<Dim>(-n);
  }
  return difference;
}

/// Unit vector up the potential of a and down that of b, at the point of view of `planes`.
/// @param rounding  0: that of the barrier
/// @param in_order  whether a has the lower number
template <int Dim>
[[nodiscard]] Vec<Dim> centre_normal(const PlanePair<Dim>& planes, double rounding,
                                     const PlacedShape<Dim>& a, const PlacedShape<Dim>& b,
                                     bool in_order) {
  const Vec<Dim> n = rounding > 0 ? rounded_gradients(planes, rounding) : barrier_gradients(planes);
  const double length = n.norm();
  // Concentric shapes: the gradients vanish, or are the same, and no direction is any better.
  return length > 1e-6 ? Vec<Dim>(n / length) : shallowest_normal<Dim>(a, b, in_order);
}

}  // namespace voussoir::detail
