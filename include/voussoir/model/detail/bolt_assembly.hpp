// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/bolt_crossings.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/system.hpp>
#include <voussoir/rockmass/block_intersections.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// Puts a bolt into a model at rest, free of force but for its pretension: at every joint of the
/// rock that is there now and that the bar crosses.
/// @param bar      head first, of some length
/// @param spacing  between bolts along the tunnel (2-D) [m], > 0
/// @param number   of the bolt, counted from 0
/// @return  number of joints crossed
template <class System, class Line, class BoltLaw, class Anchors>
int install_bolt(System& system, const RockMass<typename System::GeometryType>& mass,
                 const Line& bar, const BoltLaw& law, double spacing, const Anchors& anchors,
                 int number) {
  constexpr int dim = System::dim;
  using Bolts = BoltSet<dim, BoltLaw>;
  auto* bolts = system.supports.template first<Bolts>();
  if (bolts == nullptr) {
    system.supports.add(std::make_shared<Bolts>());
    bolts = system.supports.template first<Bolts>();
  }
  std::vector<BlockIntersection> met = block_intersections(mass, bar);
  std::erase_if(met, [&](const BlockIntersection& p) { return !system.body(p.body).movable; });
  const auto crossings = bolt_crossings(met, bar, anchors, mass.domain.tolerance());
  const Vec<dim> axis = (bar.end - bar.start) / bar.length();
  bolts->install(
      crossings, axis, number, bolts->add_law(law), dim == 2 ? 1 / spacing : 1,
      [&](int b) { return system.frame_at_start(b); },
      [&](const auto& spring) { return spring.span_at(system.displacement.data()); });
  return static_cast<int>(crossings.size());
}

}  // namespace voussoir::detail
