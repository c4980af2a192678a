// SPDX-License-Identifier: MIT
#pragma once
// Two archetypes of every role: the least type that satisfies its concept, and the same with
// everything that is optional. What a concept does not name they do not have, or refuse: code that
// asks for more does not compile here. (A geometry of one's own is refused by a sentence:
// compile_fail/geometry_of_ones_own.)
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <vector>
#include <voussoir/voussoir.hpp>

namespace archetypes {

using namespace voussoir;

/// What the concepts ask of a name: it turns into a `const char*`.
struct Name {
  const char* text;
  constexpr operator const char*() const { return text; }  // NOLINT(google-explicit-constructor)
};

// ---- contact laws -------------------------------------------------------------------------------

/// Coulomb's joint with what a contact law must have; its state begins by an explicit constructor.
class LeastJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr Name name{"LeastJoint"};

  template <int Dim>
  struct State {
    explicit State() = default;
    Vec<Dim - 1> plastic_slip = zeros<Vec<Dim - 1>>();
  };

  LeastJoint(double normal, double shear, double friction)
      : normal_(normal), shear_(shear), friction_(friction) {}

  template <int Dim>
  PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double pressed =
        std::max(0.0, load.initial.normal - normal_ * load.weight * load.motion.opening);
    Vec<Dim - 1> shear = elastic_shear(load, state);
    if (const double length = shear.norm(); length > friction_ * pressed)
      shear *= friction_ * pressed / length;
    return {pressed, shear};
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    if (now.tangential == elastic_shear(load, state)) return 0;
    const Vec<Dim - 1> before = state.plastic_slip;
    state.plastic_slip =
        load.motion.slip + (now.tangential - load.initial.tangential) / (shear_ * load.weight);
    return -now.tangential.dot(state.plastic_slip - before);
  }
  template <int Dim>
  double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    return 0.5 / load.weight *
           (now.normal * now.normal / normal_ + now.tangential.squaredNorm() / shear_);
  }
  double joint_normal_stiffness() const { return normal_; }
  double joint_shear_stiffness() const { return shear_; }

 private:
  template <int Dim>
  Vec<Dim - 1> elastic_shear(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return load.initial.tangential - shear_ * load.weight * (load.motion.slip - state.plastic_slip);
  }
  double normal_, shear_, friction_;
};

/// With a description, an opening at which it lets go, forces of pairs, and creep.
class FullJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "FullJoint";
  template <int Dim>
  using State = CoulombJoint::State<Dim>;

  explicit FullJoint(const CoulombJoint& joint) : joint_(joint) {}

  template <int Dim>
  PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return joint_.force(load, state);
  }
  PairForce pair_force(const PairLoad& load, const State<2>* two) const {
    return joint_.pair_force(load, two);
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    return joint_.commit(load, state);
  }
  template <int Dim>
  double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return joint_.stored_energy(load, state);
  }
  template <int Dim>
  double release_opening(const PointLoad<Dim>& load, const State<Dim>&) const {
    return load.initial.normal / (joint_normal_stiffness() * load.weight);
  }
  template <int Dim>
  ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    ContactReport report = report_from_force(*this, load, state);
    report.damage = 0.25;
    return report;
  }
  template <int Dim>
  void creep(const PointLoad<Dim>& load, State<Dim>& state, double time) const {
    const Vec<Dim - 1> stress = joint_.force(load, state).tangential / load.weight;
    state.plastic_slip -= time / creep_time() / joint_shear_stiffness() * stress;
    (void)joint_.commit(load, state);
  }
  double creep_time() const { return 1e6; }
  double joint_normal_stiffness() const { return joint_.joint_normal_stiffness(); }
  double joint_shear_stiffness() const { return joint_.joint_shear_stiffness(); }

 private:
  CoulombJoint joint_;
};

/// Rock on lining that is bonded, and says how far.
class FullBond {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "FullBond";
  template <int Dim>
  using State = MohrCoulombJoint::State<Dim>;

  explicit FullBond(const MohrCoulombJoint& joint) : joint_(joint) {}

  template <int Dim>
  PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return joint_.force(load, state);
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    return joint_.commit(load, state);
  }
  template <int Dim>
  double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return joint_.stored_energy(load, state);
  }
  template <int Dim>
  BondRelease<Dim> release_opening(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return joint_.release_opening(load, state);
  }
  template <int Dim>
  ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return joint_.describe(load, state);
  }
  double joint_normal_stiffness() const { return joint_.joint_normal_stiffness(); }
  double joint_shear_stiffness() const { return joint_.joint_shear_stiffness(); }

 private:
  MohrCoulombJoint joint_;
};

// ---- rock on lining -----------------------------------------------------------------------------

struct LeastInterface {
  using role = roles::InterfaceLaw;
  static constexpr Name name{"LeastInterface"};
  using Law = LeastJoint;
};
struct FullInterface {
  using role = roles::InterfaceLaw;
  static constexpr const char* name = "FullInterface";
  using Law = FullBond;
};

// ---- bolts --------------------------------------------------------------------------------------

/// Slides at its grip; without a dowel.
class LeastBolt {
 public:
  using role = roles::BoltLaw;
  static constexpr Name name{"LeastBolt"};
  struct State {
    explicit State() = default;
    double slid = 0;
  };

  LeastBolt(double stiffness, double grip) : stiffness_(stiffness), grip_(grip) {}

  template <int Dim>
  BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    const double axial =
        std::clamp(stiffness_ * (span.axis.dot(span.motion) - state.slid), 0.0, grip_);
    return {axial * span.axis, axial};
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    state.slid = slid(span, state);
    return false;
  }
  template <int Dim>
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    return {stiffness_ * outer(span.axis, span.axis)};
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State& state) const {
    const double axial = force(span, state).axial;
    return 0.5 * axial * axial / stiffness_ + grip_ * slid(span, state);
  }

 private:
  template <int Dim>
  double slid(const BoltSpan<Dim>& span, const State& state) const {
    return std::max(state.slid, span.axis.dot(span.motion) - grip_ / stiffness_);
  }
  double stiffness_, grip_;
};

/// With a dowel and a description.
class FullBolt {
 public:
  using role = roles::BoltLaw;
  static constexpr const char* name = "FullBolt";
  using State = AxialShearBolt::State;

  explicit FullBolt(const AxialShearBolt& bolt) : bolt_(bolt) {}

  template <int Dim>
  BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    return bolt_.force(span, state);
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    return bolt_.commit(span, state);
  }
  template <int Dim>
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    return bolt_.stiffness(span);
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State& state) const {
    return bolt_.energy(span, state);
  }
  template <int Dim>
  BoltReport describe(const BoltSpan<Dim>& span, const State& state) const {
    return bolt_.describe(span, state);
  }

 private:
  AxialShearBolt bolt_;
};

/// Made without arguments by an explicit constructor.
class LeastAnchors {
 public:
  using role = roles::BoltAnchors;
  static constexpr Name name{"LeastAnchors"};
  explicit LeastAnchors() = default;
  AnchorDistances distances(const BoltCrossing& crossing) const {
    return {0.25 * crossing.before, 0.25 * crossing.after};
  }
};
/// There is nothing optional; one that is given a value.
struct FullAnchors {
  using role = roles::BoltAnchors;
  static constexpr char name[] = "FullAnchors";
  double part = 0.5;
  AnchorDistances distances(const BoltCrossing& crossing) const {
    return {part * crossing.before, part * crossing.after};
  }
};

// ---- linings ------------------------------------------------------------------------------------

/// Nobody makes one: its parts are static.
struct LeastBeam {
  using role = roles::Lining;
  static constexpr Name name{"LeastBeam"};
  LeastBeam() = delete;
  template <int Dof>
  static ElementMatrix<Dof> stiffness(const LiningSection& section, double length) {
    return EulerBernoulliBeam::stiffness<Dof>(section, length);
  }
};
struct FullBars {
  using role = roles::Lining;
  static constexpr const char* name = "FullBars";
  static constexpr bool is_pinned = true;
  template <int Dof>
  static ElementMatrix<Dof> stiffness(const LiningSection& section, double length) {
    return PinnedBar::stiffness<Dof>(section, length);
  }
};

// ---- contact detectors --------------------------------------------------------------------------

/// With a narrow phase of its own: what a model and a search ask of it, and no more. Pairs are made
/// and not copied.
struct LeastDetector {
  using role = roles::ContactDetector;
  static constexpr Name name{"LeastDetector"};
  LeastDetector() = delete;

  template <class Geometry>
  static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>& mass) {
    return FaceContacts::find(mass);
  }
  template <int Dim>
  class Pair {
   public:
    struct Memory {
      explicit Memory() = default;
      typename FaceContacts::Pair<Dim>::Memory inner{};
    };
    explicit Pair(const PlacedShapes<Dim>& shapes) : inner_(shapes) {}
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    bool overlap(std::size_t a, std::size_t b, Memory& memory) {
      return inner_.overlap(a, b, memory.inner);
    }
    double separation(std::size_t a, std::size_t b, Memory& memory) {
      return inner_.separation(a, b, memory.inner);
    }
    Contact<Dim> contact(std::size_t a, std::size_t b, Memory& memory, double reach) {
      return inner_.contact(a, b, memory.inner, reach);
    }
    Contact<Dim> facing_contact(std::size_t a, std::size_t b, Memory& memory, double reach) {
      return inner_.facing_contact(a, b, memory.inner, reach);
    }

   private:
    FaceContacts::Pair<Dim> inner_;
  };
};
/// Leaves contact updates to another, which it names.
struct FullDetector {
  using role = roles::ContactDetector;
  static constexpr const char* name = "FullDetector";
  using NarrowPhase = LeastDetector;
  template <class Geometry>
  static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>& mass) {
    return CutContacts::find(mass);
  }
};

// ---- equilibrium methods ------------------------------------------------------------------------

class LeastMethod {
 public:
  using role = roles::Equilibrium;
  static constexpr Name name{"LeastMethod"};
  explicit LeastMethod() = default;
  template <class System>
  EquilibriumReport find(System& system, const SearchContext& context) const {
    return Relaxation{}.find(system, context);
  }
};
/// There is nothing optional; one that is given a value.
struct FullMethod {
  using role = roles::Equilibrium;
  static constexpr const char* name = "FullMethod";
  TwoLevel method{};
  template <class System>
  EquilibriumReport find(System& system, const SearchContext& context) const {
    return method.find(system, context);
  }
};

}  // namespace archetypes
