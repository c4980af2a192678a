// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <voussoir/voussoir.hpp>

#include "input.hpp"

/// The physics of the program: what an input file may choose, as policies.
///
/// A program that knows its physics composes exactly that (see examples/minimal.cpp). This one
/// learns it from a file, so the choices are made at run time inside the policies, and one solver
/// type serves every input: `AnyJoint` is any contact law, `AnyBolt` any bolt, `AnyAnchors` any way
/// of gripping the rock, `AnyLining` any lining; each joint set, pattern and lining has its own. An
/// interface with `MohrCoulombJoint` without cohesion is one with `CoulombJoint`.
namespace voussoir::program {

/// Any of the equilibrium methods.
class ChosenMethod {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "ChosenMethod";
  ChosenMethod() = default;
  template <class Method>
  explicit ChosenMethod(Method method) : method_(std::move(method)) {}
  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const {
    return std::visit([&](const auto& method) { return method.find(system, context); }, method_);
  }

 private:
  std::variant<TwoLevel, Relaxation, Explicit> method_;
};

template <class Geometry>
using TunnelIn = Solver<Geometry, AnyJoint, RockOnLining<MohrCoulombJoint>, AnyAnchors, AnyBolt,
                        AnyLining, ChosenMethod>;
using Tunnel = TunnelIn<Planar>;
using SpatialTunnel = TunnelIn<Spatial>;

[[nodiscard]] AnyAnchors anchors_of(const BoltsInput& bolts);
[[nodiscard]] AnyBolt bolt_of(const BoltsInput& bolts);
/// Rock on lining: friction, and a bond until it fails, which leaves the friction.
[[nodiscard]] MohrCoulombJoint interface_of(const LiningInput& lining);
[[nodiscard]] LiningSection section_of(const LiningInput& lining, double thickness);
/// @param linear  what the computer has for elastic equations; how they are solved is the file's
/// choice; as many threads as make a factor follow a stage in which rock fails
[[nodiscard]] ChosenMethod method_of(const Input& input, LinearSettings linear, RangeSought range);

/// 3-D: of a strip of the lining.
/// @param width  along the tunnel; of those that run along it, around the section [m]
[[nodiscard]] LiningSection strip_of(const LiningInput& lining, double thickness, double width);

/// What the file has chosen, by the names of the models.
[[nodiscard]] std::string composition_of(const Input& input);

}  // namespace voussoir::program

/// Compiled once, in models.cpp and spatial_models.cpp, for every file of the program and of the
/// paper's analyses.
extern template class voussoir::ComposedSolver<voussoir::program::Tunnel::Parts::Models>;
extern template class voussoir::ComposedSolver<voussoir::program::SpatialTunnel::Parts::Models>;
