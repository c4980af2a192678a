// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/foot_bearing.hpp>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/detection/contact_detector.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/farfield/ground_around.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/model/bolt_installation.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/detail/initial_model.hpp>
#include <voussoir/model/detail/lining_assembly.hpp>
#include <voussoir/model/detail/next_round.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/model/opened_lining.hpp>
#include <voussoir/model/prescribed_displacement.hpp>
#include <voussoir/model/support.hpp>
#include <voussoir/model/system.hpp>
#include <voussoir/model/wall_tractions.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/opening_checks.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/solver/detail/ground_scale.hpp>
#include <voussoir/solver/detail/system_of.hpp>

namespace voussoir {

/// Rock, excavation, supports and the search for equilibrium. `Solver` composes it from policies.
///
/// The order of calls is that of the construction: the rock in its in-situ stress; then excavating,
/// installing supports and finding equilibrium, in any order and any number of times: heading and
/// bench, twin tunnels, rounds along an axis, bolts ahead of the face. History is committed when an
/// equilibrium is found.
///
/// 2-D forces are per metre of tunnel; a bolt's values are per bolt, shared over its spacing.
///
/// @tparam Models  one for every role, see `ModelsOfRoles`
template <class Models>
class ComposedSolver {
 public:
  using Geometry = typename Models::Geometry;
  using Detector = typename Models::Detector;
  using JointLaw = typename Models::JointLaw;
  using InterfaceLaw = typename Models::InterfaceLaw;
  using Anchors = typename Models::Anchors;
  using BoltLaw = typename Models::BoltLaw;
  using Lining = typename Models::Lining;
  using Method = typename Models::Method;
  using SystemType = System<Geometry, typename NarrowPhaseOf<Detector>::type>;
  using BoltsType = BoltSet<Geometry::dim, BoltLaw>;
  using LiningType = LiningMembers<Geometry>;
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;

  /// Puts the rock in its in-situ state.
  /// @param progress  asked now and then whether to go on
  /// @param far_field  what the sides of the domain meet
  /// @throws InvalidInput  no bodies, or a parameter of `in_situ` or `far_field` out of range
  /// @throws Stopped
  ComposedSolver(RockMass<Geometry> mass, JointLaw joint_law, const InSitu& in_situ,
                 const Progress& progress = {}, const FarField<dim>& far_field = {})
      : ComposedSolver(std::move(mass), LawsBySet<JointLaw>(std::move(joint_law)), in_situ,
                       progress, far_field) {}
  /// The same with laws of their own for some joint sets.
  ComposedSolver(RockMass<Geometry> mass, LawsBySet<JointLaw> joint_laws, const InSitu& in_situ,
                 const Progress& progress = {}, const FarField<dim>& far_field = {});

  /// Rock that is excavated at once: what the constructor above and `excavate` do, bit for bit,
  /// with one model to make instead of two.
  /// @throws InvalidInput, Stopped  as they do
  ComposedSolver(RockMass<Geometry> mass, LawsBySet<JointLaw> joint_laws, const InSitu& in_situ,
                 const typename Geometry::Opening& opening, double smallest_piece = of_the_rock,
                 const Progress& progress = {}, const FarField<dim>& far_field = {});

  /// Takes an opening out of the rock: a round. The traction that the excavated rock exerted on the
  /// walls that it leaves goes on acting until a stage takes it away; that of every round has a
  /// part of its own. What is left of a block is where it was as a part of the whole; joints
  /// remember their slip, bolts and linings what they carry. A lining that stands where the round
  /// goes is opened there: `opened_linings`. Blocks get new numbers: `RockMass::origins`.
  /// @param smallest_piece  bodies at the wall below this are dropped [m^2] or [m^3]; by default
  ///                        see `smallest_piece_of`
  /// @param progress        asked now and then whether to go on
  /// @throws InvalidInput   the opening does not fit (see `carve`), or a bolt that stands holds
  ///                        rock in it; the solver is as it was
  /// @throws Stopped        the same, but before the first round: the solver is then of no more use
  void excavate(const typename Geometry::Opening& opening, double smallest_piece = of_the_rock,
                const Progress& progress = {});

  /// Installs a bolt along a straight bar, head first. It grips at every joint it crosses, in the
  /// present position of the rock, free of force but for its pretension.
  /// @param spacing  between bolts along the tunnel (2-D) [m], > 0
  /// @return  number of joints crossed; 0 is a bolt inside one block, which does nothing
  /// @throws InvalidInput  no length or spacing, or the tip is outside the domain
  int install_bolt(const typename Geometry::Line& bar, const BoltLaw& law, double spacing = 1.0,
                   const Anchors& anchors = Anchors());

  /// Installs a lining on the wall in its present position, free of force. There may be several, on
  /// other stretches of the wall or, as a second layer that also bears on the rock, on the same.
  /// One that begins where another ends joins it (`LiningFrame::neighbours`), by a hinge where one
  /// of them is pinned and the other bends.
  /// @param interface_law  rock on lining
  /// @param feet  on which those ends stand that do not go on in a lining; none: they hang free
  /// @return  ends that hang free because the rock under their foot has fallen [m]
  /// @throws InvalidInput  a member has no length, no rock touches it, or was ever under its feet;
  ///                       the interface holds tension, and nodes are farther apart than
  ///                       `coarsest_bonded_spacing`; some sections are pinned and some are not
  std::vector<Vec<dim>> install_lining(const LiningFrame<Geometry>& frame,
                                       const LiningSection& section,
                                       const InterfaceLaw& interface_law,
                                       const std::optional<FootBearing>& feet = {}) {
    return install_lining(frame, std::vector<LiningSection>{section}, interface_law, feet);
  }
  /// The same with members of several sections: ribs and what joins them.
  std::vector<Vec<dim>> install_lining(const LiningFrame<Geometry>& frame,
                                       const std::vector<LiningSection>& sections,
                                       const InterfaceLaw& interface_law,
                                       const std::optional<FootBearing>& feet = {}) {
    std::vector<Vec<dim>> hanging =
        detail::assemble_lining<Lining>(system_, in_situ_.gravity, 1e3 * mass_->domain.tolerance(),
                                        frame, sections, AnyLaw<dim>(interface_law), feet);
    measures_.resize(static_cast<std::size_t>(system_.body_count()), 0.0);
    started_ = true;
    return hanging;
  }

  /// Gives a lining other moduli from now on, as concrete has when it is older: what it carries
  /// stays, and what comes meets the new stiffness, of its members and of those that join it to
  /// linings before it.
  /// @param lining  in the order of installation, from 0
  /// @param factor  new over old stiffness, > 0
  /// @throws InvalidInput  there is no such lining, or the factor is out of range
  void stiffen_lining(int lining, double factor);

  /// Lets the rock and its supports find their equilibrium at a residual wall traction
  /// on the wall (relaxation before support: > 0; the final state: 0). Of several rounds each keeps
  /// that part of its traction, or what was left of it before if that is less.
  /// @throws InvalidInput    wall_fraction outside 0..1, or more than was left before; a limit of
  ///                         the acceptance out of range
  /// @throws NumericalFault  see the method
  EquilibriumReport equilibrium(double wall_fraction = 0, const Method& method = Method(),
                                const Acceptance& acceptance = {}, const Progress& progress = {});

  /// The same with a part of its own for every round, in the order in which they were excavated.
  EquilibriumReport equilibrium(const std::vector<double>& wall_fractions,
                                const Method& method = Method(), const Acceptance& acceptance = {},
                                const Progress& progress = {});

  /// Goes on at rest from where a run has brought the bodies (`set_in_motion(solver, settings)`):
  /// what moves is stopped, and the walls keep what `Dynamics::held` is then.
  /// @param run     made from this solver, which has not changed since
  /// @param fallen  bodies that are taken out now: those that have come down
  /// @throws InvalidInput  the run has other bodies
  template <class Run>
  void take_back(Run& run, const std::vector<int>& fallen = {}) {
    bring_to_rest(run, system_, fallen);
    walls_.reach(system_.wall_fraction);
    fallen_.insert(fallen_.end(), fallen.begin(), fallen.end());
    for (const int b : fallen) fallen_measure_ += measures_[static_cast<std::size_t>(b)];
    started_ = true;
  }

  /// A load on a block that acts from now on, besides its weight; the next stage lets it come on
  /// together with what it takes off the walls.
  /// @param load  in the centre of the block [N], [N m]; per metre of tunnel in 2-D
  /// @throws InvalidInput  there is no such block, it has fallen or is fixed, or the load is not
  ///                       finite
  void add_load(int block, const Load<dim>& load);
  /// The same on every block that can move now: this part of its weight, as a pseudo-static
  /// earthquake load.
  void add_body_force(const Vec<dim>& over_weight);

  /// Holds a block where it is from now on: an abutment, a base.
  /// @throws InvalidInput  there is no such block, or it has fallen
  void fix(int block);

  /// Displaces fixed blocks: abutments that yield. What rests on them begins the next stage
  /// where it would be carried elastically; long ways go in steps (`load_in_steps`).
  /// @throws InvalidInput  there is no such block, it has fallen or is free, or not finite: nothing
  ///                       has moved
  void displace(const std::vector<PrescribedDisplacement<dim>>& motions);

  /// Lets joints creep under the forces that they carry now; `creep` finds the equilibria.
  /// @param time  [s]
  template <class Law = JointLaw>  // a template: clang++ 14 instantiates the others unasked
  requires CreepingLaw<Law, dim>
  void creep_joints(double time) { system_.joints.creep(system_.displacement.data(), time); }

  /// Gives joints other laws from now on: strength that is lost with time, or divided to learn how
  /// much of it is needed. What they remember stays, and so does what bolts and linings carry; the
  /// next stage finds where that leaves the rock.
  /// @throws InvalidInput  the laws are of another type, for other sets or of other stiffness, by
  ///                       which the rock was brought into its in-situ state: nothing has changed
  void change_joint_laws(LawsBySet<JointLaw> joint_laws);

  [[nodiscard]] const RockMass<Geometry>& mass() const { return *mass_; }
  [[nodiscard]] const LawsBySet<JointLaw>& joint_laws() const { return joint_laws_; }
  [[nodiscard]] const InSitu& in_situ() const { return in_situ_; }
  [[nodiscard]] const FarField<dim>& far_field() const { return far_field_; }
  /// What the bodies, contacts and supports are and where they stand; only the solver changes it.
  [[nodiscard]] const SystemType& system() const { return system_; }
  /// Largest out-of-balance force of a body, over its weight, where the bodies are now [-].
  /// @cost  one evaluation of all forces
  [[nodiscard]] double out_of_balance_ratio() {
    Eigen::VectorXd f;
    system_.forces(system_.displacement, f);
    return system_.unbalance_over_weight(f);
  }
  /// The bolts installed so far; null if there are none.
  [[nodiscard]] const BoltsType* bolts() const {
    return system_.supports.template first<BoltsType>();
  }
  /// The linings installed so far, in that order.
  [[nodiscard]] std::vector<const LiningType*> linings() const {
    return system_.supports.template all<LiningType>();
  }
  /// The first of them; null without lining.
  [[nodiscard]] const LiningType* lining() const {
    return system_.supports.template first<LiningType>();
  }
  [[nodiscard]] int bolt_count() const { return static_cast<int>(installed_.size()); }
  /// All of them as they were installed, in that order.
  [[nodiscard]] const auto& installed_bolts() const { return installed_; }  ///< `InstalledBolt`
  /// Linings that later rounds went through, of all rounds so far, in their order: a lining that
  /// two rounds open is in it twice, each time with what that round took out.
  [[nodiscard]] const std::vector<OpenedLining<dim>>& opened_linings() const { return opened_; }
  /// Of every round that was excavated, the part of its wall traction that still acts.
  [[nodiscard]] std::vector<double> wall_fractions() const { return walls_.fractions(); }
  /// Bodies that detached, in the order in which they did.
  [[nodiscard]] const std::vector<int>& fallen() const { return fallen_; }
  [[nodiscard]] double fallen_measure() const { return fallen_measure_; }  ///< [m^2], [m^3]
  /// A lining has come off its wall; it may be another than those that stand.
  [[nodiscard]] bool has_lost_lining() const {
    return std::any_of(system_.linings.begin(), system_.linings.end(),
                       [](const auto& lining) { return lining.came_off; });
  }
  /// Number of the first lining's first node among the bodies of the system; -1 without lining.
  [[nodiscard]] int first_lining_node() const {
    return lining() != nullptr ? lining()->first_node() : -1;
  }
  /// Number of the fixed ground among the bodies of the system.
  [[nodiscard]] int ground() const { return static_cast<int>(mass_->bodies.size()); }

  /// Displacement of a point that moves with a body since the in-situ state [m].
  [[nodiscard]] Vec<dim> displacement_of(int body, const Vec<dim>& point) const;

 private:
  friend struct detail::SystemOf;

  /// Takes what there is, and checks it; `build` makes the model of it.
  struct Unbuilt {};
  ComposedSolver(Unbuilt, RockMass<Geometry> mass, LawsBySet<JointLaw> joint_laws,
                 const InSitu& in_situ, const FarField<dim>& far_field);

  [[nodiscard]] SystemType new_system() const {
    return {detail::any_laws<dim>(joint_laws_.all()), joint_laws_.stiffest()};
  }
  void build(const Progress& progress);
  /// All that the rock in the opening has exerted on the walls goes on acting.
  /// @param touched  the blocks that it touched; null: all, nothing has moved yet
  void hold_wall(const BodyMarks* touched = nullptr);
  /// Takes a round out of rock that has moved, or has been excavated before.
  void excavate_further(const typename Geometry::Opening& opening, double smallest_piece,
                        const Progress& progress);
  /// Goes on acting on all bodies until the next stage takes it away.
  void hold(Eigen::VectorXd load) {
    walls_.add(std::move(load));
    (void)aim_at(std::vector<double>(static_cast<std::size_t>(walls_.count()), 0.0));
  }
  /// @throws InvalidInput  there is no such block, or it has fallen
  void check_block(int block, const char* what) const;
  /// Makes the next stage one that brings the walls to these parts of their traction.
  /// @return  the largest of them
  double aim_at(const std::vector<double>& wall_fractions);

  /// Copies of the solver share it, and so do its shapes; `excavate` alone changes it, or a copy.
  std::shared_ptr<RockMass<Geometry>> mass_;
  LawsBySet<JointLaw> joint_laws_;
  InSitu in_situ_;
  FarField<dim> far_field_;
  std::shared_ptr<const GroundAround<dim>> around_;  ///< null: nothing elastic is there
  SystemType system_;
  WallTractions walls_;
  std::vector<double> measures_;
  std::vector<int> fallen_;
  double fallen_measure_ = 0;
  std::vector<InstalledBolt<Geometry>> installed_;
  std::vector<OpenedLining<dim>> opened_;
  double update_limit_ = 0.02;  ///< of contact updates, of the last search [m]
  double carried_ = 0;          ///< see `SearchContext` [m]
  bool started_ = false, is_loaded_ = false;
};

template <class Models>
ComposedSolver<Models>::ComposedSolver(Unbuilt, RockMass<Geometry> mass,
                                       LawsBySet<JointLaw> joint_laws, const InSitu& in_situ,
                                       const FarField<dim>& far_field)
    : mass_(std::make_shared<RockMass<Geometry>>(std::move(mass))),
      joint_laws_(std::move(joint_laws)),
      in_situ_(in_situ),
      far_field_(far_field),
      system_(new_system()) {
  in_situ_.check();
  far_field_.check();
  if (mass_->bodies.empty()) throw InvalidInput("solver: the rock mass has no bodies");
  around_ = ground_around<dim>(mass_->domain, far_field_);
}

template <class Models>
ComposedSolver<Models>::ComposedSolver(RockMass<Geometry> mass, LawsBySet<JointLaw> joint_laws,
                                       const InSitu& in_situ, const Progress& progress,
                                       const FarField<dim>& far_field)
    : ComposedSolver(Unbuilt{}, std::move(mass), std::move(joint_laws), in_situ, far_field) {
  build(progress);
}

template <class Models>
ComposedSolver<Models>::ComposedSolver(RockMass<Geometry> mass, LawsBySet<JointLaw> joint_laws,
                                       const InSitu& in_situ,
                                       const typename Geometry::Opening& opening,
                                       double smallest_piece, const Progress& progress,
                                       const FarField<dim>& far_field)
    : ComposedSolver(Unbuilt{}, std::move(mass), std::move(joint_laws), in_situ, far_field) {
  if (smallest_piece == of_the_rock) smallest_piece = smallest_piece_of(*mass_);
  *mass_ = carve(std::move(*mass_), opening, smallest_piece, progress);
  build(progress);
  hold_wall();
}

template <class Models>
void ComposedSolver<Models>::hold_wall(const BodyMarks* touched) {
  (void)aim_at(walls_.fractions());
  Eigen::VectorXd f;
  system_.forces(system_.displacement, f);
  for (int b = 0; touched != nullptr && b < system_.body_count(); ++b)
    if (!is_marked(*touched, b)) set_part<dof>(f, dof * b, zeros<Fixed<dof, 1>>());
  hold(opposite(f));
}

template <class Models>
double ComposedSolver<Models>::aim_at(const std::vector<double>& wall_fractions) {
  WallTractions::Stage stage = walls_.stage_to(wall_fractions, system_.load.size());
  system_.wall_load = std::move(stage.going);
  system_.wall_held = std::move(stage.held);
  system_.wall_fraction = stage.from;
  return stage.to;
}

template <class Models>
int ComposedSolver<Models>::install_bolt(const typename Geometry::Line& bar, const BoltLaw& law,
                                         double spacing, const Anchors& anchors) {
  auto& bolts = bolts_among<dim, BoltLaw>(system_.supports);
  const BodiesAtRest<SystemState<Geometry>> bodies{system_};
  const int crossed = voussoir::install_bolt(bolts, *mass_, bar, bolts.add_law(law), bolt_count(),
                                             spacing, anchors, bodies);
  installed_.push_back({bar, crossed});
  started_ = true;
  return crossed;
}

template <class Models>
EquilibriumReport ComposedSolver<Models>::equilibrium(double wall_fraction, const Method& method,
                                                      const Acceptance& acceptance,
                                                      const Progress& progress) {
  require(wall_fraction >= 0 && wall_fraction <= walls_.largest(), "wall traction", wall_fraction,
          "0 to 1 and no more than was left before");
  std::vector<double> fractions = walls_.fractions();
  for (double& fraction : fractions) fraction = std::min(fraction, wall_fraction);
  return equilibrium(fractions, method, acceptance, progress);
}

template <class Models>
EquilibriumReport ComposedSolver<Models>::equilibrium(const std::vector<double>& wall_fractions,
                                                      const Method& method,
                                                      const Acceptance& acceptance,
                                                      const Progress& progress) {
  acceptance.check();
  const double to = aim_at(wall_fractions);
  started_ = true;
  SearchContext context{acceptance,          &measures_,       to,      progress,
                        open_length(*mass_), in_situ_.gravity, carried_};
  context.ground = detail::ground_scale(*mass_, in_situ_, far_field_);
  EquilibriumReport report = method.find(system_, context);
  if (report.contact_update_limit > 0) update_limit_ = report.contact_update_limit;
  walls_.reach(system_.wall_fraction);
  fallen_.insert(fallen_.end(), report.fallen.begin(), report.fallen.end());
  fallen_measure_ += report.fallen_measure;
  for (auto& lining : system_.linings)
    for (const int node : report.lost_nodes) lining.came_off |= node == lining.first;
  report.lacks_lining = has_lost_lining();
  if (report.verdict == Verdict::stable && report.lacks_lining && report.lost_nodes.empty())
    report.reason += "; a lining had come off its wall before";
  return report;
}

template <class Models>
auto ComposedSolver<Models>::displacement_of(int body, const Vec<dim>& point) const -> Vec<dim> {
  const Vec<dim> arm = point - system_.body(body).centre;
  if (system_.has_updated_contacts()) {
    const Pose<dim> now = system_.pose(body);
    return now(arm) - point;
  }
  return displacement_at<dim>(system_.displacement.data() + dof * body, arm);
}

template <class Models>
void ComposedSolver<Models>::build(const Progress& progress) {
  detail::make_model<Detector>(system_, mass_, in_situ_, far_field_, joint_laws_.of_cuts(*mass_),
                               around_, measures_, progress);
  // Nothing carries their weight yet.
  if (in_situ_.is_laid) hold_wall();
}

}  // namespace voussoir

#include <voussoir/solver/detail/changed_materials.hpp>
#include <voussoir/solver/detail/excavation.hpp>
#include <voussoir/solver/detail/loads_on_blocks.hpp>
