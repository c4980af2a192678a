// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/lining_members.hpp>

namespace voussoir {

/// A rib or strip of a lining in 3-D at one of its nodes: what `LiningForce` is in a section, times
/// the width of the strip.
struct RibForce {
  Vec3 position;  ///< [m]
  double thrust;  ///< N, compression positive [N]
  double shear;   ///< V across the rib, radial [N]
  double moment;  ///< M about the axis of the tunnel, positive: outer fibre in tension [N m]
  int lining;     ///< which it is of, in the order of installation
  /// As in `LiningForce`: of the members that meet there, magnitude [N].
  double largest_shear = 0;
};

/// All linings of a solver in 3-D, one entry per node that stands: the mean of the two members that
/// meet there across the opening, one that joins two linings among these. What runs along the
/// opening from rib to rib does not count, nor does bending along the tunnel.
template <class Solver>
requires(Solver::dim == 3) [[nodiscard]] std::vector<RibForce> rib_forces(const Solver& solver) {
  const auto& system = solver.system();
  const auto index = [](int body) { return static_cast<std::size_t>(body); };
  std::vector<RibForce> of_body(index(system.body_count()), {zeros<Vec3>(), 0, 0, 0, -1});
  std::vector<int> ends(of_body.size(), 0);
  std::vector<Vec3> along;  // of every lining
  const auto linings = solver.linings();
  for (const auto* lining : linings) {
    // The first member runs across the opening, its second axis out of it.
    along.push_back(lining->members().empty() ? zeros<Vec3>()
                                              : Vec3(row(lining->members().front().at_rest, 2)));
    for (int n = 0; n < lining->node_count(); ++n)
      of_body[index(lining->first_node() + n)].lining = static_cast<int>(along.size()) - 1;
  }
  const auto add = [&](const auto& member) {
    const int number = of_body[index(member.i)].lining;
    if (number < 0 || std::abs(along[index(number)].dot(Vec3(row(member.at_rest, 0)))) > 0.5)
      return;
    const auto f = member.section_forces(system.displacement.data());
    const auto at = [&](int body, double thrust, double shear, double moment) {
      RibForce& node = of_body[index(body)];
      node.thrust += thrust;
      node.shear += shear;
      node.largest_shear = std::max(node.largest_shear, std::abs(shear));
      node.moment += moment;
      ++ends[index(body)];
    };
    at(member.i, f[0], f[1], f[5]);
    at(member.j, -f[6], -f[7], -f[11]);
  };
  for (const auto* lining : linings)
    for (const auto& member : lining->members()) add(member);
  for (const auto* joints : system.supports.template all<LiningJoints<Spatial>>())
    for (const auto& member : joints->members()) add(member);
  std::vector<RibForce> forces;
  for (std::size_t b = 0; b < of_body.size(); ++b) {
    RibForce& node = of_body[b];
    const auto& body = system.body(static_cast<int>(b));
    if (node.lining < 0 || ends[b] == 0 || body.is_gone) continue;
    const double share = 1.0 / ends[b];
    forces.push_back({body.centre, share * node.thrust, share * node.shear, share * node.moment,
                      node.lining, node.largest_shear});
  }
  return forces;
}

}  // namespace voussoir
