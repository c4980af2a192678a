// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/bolt_crossings.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/rockmass/block_intersections.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// A bolt as it was installed.
template <class Geometry>
struct InstalledBolt {
  typename Geometry::Line bar;  ///< head first [m]
  int crossings;                ///< joints that it crossed then
};

/// Puts a bolt into a rock mass as it lies now, free of force but for its pretension: at every
/// joint of the rock that is there and that the bar crosses. The one way for rock at rest and in
/// motion.
///
/// @param bar      head first, where the rock was sliced; it has moved with every block it passes
/// @param law      index into the laws of the set
/// @param number   of the bolt, counted from 0
/// @param spacing  between bolts along the tunnel (2-D) [m], > 0
/// @param bodies   of the mass, as a model knows them:
///                 `bool is_gone(int body)`;
///                 `Pose<dim> frame(int body)`, in the in-situ state, in the axes of the set;
///                 `BoltSpan<dim> span(const Spring&)`, as it is now, in the axes of its body a
/// @return  number of joints crossed
/// @throws InvalidInput  spacing out of range, a bar without length or with its tip outside the
///                       domain
template <int Dim, class Law, class Geometry, class Anchors, class Bodies>
int install_bolt(BoltSet<Dim, Law>& bolts, const RockMass<Geometry>& mass,
                 const typename Geometry::Line& bar, int law, int number, double spacing,
                 const Anchors& anchors, const Bodies& bodies) {
  require(spacing > 0 && std::isfinite(spacing), "bolt spacing along the tunnel", spacing, "> 0 m");
  const double length = bar.length();
  require(length > 0 && std::isfinite(length), "bolt length", length, "> 0 m");
  const auto& domain = mass.domain;
  if (any_less(bar.end, domain.low) || any_less(domain.high, bar.end))
    throw InvalidInput(
        message({"bolt: its tip at ", text_of<Dim>(bar.end),
                 " m is outside the domain, which reaches from ", text_of<Dim>(domain.low), " to ",
                 text_of<Dim>(domain.high), " m"}));
  std::vector<BlockIntersection> met = block_intersections(mass, bar);
  std::erase_if(met, [&](const BlockIntersection& p) { return bodies.is_gone(p.body); });
  const auto crossings = bolt_crossings(met, bar, anchors, domain.tolerance());
  bolts.install(
      crossings, Vec<Dim>((bar.end - bar.start) / length), number, law, Dim == 2 ? 1 / spacing : 1,
      [&](int b) { return bodies.frame(b); },
      [&](const auto& spring) { return bodies.span(spring); });
  return static_cast<int>(crossings.size());
}

/// The bodies of a model at rest, for `install_bolt`.
template <class System>
struct BodiesAtRest {
  const System& system;

  [[nodiscard]] bool is_gone(int b) const { return system.body(b).is_gone; }
  [[nodiscard]] Pose<System::dim> frame(int b) const { return system.frame_at_start(b); }
  template <class Spring>
  [[nodiscard]] BoltSpan<System::dim> span(const Spring& spring) const {
    return spring.span_at(system.displacement.data());
  }
};

/// The bolts of a law among the supports of a model, made where there are none yet.
template <int Dim, class Law>
[[nodiscard]] BoltSet<Dim, Law>& bolts_among(SupportSet<Dim>& supports) {
  using Bolts = BoltSet<Dim, Law>;
  if (supports.template first<Bolts>() == nullptr) supports.add(std::make_shared<Bolts>());
  return *supports.template first<Bolts>();
}

}  // namespace voussoir
