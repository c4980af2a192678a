// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/rockmass/orientation.hpp>

namespace voussoir {

/// A joint as it was measured with a compass.
struct SurveyedPlane {
  Orientation plane;
  int set = -1;       ///< index of its joint set; -1: none
  double weight = 1;  ///< of the measurement [-], > 0: how many it stands for, or Terzaghi's
};

/// Fisher's distribution fitted to the planes of one set.
struct FittedSet {
  std::string name;
  Orientation mean{};
  /// K, Fisher's estimate of kappa [-], > 0. None: fewer than 3 planes, or planes all alike.
  std::optional<double> concentration{};
  std::size_t count = 0;       ///< planes
  double weight = 0;           ///< sum of their weights [-]
  double effective_count = 0;  ///< N of K and of the cone [-], at most `count`
  /// Angle about the mean within which the true mean is with 95 % confidence [rad], 0 to pi. None
  /// where K is none.
  std::optional<double> cone_95{};
  double largest_angle = 0;  ///< of a normal to the mean's [rad], 0 to pi/2
};

/// Below this K planes are taken for more than one set: those with no common direction at all,
/// turned to one side, have K = 2.
inline constexpr double least_concentration = 5;

/// Fits Fisher's distribution to the planes of one set.
///
///   K = (N - 1) / (N - R),  cos(cone) = 1 - (N - R) / R (20^(1 / (N - 1)) - 1)
///
/// R is the length of the sum of the unit normals, each turned to the mean's side, as planes have
/// no sense. Which side that is begins with the axis about which the normals are densest (largest
/// eigenvector of the orientation tensor) and is repeated with the mean found. Below K = 5 some are
/// turned that should not be: K comes out too large.
///
/// With weights w, R = N |sum w n| / sum w, and N = (sum w)^2 / sum w^2 (Kish): a few heavy planes
/// count for few. Equal weights, however large, leave N the number of planes: repeated readings of
/// one plane are not independent, and the cone is on the safe side where they are.
///
/// @param set   whose planes are taken; -1: those of none
/// @param name  for the result and for messages
/// @throws InvalidInput  no plane of the set; a dip, direction or weight out of range
/// Source: Fisher (1953), Proc. R. Soc. A 217, 295-305; Fisher, Lewis & Embleton (1987), section
/// 5.3.2; Kish (1965), Survey Sampling, for N.
[[nodiscard]] VOUSSOIR_INLINE FittedSet fitted_set(std::span<const SurveyedPlane> planes, int set,
                                                   const std::string& name);

/// Fits every set; planes of no set are left out. Without names all planes are one set, "all".
///
/// @param names  of the sets, by index
/// @throws InvalidInput  see `fitted_set`; without names, K < `least_concentration`
[[nodiscard]] VOUSSOIR_INLINE std::vector<FittedSet> fitted_sets(
    std::span<const SurveyedPlane> planes, const std::vector<std::string>& names);

/// How many planes one stands for that a straight scanline or borehole met: 1 / sin of the angle
/// between line and plane, as a line meets planes along it rarely.
///
/// @param trend    of the line, clockwise from North [rad], 0 to 2 pi
/// @param plunge   of the line, below the horizontal [rad], -pi/2 to pi/2
/// @param largest  weight, for planes almost along the line [-], >= 1; usual are 3 to 10
/// @throws InvalidInput  out of range
/// Source: Terzaghi (1965), Sources of error in joint surveys, Geotechnique 15, 287-304.
[[nodiscard]] VOUSSOIR_INLINE double terzaghi_weight(const Orientation& plane, double trend,
                                                     double plunge, double largest);

namespace detail {

/// Unit vector along a line; downward where the plunge is > 0.
[[nodiscard]] VOUSSOIR_INLINE Vec3 line_vector(double trend, double plunge);

/// (sum w)^2 / sum w^2: as many planes of equal weight are worth as much.
[[nodiscard]] VOUSSOIR_INLINE double effective_count(std::span<const SurveyedPlane> planes);

/// @throws InvalidInput  a dip, direction or weight out of range
VOUSSOIR_INLINE void check_planes(std::span<const SurveyedPlane> planes, const std::string& name);

/// The axis about which the normals are densest: eigenvector of sum w n n' with the largest
/// eigenvalue, by squaring, which needs no more than the products of 3 x 3 numbers.
[[nodiscard]] VOUSSOIR_INLINE Vec3 densest_axis(std::span<const SurveyedPlane> planes);

[[nodiscard]] VOUSSOIR_INLINE FittedSet fit_of(std::span<const SurveyedPlane> planes,
                                               const std::string& name);

}  // namespace detail

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE Vec3 line_vector(double trend, double plunge) {
  const auto [fall, level] = elementary::sine_cosine(plunge);
  const auto [east, north] = elementary::sine_cosine(trend);
  return {level * east, level * north, -fall};
}

VOUSSOIR_INLINE double effective_count(std::span<const SurveyedPlane> planes) {
  double sum = 0, squares = 0;
  for (const SurveyedPlane& surveyed : planes) {
    sum += surveyed.weight;
    squares += surveyed.weight * surveyed.weight;
  }
  return sum * sum / squares;
}

VOUSSOIR_INLINE void check_planes(std::span<const SurveyedPlane> planes, const std::string& name) {
  constexpr double pi = std::numbers::pi;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const auto& [plane, set, weight] = planes[k];
    const bool is_well = plane.dip >= 0 && plane.dip <= 0.5 * pi && plane.dip_direction >= 0 &&
                         plane.dip_direction <= 2 * pi && weight > 0 && std::isfinite(weight);
    if (is_well) continue;
    const std::string what = message({name, ", plane ", k + 1, ": "});
    require_angle(what + "dip", plane.dip, 0, 0.5 * pi);
    require_angle(what + "dip direction", plane.dip_direction, 0, 2 * pi);
    throw InvalidInput(message({what, "weight = ", weight, ": must be > 0 and finite"}));
  }
}

VOUSSOIR_INLINE Vec3 densest_axis(std::span<const SurveyedPlane> planes) {
  double tensor[3][3] = {};
  for (const SurveyedPlane& surveyed : planes) {
    const Vec3 normal = upward_normal(surveyed.plane);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) tensor[i][j] += surveyed.weight * normal[i] * normal[j];
  }
  for (int round = 0; round < 24; ++round) {
    const double trace = tensor[0][0] + tensor[1][1] + tensor[2][2];
    double square[3][3] = {};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) square[i][j] += tensor[i][k] / trace * (tensor[k][j] / trace);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) tensor[i][j] = square[i][j];
  }
  // All columns are along the axis; the longest has lost least.
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (tensor[k][k] > tensor[longest][longest]) longest = k;
  return {tensor[0][longest], tensor[1][longest], tensor[2][longest]};
}

VOUSSOIR_INLINE FittedSet fit_of(std::span<const SurveyedPlane> planes, const std::string& name) {
  check_planes(planes, name);
  FittedSet fit;
  fit.name = name;
  fit.count = planes.size();
  fit.effective_count = effective_count(planes);
  const auto turned_to = [](const Vec3& side, const SurveyedPlane& surveyed) {
    const Vec3 normal = upward_normal(surveyed.plane);
    return dot_product(normal, side) < 0 ? Vec3(-normal) : normal;
  };
  Vec3 side = densest_axis(planes), sum = zeros<Vec3>();
  for (int round = 0; round < 100; ++round) {  // ends at the second or third
    sum = zeros<Vec3>();
    for (const SurveyedPlane& surveyed : planes) sum += surveyed.weight * turned_to(side, surveyed);
    if (sum == side) break;
    side = sum;
  }
  const double length = std::sqrt(dot_product(sum, sum));
  const Vec3 mean = sum / length;
  fit.mean = orientation_of(mean);
  // N - R as a sum of squares: of planes a degree apart, N and R agree in four digits.
  double versines = 0;
  for (const SurveyedPlane& surveyed : planes) {
    const Vec3 normal = turned_to(mean, surveyed), away = normal - mean, across = normal + mean;
    const double chord_squared = dot_product(away, away);
    fit.weight += surveyed.weight;
    versines += surveyed.weight * 0.5 * chord_squared;
    fit.largest_angle = std::max(
        fit.largest_angle,
        2 * elementary::angle_of(std::sqrt(chord_squared), std::sqrt(dot_product(across, across))));
  }
  constexpr double alike = 1e-14;  // a ten millionth of a radian, well below what a compass shows
  const double versine = versines / fit.weight;
  if (planes.size() < 3 || !(versine > alike) || !(fit.effective_count > 1)) return fit;
  const double n = fit.effective_count, missing = n * versine, resultant = n - missing;
  fit.concentration = (n - 1) / missing;
  const double cosine = 1 - missing / resultant * (elementary::power(20, 1 / (n - 1)) - 1);
  fit.cone_95 = cosine <= -1 ? std::numbers::pi
                             : elementary::angle_of(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
  return fit;
}

}  // namespace detail

VOUSSOIR_INLINE FittedSet fitted_set(std::span<const SurveyedPlane> planes, int set,
                                     const std::string& name) {
  std::vector<SurveyedPlane> own;
  for (const SurveyedPlane& surveyed : planes)
    if (surveyed.set == set) own.push_back(surveyed);
  const std::string what = "set " + name;
  if (own.empty()) throw InvalidInput(message({what, ": has no plane; needs at least one"}));
  FittedSet fit = detail::fit_of(own, what);
  fit.name = name;
  return fit;
}

VOUSSOIR_INLINE std::vector<FittedSet> fitted_sets(std::span<const SurveyedPlane> planes,
                                                   const std::vector<std::string>& names) {
  std::vector<FittedSet> fits;
  for (std::size_t set = 0; set < names.size(); ++set)
    fits.push_back(fitted_set(planes, static_cast<int>(set), names[set]));
  if (!names.empty()) return fits;
  if (planes.empty()) throw InvalidInput("no planes to fit a set to; needs at least one");
  fits.push_back(detail::fit_of(planes, "all"));
  if (const auto k = fits.front().concentration; k && *k < least_concentration)
    throw InvalidInput("the planes do not look like one set (K = " + fixed_text(*k, 1) +
                       "): add a set column");
  return fits;
}

VOUSSOIR_INLINE double terzaghi_weight(const Orientation& plane, double trend, double plunge,
                                       double largest) {
  constexpr double pi = std::numbers::pi;
  require_angle("trend of the scanline", trend, 0, 2 * pi);
  require_angle("plunge of the scanline", plunge, -0.5 * pi, 0.5 * pi);
  require(largest >= 1 && std::isfinite(largest), "largest Terzaghi weight", largest,
          ">= 1 and finite");
  const double sine =
      std::abs(dot_product(upward_normal(plane), detail::line_vector(trend, plunge)));
  return largest * sine > 1 ? 1 / sine : largest;
}

#endif

}  // namespace voussoir
