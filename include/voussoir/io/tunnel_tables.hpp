// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_line.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>

namespace voussoir {

// What a tunnel carries, as tables: comma-separated text, units in the names of the columns.

/// A word for what became of a bolt at a joint.
[[nodiscard]] inline const char* to_string(const BoltReport& report) {
  if (report.is_broken) return "ruptured";
  return report.has_yielded() ? "yielded" : "elastic";
}

namespace detail {

/// "-" where no strength was given: not checked.
[[nodiscard]] inline std::string strength_text(double value, double strength) {
  return std::isfinite(strength) ? significant_text(value, 8) : std::string("-");
}

/// "-": not checked; "beyond": no part of it is borne.
[[nodiscard]] inline std::string use_text(double use) {
  return std::isnan(use) ? "-" : std::isinf(use) ? "beyond" : significant_text(use, 4);
}

/// Anticlockwise from the right-hand springing [degrees], 0 to 360.
[[nodiscard]] inline double angle_in_degrees(const Vec2& p) {
  const double angle = std::atan2(p.y(), p.x()) * 180 / std::numbers::pi;
  return angle < -1e-9 ? angle + 360 : std::max(angle, 0.0);
}
/// Where a bar crosses a joint, and the number of that joint along the bar, from 1.
template <class Bar>
struct PlaceOnBar {
  const Bar* bar;
  int joint;
};
template <class Bar>
[[nodiscard]] std::vector<PlaceOnBar<Bar>> places_on_bars(
    const std::vector<CrossingForce>& crossings, const std::vector<Bar>& bars) {
  std::vector<int> count(bars.size(), 0);
  std::vector<PlaceOnBar<Bar>> places;
  for (const CrossingForce& c : crossings) {
    if (c.bolt < 0 || static_cast<std::size_t>(c.bolt) >= bars.size())
      throw InvalidInput("table of bolts: no bar was given for bolt " + std::to_string(c.bolt));
    const auto k = static_cast<std::size_t>(c.bolt);
    places.push_back({&bars[k], ++count[k]});
  }
  return places;
}

}  // namespace detail

/// Of a bolt at a joint.
struct CrossingStrength {
  double strength = std::numeric_limits<double>::infinity();  ///< [N]; infinite: none was given
  std::string mode = "-";                                     ///< what it would fail of
};

/// Strength of bolts in tension: one for all, or that at each joint.
class BoltStrengths {
 public:
  BoltStrengths() = default;
  /// @param of_all  [N]
  BoltStrengths(double of_all) : of_all_(of_all) {}  // NOLINT(google-explicit-constructor)
  /// @param at_joints  in the order of `bolt_forces`
  BoltStrengths(std::vector<CrossingStrength> at_joints)  // NOLINT(google-explicit-constructor)
      : at_joints_(std::move(at_joints)) {}

  /// @param crossing  index
  [[nodiscard]] CrossingStrength at(std::size_t crossing) const {
    return crossing < at_joints_.size() ? at_joints_[crossing] : CrossingStrength{of_all_};
  }

 private:
  double of_all_ = std::numeric_limits<double>::infinity();
  std::vector<CrossingStrength> at_joints_;
};

/// One row for every bolt and joint crossed.
/// @param bars      in the order in which they were installed
/// @param strength  in tension, of one bolt [N]; infinite: none was given, nothing is checked; or
///                  those at all crossings
/// @throws InvalidInput  a bar is missing
[[nodiscard]] inline std::string bolt_table(const std::vector<CrossingForce>& crossings,
                                            const std::vector<Segment>& bars,
                                            const BoltStrengths& strength = {}) {
  CsvTable table(
      {"bolt", "angle_deg", "joint", "distance_from_head_m", "x_m", "y_m", "axial_force_kN",
       "extension_mm", "state", "of_its_strength", "strength_kN", "mode"},
      8);
  const auto places = detail::places_on_bars(crossings, bars);
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const CrossingForce& c = crossings[k];
    const CrossingStrength borne = strength.at(k);
    const Segment& bar = *places[k].bar;
    const Vec2 p = bar.at(c.position / bar.length());
    table.add_row(c.bolt + 1, detail::angle_in_degrees(bar.end - bar.start), places[k].joint,
                  c.position, p.x(), p.y(), 1e-3 * c.report.axial, 1e3 * c.extension,
                  to_string(c.report),
                  detail::strength_text(c.report.axial / borne.strength, borne.strength),
                  detail::strength_text(1e-3 * borne.strength, borne.strength), borne.mode);
  }
  return table.text();
}
[[nodiscard]] inline std::string bolt_table(const std::vector<CrossingForce>& crossings,
                                            const std::vector<SpatialLine>& bars,
                                            const BoltStrengths& strength = {}) {
  CsvTable table(
      {"bolt", "joint", "distance_from_head_m", "x_m", "y_m", "z_m", "axial_force_kN",
       "shear_force_kN", "extension_mm", "state", "of_its_strength", "strength_kN", "mode"},
      8);
  const auto places = detail::places_on_bars(crossings, bars);
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const CrossingForce& c = crossings[k];
    const CrossingStrength borne = strength.at(k);
    const SpatialLine& bar = *places[k].bar;
    const Vec3 p = bar.start + c.position / bar.length() * (bar.end - bar.start);
    table.add_row(c.bolt + 1, places[k].joint, c.position, p.x(), p.y(), p.z(),
                  1e-3 * c.report.axial, 1e-3 * c.report.shear, 1e3 * c.extension,
                  to_string(c.report),
                  detail::strength_text(c.report.axial / borne.strength, borne.strength),
                  detail::strength_text(1e-3 * borne.strength, borne.strength), borne.mode);
  }
  return table.text();
}

/// One row for every node of all linings in 2-D, these numbered in the order of their installation
/// and nodes within each.
/// @param of_strength  what each node carries of what it can [-]; not a number, or left out: that
/// is
///                     not checked; infinite: it bears no part of it
[[nodiscard]] inline std::string lining_table(const std::vector<LiningForce>& lining,
                                              const std::vector<double>& of_strength = {}) {
  CsvTable table(
      {"lining", "node", "angle_deg", "x_m", "y_m", "thrust_kN_per_m", "shear_kN_per_m",
       "moment_kNm_per_m", "convergence_mm", "lost", "of_its_strength", "largest_shear_kN_per_m"},
      8);
  int node = 0, of = -1;
  for (std::size_t k = 0; k < lining.size(); ++k) {
    const LiningForce& at = lining[k];
    node = at.lining == of ? node + 1 : 1;
    of = at.lining;
    const double use =
        k < of_strength.size() ? of_strength[k] : std::numeric_limits<double>::quiet_NaN();
    table.add_row(of + 1, node, detail::angle_in_degrees(at.position - at.centre), at.position.x(),
                  at.position.y(), 1e-3 * at.thrust, 1e-3 * at.shear, 1e-3 * at.moment,
                  1e3 * at.convergence, at.is_lost, detail::use_text(use), 1e-3 * at.largest_shear);
  }
  return table.text();
}
/// One row for every member of all linings in 3-D; what joins two linings is of the later one.
/// @param of_strength  what each member carries of what it can, as of nodes above
[[nodiscard]] inline std::string lining_table(const std::vector<MemberForces<3>>& members,
                                              const std::vector<double>& of_strength = {}) {
  CsvTable table({"lining", "member", "x_m", "y_m", "z_m", "thrust_kN", "shear_kN", "moment_kNm",
                  "of_its_strength"},
                 8);
  int number = 0;
  for (const MemberForces<3>& m : members) {
    const Vec3 p = 0.5 * (m.from + m.to);
    const auto k = static_cast<std::size_t>(number);
    table.add_row(
        m.lining + 1, ++number, p.x(), p.y(), p.z(), 1e-3 * m.thrust, 1e-3 * m.shear,
        1e-3 * m.moment,
        detail::use_text(k < of_strength.size() ? of_strength[k]
                                                : std::numeric_limits<double>::quiet_NaN()));
  }
  return table.text();
}

/// One row for every contact of two blocks. Blocks are numbered as in the rock mass.
template <int Dim>
[[nodiscard]] std::string joint_table(const std::vector<JointState<Dim>>& joints) {
  std::vector<std::string> columns{"block_a", "block_b", "x_m", "y_m"};
  if (Dim == 3) columns.emplace_back("z_m");
  for (const char* name : {Dim == 2 ? "length_m" : "area_m2", "normal_force_kN", "shear_force_kN",
                           "opening_mm", "plastic_slip_mm", "damage", "open", "slipping"})
    columns.emplace_back(name);
  CsvTable table(columns, 8);
  for (const JointState<Dim>& j : joints) {
    const ContactReport& r = j.report;
    const auto row = [&](auto... place) {
      table.add_row(j.a, j.b, place..., j.measure, 1e-3 * r.normal, 1e-3 * r.shear, 1e3 * r.opening,
                    1e3 * r.plastic_slip, r.damage, r.is_open, r.is_slipping);
    };
    if constexpr (Dim == 2)
      row(j.centre.x(), j.centre.y());
    else
      row(j.centre.x(), j.centre.y(), j.centre.z());
  }
  return table.text();
}

}  // namespace voussoir
