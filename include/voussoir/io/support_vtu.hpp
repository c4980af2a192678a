// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/spatial_line.hpp>
#include <voussoir/io/vtu.hpp>
#include <voussoir/tunnel/rib_forces.hpp>
#include <voussoir/tunnel/support_forces.hpp>

namespace voussoir {

// Bolts and linings in 3-D as files for ParaView, numbered as in `bolts.csv` and `lining.csv`, in
// the signs of these.

/// The bars, each parted midway between the joints that it crosses: a length has the values of its
/// joint. One that crosses none is one length without force.
///
/// Values: `bolt` and `joint` (from the head, 0: none), numbered from 1; `axial_force_kN` (tension
/// positive), `shear_force_kN`, `extension_mm`; `state`, 0 elastic, 1 yielded, 2 ruptured;
/// `largest_axial_force_kN` of the whole bar.
/// @param bars  in the order in which they were installed
/// @throws InvalidInput  a bar is missing
[[nodiscard]] VOUSSOIR_INLINE VtuGrid bolt_grid(const std::vector<CrossingForce>& crossings,
                                                const std::vector<SpatialLine>& bars);

/// Along which axis the ribs of every lining of a solver stand side by side; zero for one without
/// members.
template <class Solver>
requires(Solver::dim == 3) [[nodiscard]] std::vector<Vec3> lining_axes(const Solver& solver) {
  std::vector<Vec3> axes;
  for (const auto* lining : solver.linings())
    // The first member runs across the opening, its second axis out of it.
    axes.push_back(lining->members().empty() ? zeros<Vec3>()
                                             : Vec3(row(lining->members().front().at_rest, 2)));
  return axes;
}

/// The members of linings that run across the opening, each as wide as the strip that it stands
/// for. What joins one rib to the next along the opening is left out: the strips lie side by side.
///
/// Values at the nodes, as `rib_forces` has them over the width of the strip: `thrust_kN_per_m`
/// (compression positive), `shear_kN_per_m`, `moment_kNm_per_m` (outer fibre in tension: positive).
/// Of every member: `lining`, `member` (its row in the table of the lining) and `rib` (along the
/// axis, all linings of one axis together), numbered from 1; `along_m`, its place along the axis
/// from the origin of the coordinates.
/// @param members  all of them, as `lining_members` gives them;  @param nodes  as `rib_forces`
/// @param axes     as `lining_axes`
/// @param width    of a strip [m], > 0
/// @throws InvalidInput  the width is out of range, an axis or the force at a node is missing
[[nodiscard]] VOUSSOIR_INLINE VtuGrid lining_grid(const std::vector<MemberForces<3>>& members,
                                                  const std::vector<RibForce>& nodes,
                                                  const std::vector<Vec3>& axes, double width);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE VtuGrid bolt_grid(const std::vector<CrossingForce>& crossings,
                                  const std::vector<SpatialLine>& bars) {
  std::vector<std::vector<const CrossingForce*>> of_bar(bars.size());
  for (const CrossingForce& c : crossings) {
    if (c.bolt < 0 || static_cast<std::size_t>(c.bolt) >= bars.size())
      throw InvalidInput("bolts for ParaView: no bar was given for bolt " + std::to_string(c.bolt));
    of_bar[static_cast<std::size_t>(c.bolt)].push_back(&c);
  }
  const std::vector<double> largest = largest_bolt_forces(crossings, static_cast<int>(bars.size()));
  VtuGrid grid;
  std::vector<double> bolt, joint, axial, shear, extension, state, of_bolt;
  const auto add = [&](std::size_t k, double from, double to, std::size_t number,
                       const CrossingForce& c) {
    const SpatialLine& bar = bars[k];
    const Vec3 along = (bar.end - bar.start) / bar.length();
    grid.add_line(bar.start + from * along, bar.start + to * along);
    bolt.push_back(static_cast<double>(k + 1));
    joint.push_back(static_cast<double>(number));
    axial.push_back(1e-3 * c.report.axial);
    shear.push_back(1e-3 * c.report.shear);
    extension.push_back(1e3 * c.extension);
    state.push_back(c.report.is_broken ? 2 : c.report.has_yielded() ? 1 : 0);
    of_bolt.push_back(1e-3 * largest[k]);
  };
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const auto& at = of_bar[k];
    if (at.empty()) add(k, 0, bars[k].length(), 0, {static_cast<int>(k), 0, 0, {}});
    double from = 0;
    for (std::size_t n = 0; n < at.size(); ++n) {
      const double to =
          n + 1 == at.size() ? bars[k].length() : 0.5 * (at[n]->position + at[n + 1]->position);
      add(k, from, to, n + 1, *at[n]);
      from = to;
    }
  }
  for (auto& [name, values] : {std::pair{"bolt", &bolt},
                               {"joint", &joint},
                               {"axial_force_kN", &axial},
                               {"shear_force_kN", &shear},
                               {"extension_mm", &extension},
                               {"state", &state},
                               {"largest_axial_force_kN", &of_bolt}})
    grid.add_values(name, 1, *values);
  return grid;
}

namespace detail {

/// The forces at the nodes of ribs, by the places of these.
class ForcesByPlace {
 public:
  explicit ForcesByPlace(const std::vector<RibForce>& nodes) {
    for (const RibForce& node : nodes) sorted_.push_back(&node);
    std::stable_sort(sorted_.begin(), sorted_.end(), [](const RibForce* p, const RibForce* q) {
      return key(p->position) < key(q->position);
    });
  }
  /// That of a lining where two have a node at one place, else of the one that is there.
  [[nodiscard]] const RibForce& at(const Vec3& place, int lining) const {
    const RibForce* found = nullptr;
    auto it = std::lower_bound(
        sorted_.begin(), sorted_.end(), place,
        [](const RibForce* node, const Vec3& p) { return key(node->position) < key(p); });
    for (; it != sorted_.end() && (*it)->position == place; ++it)
      if (found == nullptr || (*it)->lining == lining) found = *it;
    if (found == nullptr) throw InvalidInput("lining for ParaView: no force is given at a node");
    return *found;
  }

 private:
  [[nodiscard]] static std::array<double, 3> key(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

  std::vector<const RibForce*> sorted_;
};

/// Numbers of ribs along the axis, from 1.
/// @param places  of all members that are parts of them, and the axis that each is counted along
/// @param apart   places no further than this from each other are one rib [m]
[[nodiscard]] VOUSSOIR_INLINE std::vector<double> rib_numbers(
    const std::vector<std::pair<std::size_t, double>>& places, double apart) {
  std::vector<std::size_t> order(places.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t p, std::size_t q) { return places[p] < places[q]; });
  std::vector<double> numbers(places.size(), 1);
  for (std::size_t n = 1; n < order.size(); ++n) {
    const auto &before = places[order[n - 1]], &here = places[order[n]];
    numbers[order[n]] = here.first != before.first
                            ? 1
                            : numbers[order[n - 1]] + (here.second > before.second + apart ? 1 : 0);
  }
  return numbers;
}

}  // namespace detail

VOUSSOIR_INLINE VtuGrid lining_grid(const std::vector<MemberForces<3>>& members,
                                    const std::vector<RibForce>& nodes,
                                    const std::vector<Vec3>& axes, double width) {
  if (!members.empty()) require(width > 0, "width of a strip of the lining", width, "> 0 m");
  const detail::ForcesByPlace force(nodes);
  VtuGrid grid;
  std::vector<double> thrust, shear, moment, lining, number, along_axis;
  std::vector<std::pair<std::size_t, double>> places;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const MemberForces<3>& m = members[k];
    if (m.lining < 0 || static_cast<std::size_t>(m.lining) >= axes.size())
      throw InvalidInput("lining for ParaView: no axis is given for lining " +
                         std::to_string(m.lining));
    const auto axis = static_cast<std::size_t>(m.lining);
    const Vec3& along = axes[axis];
    if (std::abs(along.dot(normalized(Vec3(m.to - m.from)))) > 0.5) continue;
    const Vec3 half = 0.5 * width * along;
    const std::array<Vec3, 4> corners{m.from - half, m.to - half, m.to + half, m.from + half};
    grid.add_polygon(corners);
    const RibForce &first = force.at(m.from, m.lining), &second = force.at(m.to, m.lining);
    for (const RibForce* node : {&first, &second, &second, &first}) {
      thrust.push_back(1e-3 * node->thrust / width);
      shear.push_back(1e-3 * node->shear / width);
      moment.push_back(1e-3 * node->moment / width);
    }
    lining.push_back(static_cast<double>(m.lining + 1));
    number.push_back(static_cast<double>(k + 1));
    const double place = along.dot(0.5 * (m.from + m.to));
    along_axis.push_back(place);
    std::size_t same = 0;
    while (same < axis && std::abs(axes[same].dot(along)) < 1 - 1e-9) ++same;
    places.emplace_back(same, place);
  }
  grid.add_point_values("thrust_kN_per_m", 1, thrust);
  grid.add_point_values("shear_kN_per_m", 1, shear);
  grid.add_point_values("moment_kNm_per_m", 1, moment);
  grid.add_values("lining", 1, lining);
  grid.add_values("member", 1, number);
  grid.add_values("rib", 1, detail::rib_numbers(places, 0.25 * width));
  grid.add_values("along_m", 1, along_axis);
  return grid;
}

#endif

}  // namespace voussoir
