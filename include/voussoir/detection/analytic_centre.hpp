// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/detail/barrier_centre.hpp>
#include <voussoir/detection/detail/least_excess.hpp>
#include <voussoir/detection/detail/plane_axis.hpp>
#include <voussoir/detection/detail/plane_pair.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir {

struct AnalyticCentre {
  using role = roles::ContactDetector;
  static constexpr const char* name = "AnalyticCentre";
  template <int Dim>
  class Pair;
};

template <int Dim>
class AnalyticCentre::Pair {
 public:
  struct Memory {
    detail::PlaneAxis<Dim> axis;           ///< kept the shapes apart
    Vec<Dim> inside = Vec<Dim>::Constant(  ///< was inside both [m]
        std::numeric_limits<double>::quiet_NaN());
    bool overlapping = false;
  };

  explicit Pair(const PlacedShapes<Dim>& shapes, double rounding = 0)
      : shapes_(&shapes), rounding_(rounding) {
    require(rounding >= 0 && std::isfinite(rounding), "analytic centre: rounding [m]", rounding,
            ">= 0");
  }

  [[nodiscard]] bool overlap(std::size_t a, std::size_t b, Memory& memory) {
    return find_inside((*shapes_)[a], (*shapes_)[b], memory);
  }

  [[nodiscard]] double separation(std::size_t a, std::size_t b, Memory& memory) {
    const Shape shape_a = (*shapes_)[a], shape_b = (*shapes_)[b];
    if (!find_inside(shape_a, shape_b, memory)) return gap(shape_a, shape_b, memory);
    centre_.move_to_centre(planes_);
    memory.inside = planes_.point();
    return -depth_along(normal(a, b));
  }

  [[nodiscard]] Contact<Dim> contact(std::size_t a, std::size_t b, Memory& memory,
                                     double reach = 0) {
    const Shape shape_a = (*shapes_)[a], shape_b = (*shapes_)[b];
    Contact<Dim> found;
    if (find_inside(shape_a, shape_b, memory)) {
      centre_.move_to_centre(planes_);
      memory.inside = planes_.point();
      found.normal = normal(a, b);
      found.separation = -depth_along(found.normal);
      if (found.separation > reach) return {};
    } else {
      if (!(reach > 0)) return {};
      found.separation = gap(shape_a, shape_b, memory);
      planes_.swell(0.5 * reach);
      if (!(planes_.smallest_room() > 0)) return {};
      centre_.move_to_centre(planes_);
      found.normal = normal(a, b);
    }
    point_ = planes_.point();
    found.touch = Touch::interior;
    found.polygon = std::span<const Vec<Dim>>(&point_, 1);
    return found;
  }

 private:
  using Shape = PlacedShape<Dim>;
  using Planes = detail::PlanePair<Dim>;
  using Lanes = typename Planes::Lanes;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Whether the shapes overlap; if so `planes_` are seen from a point inside both.
  bool find_inside(const Shape& a, const Shape& b, Memory& memory) {
    if (memory.overlapping) {
      planes_.gather(a, b, memory.inside);
      if (planes_.smallest_room() > 0) return true;
    } else if (memory.axis.separates(a, b)) {
      return false;
    }
    const auto program = least_excess(a, b, memory.axis.active(), detail::Until::sign);
    planes_.move(program.point());
    memory.overlapping = planes_.smallest_room() > 0;
    memory.inside = planes_.point();
    memory.axis.set(a, b, program.active(), !memory.overlapping);
    return memory.overlapping;
  }

  /// Twice the least excess of shapes that are apart [m]; `planes_` are seen from its point.
  double gap(const Shape& a, const Shape& b, Memory& memory) {
    const auto program = least_excess(a, b, memory.axis.active(), detail::Until::optimum);
    planes_.move(program.point());
    memory.axis.set(a, b, program.active(), true);
    return std::fmax(2 * program.excess(), 0.0);  // a rounding below 0 is no overlap
  }

  [[nodiscard]] detail::LeastExcess<Dim> least_excess(const Shape& a, const Shape& b,
                                                      const detail::ActivePlanes<Dim>& start,
                                                      detail::Until until) {
    // A vertex of a sees all of the overlap within the extent of a.
    const Vec<Dim> view = a.vertex(0);
    Lanes region = Lanes::Zero();
    for (const Shape* shape : {&a, &b})
      for (int axis = 0; axis < Dim; ++axis)
        for (std::size_t k = 0; k < shape->vertex_stride(); k += lane_count)
          region =
              region.max((Eigen::Map<const Lanes>(shape->vertices(axis) + k) - view[axis]).abs());
    planes_.gather(a, b, view);
    return {planes_, 2 * region.maxCoeff(), start, until};
  }

  /// Unit vector up the potential of a and down that of b, at the point of view of `planes_`.
  [[nodiscard]] Vec<Dim> normal(std::size_t a, std::size_t b) const {
    Vec<Dim> n = rounding_ > 0 ? rounded_gradients() : barrier_gradients();
    const double length = n.norm();
    // Concentric shapes: the gradients vanish, or are the same, and no direction is any better.
    return length > 1e-6 ? Vec<Dim>(n / length) : shallowest(a, b);
  }

  /// Half the gradient of a's barrier less that of b's, over the sum of the weights 1 / room.
  [[nodiscard]] Vec<Dim> barrier_gradients() const {
    std::array<Lanes, Dim + 1> sums;
    sums.fill(Lanes::Zero());
    for (std::size_t group = 0; group < planes_.padded_count(); group += lane_count) {
      const Lanes weight = 1 / planes_.room(group), signed_weight = planes_.side(group) * weight;
      for (int axis = 0; axis < Dim; ++axis)
        sums[static_cast<std::size_t>(axis)] += signed_weight * planes_.normal(axis, group);
      sums[Dim] += weight;
    }
    Vec<Dim> n;
    for (int axis = 0; axis < Dim; ++axis) n[axis] = sums[static_cast<std::size_t>(axis)].sum();
    return n / sums[Dim].sum();
  }

  /// The unit gradient of a's rounded inner particle less that of b's.
  [[nodiscard]] Vec<Dim> rounded_gradients() const {
    Vec<Dim> difference = Vec<Dim>::Zero();
    for (const bool of_a : {true, false}) {
      const std::size_t first = of_a ? 0 : planes_.count_a();
      const std::size_t last = of_a ? planes_.count_a() : planes_.count();
      Vec<Dim> gradient = Vec<Dim>::Zero();
      std::size_t nearest = first;
      for (std::size_t plane = first; plane < last; ++plane) {
        gradient += std::fmax(rounding_ - planes_.room_of(plane), 0.0) * planes_.normal_of(plane);
        if (planes_.room_of(plane) < planes_.room_of(nearest)) nearest = plane;
      }
      const double length = gradient.norm();
      // Inside the inner particle its potential is flat.
      const Vec<Dim> n =
          length > 0 ? Vec<Dim>(gradient / length) : planes_.normal_of(nearest);
      difference += of_a ? n : Vec<Dim>(-n);
    }
    return difference;
  }

  /// Normal, from a to b, of the face of either that is left by the shortest way. Of equals the
  /// one of the shape with the lower number, so that (b, a) has the opposite normal.
  [[nodiscard]] Vec<Dim> shallowest(std::size_t a, std::size_t b) const {
    const Shape first = (*shapes_)[std::min(a, b)], second = (*shapes_)[std::max(a, b)];
    const detail::ShallowFace<Dim> of_first(first, second), of_second(second, first);
    const bool use_first = of_first.separation >= of_second.separation;
    const Vec<Dim> n = use_first ? of_first.normal : of_second.normal;
    return use_first == (a <= b) ? n : Vec<Dim>(-n);
  }

  /// Way from the point to where it leaves a along the normal, and b against it [m].
  [[nodiscard]] double depth_along(const Vec<Dim>& n) const {
    Lanes exit_a = Lanes::Constant(infinite), exit_b = exit_a;
    for (std::size_t group = 0; group < planes_.padded_count(); group += lane_count) {
      const Lanes side = planes_.side(group), along = side * planes_.along(n, group);
      const Lanes exit = (along > 0).select(planes_.room(group) / along, infinite);
      exit_a = exit_a.min((side > 0).select(exit, infinite));
      exit_b = exit_b.min((side < 0).select(exit, infinite));
    }
    return exit_a.minCoeff() + exit_b.minCoeff();
  }

  const PlacedShapes<Dim>* shapes_;
  double rounding_;
  Planes planes_;
  detail::BarrierCentre<Dim> centre_;
  Vec<Dim> point_ = Vec<Dim>::Zero();
};

}  // namespace voussoir
