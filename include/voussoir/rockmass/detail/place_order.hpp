// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <tuple>
#include <utility>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir::detail {

/// A place to a micrometre, to be compared: what was computed on another site grid differs in
/// digits beyond.
using Place = std::pair<double, double>;
[[nodiscard]] inline double to_micrometre(double x) { return std::round(1e6 * x); }
[[nodiscard]] inline Place place_of(const Vec2& p) {
  return {to_micrometre(p.x()), to_micrometre(p.y())};
}

/// In which order come things of which nothing but the place differs: the lower first, then the one
/// nearer to the middle of the domain, then the left one. Where it can be, the order is so the same
/// in the mirror: a rule that goes from left to right makes another rock of the image.
class PlaceOrder {
 public:
  using Key = std::tuple<double, double, double>;

  explicit PlaceOrder(const Domain<2>& domain)
      : middle_(0.5 * (domain.low.x() + domain.high.x())) {}

  [[nodiscard]] Key operator()(const Vec2& p) const {
    const double x = p.x() - middle_;
    return {to_micrometre(p.y()), to_micrometre(std::abs(x)), to_micrometre(x)};
  }

 private:
  double middle_;  ///< [m]
};

}  // namespace voussoir::detail
