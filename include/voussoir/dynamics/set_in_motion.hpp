// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/model/detail/frames_of_bodies.hpp>
#include <voussoir/model/elastic_edge.hpp>
#include <voussoir/model/system.hpp>

namespace voussoir {

/// The run of a solver: composed of the same policies, in any order.
///
///   RunOf<Solver<Spatial, MohrCoulombJoint, AnalyticCentre>> run = set_in_motion(tunnel);
template <class Solver>
using RunOf = Dynamics<Solver::dim, typename Solver::JointLaw, typename Solver::InterfaceLaw,
                       typename Solver::SystemType::Detector>;

namespace detail {

/// Takes a model at rest over into a run and back. Bodies have the same numbers in both.
template <class System>
class Handover {
 public:
  static constexpr int dim = System::dim, dof = System::dof;
  using Run = Motion<dim, typename System::Detector>;

  explicit Handover(const System& system) : system_(system) {
    if (system.shapes == nullptr)
      throw InvalidInput("set in motion: the model does not know the shapes of its bodies");
    std::size_t known = system.shapes->size();
    if (const auto* edge = system.supports.template first<ElasticEdge<dim>>())
      known += static_cast<std::size_t>(edge->node_count());
    for (const auto& lining : system.linings) known += lining.surface.node_count();
    require(static_cast<int>(known) == system.body_count(), "bodies of the model",
            system.body_count(),
            "blocks, the ground, nodes of an elastic far field and of linings");
  }

  void add_bodies(Run& run) const {
    const double gravity = run.settings().gravity;
    for (std::size_t b = 0; b < system_.shapes->size(); ++b) {
      const auto& body = system_.body(static_cast<int>(b));
      const auto parts = (*system_.shapes)[b];
      std::vector<typename Run::Shape> shapes(parts.begin(), parts.end());
      if (body.is_block)
        run.add_block(shapes, body.weight / (gravity * mass_properties(shapes).measure));
      else
        run.add_wall(shapes, body.centre);
    }
    add_nodes_around(run);
    for (const auto& lining : system_.linings) {
      std::vector<LiningNode<dim>> nodes;
      for (std::size_t k = 0; k < lining.surface.node_count(); ++k) {
        const auto& body = system_.body(lining.first + static_cast<int>(k));
        // Without weight: as inert as the lightest block, and carried.
        const double mass =
            (body.weight > 0 ? body.weight : system_.weight_scale().weight) / gravity;
        nodes.push_back({body.centre, lining.surface.tiles(k), mass,
                         all_entries<dof - dim>(node_inertia(mass, body.gyration, lining.thickness,
                                                             lining.is_pinned))});
      }
      // Before the tiles: contacts of a body and a node are one only if all name the body first.
      for (const auto& fill : lining.fills) run.add_filling(fill.body, fill.shape);
      run.add_lining_nodes(nodes, lining.law);
    }
    for (int b = 0; b < system_.body_count(); ++b) {
      run.place(b, system_.motion_of(b));
      if (system_.body(b).is_gone)
        run.leave_out(b);
      else if (system_.body(b).is_block && !system_.body(b).movable)
        run.fix(b);
    }
  }

  /// The elastic ground beyond the domain: its nodes weigh together as much as the rock, and are
  /// carried.
  void add_nodes_around(Run& run) const {
    const auto* edge = system_.supports.template first<ElasticEdge<dim>>();
    if (edge == nullptr) return;
    double weight = 0;
    for (int b = 0; b < edge->first_node(); ++b) weight += system_.body(b).weight;
    const double mass = weight / (run.settings().gravity * edge->node_count());
    for (int k = 0; k < edge->node_count(); ++k) {
      const auto& body = system_.body(edge->first_node() + k);
      run.add_node(body.centre, mass, all_entries<dof - dim>(mass * body.gyration * body.gyration));
    }
  }

  /// What acts from outside; of the walls, `wall_load` as what an excavation has taken away.
  void add_loads(Run& run) const {
    std::vector<Load<dim>> walls;
    for (int b = 0; b < system_.body_count(); ++b) {
      const auto on_body = [&](const Eigen::VectorXd& load) {
        return Load<dim>{part<dim>(load, dof * b), part<dof - dim>(load, dof * b + dim)};
      };
      Load<dim> load = on_body(system_.load);
      load.force[dim - 1] += run.body(b).mass * run.settings().gravity;
      if (system_.wall_held.size() > 0) {
        const Load<dim> held = on_body(system_.wall_held);
        load.force += held.force;
        load.moment += held.moment;
      }
      run.add_load(b, load.force, load.moment);
      walls.push_back(on_body(system_.wall_load));
    }
    run.hold(std::move(walls));
    run.set_held(system_.wall_fraction);
  }

  void carry_contacts(Run& run) const {
    auto [joints, edges, interface] = contacts_by_frames(system_, frames_of(run));
    run.carry_on(std::move(joints), std::move(edges), std::move(interface));
  }

  void carry_supports(Run& run) const {
    SupportSet<dim> supports = system_.supports;
    to_frames(system_, frames_of(run), supports);
    for (const auto& support : supports) run.add_support(support);
  }

  /// Brings a model to where the bodies of a run are.
  static void store(Run& run, System& system) {
    std::vector<Pose<dim>> frames;
    std::vector<Rotation<dim>> turned;
    Eigen::VectorXd u(system.displacement.size());
    for (int b = 0; b < system.body_count(); ++b) {
      const Pose<dim> motion = run.motion(b);
      frames.push_back(run.body(b).pose);
      turned.push_back(motion.rotation);
      const Vec<dim> moved = run.position(b) - system.body(b).centre;
      set_part<dof>(u, dof * b,
                    system.body(b).is_block || system.body(b).movable
                        ? stacked(moved, spin_of(motion.rotation))
                        : zeros<Fixed<dof, 1>>());
    }
    system.supports = run.supports();
    system.displacement = std::move(u);
    system.wall_fraction = run.held();
    take_from_frames(system, run.joints(), run.walls(), run.interface(), frames, std::move(turned));
  }

 private:
  /// Where bodies of the run are in the reference configuration of the model.
  [[nodiscard]] std::vector<Pose<dim>> frames_of(const Run& run) const {
    std::vector<Pose<dim>> frames;
    for (int b = 0; b < system_.body_count(); ++b) {
      Pose<dim> frame = run.body(b).pose;
      const Pose<dim> now = system_.pose(b), then = system_.pose_at_update(b);
      frame.position += then.position - now.position;
      frame.rotation = then.rotation * transposed_product(now.rotation, frame.rotation);
      frames.push_back(frame);
    }
    return frames;
  }

  const System& system_;
};

/// See `set_in_motion`.
template <class System>
[[nodiscard]] typename Handover<System>::Run run_of(const System& system,
                                                    const DynamicsSettings& settings) {
  const Handover<System> handover(system);
  const auto& laws = system.joints.laws();
  typename Handover<System>::Run run(
      laws, system.boundary.laws().front().joint_normal_stiffness(), system.interface.laws(),
      laws.size() > 1 && system.law_of_cut != nullptr ? *system.law_of_cut : std::vector<int>{},
      settings);
  handover.add_bodies(run);
  handover.add_loads(run);
  handover.carry_contacts(run);
  handover.carry_supports(run);
  return run;
}
/// See `bring_to_rest`.
template <class System>
void take_from_run(typename Handover<System>::Run& run, System& system,
                   const std::vector<int>& gone) {
  require(run.body_count() == system.body_count(), "bodies of the run", run.body_count(),
          "those of the model");
  Handover<System>::store(run, system);
  if (!gone.empty()) system.remove(gone);
}

}  // namespace detail

/// A model at rest set in motion, from where its bodies are: their contacts with all that they
/// remember, bolts, linings, loads, what still acts on the walls (`Dynamics::set_held`). Bodies
/// have the same numbers.
///
/// A lining is touched there by rock that lands on it, too: its nodes have tiles as thick as its
/// section (`LiningSection::thickness`), and its mass must be given. Contacts are found anew where
/// bodies are, as a contact update does; forces and moments are those
/// at rest, to second order of the displacements since contacts were last updated.
/// @param settings  gravity as that of the weights
/// @throws InvalidInput  a body without shape; a lining without mass or thickness
template <class Geometry, class Detector>
[[nodiscard]] Motion<Geometry::dim, Detector> set_in_motion(
    const System<Geometry, Detector>& system, const DynamicsSettings& settings) {
  return detail::run_of(system, settings);
}

/// The tunnel of a solver set in motion. Of several rounds those that are still held are let go
/// together.
/// @param settings  gravity is that of the solver
template <class Solver>
requires requires(const Solver& solver) { solver.in_situ().gravity; }
[[nodiscard]] RunOf<Solver> set_in_motion(const Solver& solver, DynamicsSettings settings = {}) {
  settings.gravity = solver.in_situ().gravity;
  return RunOf<Solver>(set_in_motion(solver.system(), settings));
}

/// Takes a model back from the run in which it was set, to go on at rest from where its bodies are:
/// what moves is stopped, and displacements go on counting from the in-situ state.
/// @param system  from which the run was made
/// @param gone    bodies that are taken out of it now: those that have fallen
template <class Geometry, class Detector>
void bring_to_rest(Motion<Geometry::dim, Detector>& run, System<Geometry, Detector>& system,
                   const std::vector<int>& gone = {}) {
  detail::take_from_run(run, system, gone);
}

}  // namespace voussoir
