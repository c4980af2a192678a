// expect-success
// SPDX-License-Identifier: MIT
// The policies of the other cases with nothing left out: alone and together they are accepted.
#include <vector>
#include <voussoir/solver/solver.hpp>

namespace {

using namespace voussoir;

struct Law {
  using role = roles::ContactLaw;
  static constexpr const char* name = "Law";
  template <int Dim>
  struct State {
    double slip = 0;
  };
  template <int Dim>
  PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    PointForce<Dim> result = load.initial;
    result.normal -= load.weight * (load.motion.opening + state.slip);
    return result;
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    state.slip = load.motion.slip[0];
    return 0;
  }
  template <int Dim>
  double stored_energy(const PointLoad<Dim>&, const State<Dim>&) const {
    return 0;
  }
  [[nodiscard]] double joint_normal_stiffness() const { return 1; }
  [[nodiscard]] double joint_shear_stiffness() const { return 1; }
};

struct Anchors {
  using role = roles::BoltAnchors;
  static constexpr const char* name = "Anchors";
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    return {0.25 * crossing.before, 0.25 * crossing.after};
  }
};

struct Bolt {
  using role = roles::BoltLaw;
  static constexpr const char* name = "Bolt";
  struct State {
    bool broken = false;
  };
  template <int Dim>
  BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    if (state.broken) return {};
    return {span.motion, span.motion.norm()};
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    state.broken = state.broken || span.motion.norm() > 1;
    return state.broken;
  }
  template <int Dim>
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const {
    return {Stress<Dim>::Identity()};
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State&) const {
    return 0.5 * span.motion.squaredNorm();
  }
};

/// The same with what may be left out.
struct TellingLaw : Law {
  template <int Dim>
  ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return report_from_force<Dim>(static_cast<const Law&>(*this), load, state);
  }
};
struct TellingBolt : Bolt {
  template <int Dim>
  BoltReport describe(const BoltSpan<Dim>&, const State& state) const {
    return {.is_broken = state.broken};
  }
};

struct Beam {
  using role = roles::Lining;
  static constexpr const char* name = "Beam";
  template <int Dof>
  static ElementMatrix<Dof> stiffness(const LiningSection& section, double length) {
    return section.axial_stiffness / length * ElementMatrix<Dof>::Identity();
  }
};

struct PinnedBeam : Beam {
  static constexpr bool is_pinned = true;
};

struct Detector {
  using role = roles::ContactDetector;
  static constexpr const char* name = "Detector";
  using NarrowPhase = FaceContacts;
  template <class Geometry>
  static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>&) {
    return {};
  }
};

struct Method {
  using role = roles::Equilibrium;
  static constexpr const char* name = "Method";
  template <class System>
  EquilibriumReport find(System&, const SearchContext&) const {
    return {};
  }
};

}  // namespace

using Together = voussoir::Solver<Method, Law, Beam, Bolt, Detector, Anchors, voussoir::Planar>;
const auto names = {Together::composition(),
                    voussoir::Solver<Law>::composition(),
                    voussoir::Solver<Anchors>::composition(),
                    voussoir::Solver<Bolt>::composition(),
                    voussoir::Solver<Beam>::composition(),
                    voussoir::Solver<Detector>::composition(),
                    voussoir::Solver<Method>::composition(),
                    voussoir::Solver<TellingLaw, TellingBolt, PinnedBeam>::composition(),
                    voussoir::Solver<>::composition()};
static_assert(voussoir::HasContactReport<TellingLaw, 3> && voussoir::HasBoltReport<TellingBolt, 3>);
static_assert(voussoir::is_pinned_lining<PinnedBeam>());
template class voussoir::Solver<Method, Law, Beam, Bolt, Detector, Anchors, voussoir::Planar>;
