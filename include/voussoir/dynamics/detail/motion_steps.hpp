// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/added_inertia.hpp>
#include <voussoir/dynamics/motion.hpp>
#include <voussoir/geometry/cut_facing.hpp>

// The longer functions of `Motion`.
namespace voussoir {

template <int Dim, class Detector>
void Motion<Dim, Detector>::add_inertia(double share) {
  require(share >= 0 && share < 1, "share of bodies with more inertia", share, ">= 0 and < 1");
  begin();
  const double kinetic = this->kinetic_energy();
  detail::add_inertia(stiffness_over_mass(), share, settings_.gravity, bodies_, loads_);
  network_.forget_masses();
  kinetic_given_ += this->kinetic_energy() - kinetic;
  forget();
}

template <int Dim, class Detector>
void Motion<Dim, Detector>::hold() {
  begin();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto [force, moment] = network_.gather(b);
    held_[b] = {-force - loads_[b].force, -moment - loads_[b].moment};
    held_[b].force[Dim - 1] += bodies_[b].mass * settings_.gravity;
  }
  set_held(1);
}

template <int Dim, class Detector>
void Motion<Dim, Detector>::advance(double time) {
  require(time >= 0 && std::isfinite(time), "time to advance", time, ">= 0 s");
  const double end = time_ + time;
  while (end - time_ > 1e-12 * std::max(time, step_)) {
    const double step = choose_step();
    const int steps = static_cast<int>(std::min(std::ceil((end - time_) / step - 1e-9), 1e9));
    const int batch = std::min(steps, settings_.check_every);
    // A last step of another length would spoil the order of the scheme: all are shortened.
    run_batch(batch, batch == steps ? (end - time_) / steps : step);
  }
  time_ = end;
}

template <int Dim, class Detector>
void Motion<Dim, Detector>::move_only(const std::vector<int>& bodies) {
  begin();
  MovingPart part;
  part.is_all = false;
  for (const int b : bodies)
    if (bodies_[index(b)].movable()) part.bodies.push_back(static_cast<std::uint32_t>(b));
  std::sort(part.bodies.begin(), part.bodies.end());
  part.contacts = network_.contacts_of(part.bodies);
  auto next = part.bodies.begin();
  const auto rest = [&](std::size_t b) {
    while (next != part.bodies.end() && *next < b) ++next;
    if (next != part.bodies.end() && *next == b) return;
    audit_.damping += bodies_[b].kinetic_energy();
    bodies_[b].velocity = zeros<Vec<Dim>>();
    bodies_[b].momentum = zeros<Spin<Dim>>();
  };
  part_.each_body(bodies_.size(), rest);  // the others rest already
  move(std::move(part));
}

template <int Dim, class Detector>
double Motion<Dim, Detector>::displace(const Eigen::VectorXd& step) {
  constexpr int dof = Dim + spin_count<Dim>;
  require(step.size() == dof * static_cast<Eigen::Index>(bodies_.size()), "values of a step",
          static_cast<double>(step.size()), "those of all bodies");
  begin();
  const auto each = [&](auto&& visit) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (bodies_[b].movable())
        visit(b, Vec<Dim>(voussoir::part<Dim>(step, dof * static_cast<Eigen::Index>(b))),
              Spin<Dim>(voussoir::part<dof - Dim>(step, dof * static_cast<Eigen::Index>(b) + Dim)));
  };
  const double before = audit_.damping;
  // What is taken away is the work of the forces out of balance, by the mean of both ends.
  const auto work = [&](std::size_t b, const Vec<Dim>& shift, const Spin<Dim>& turn) {
    const Load<Dim> load = forces().total(b);
    audit_.damping += 0.5 * (load.force.dot(shift) + load.moment.dot(turn));
  };
  each(work);
  each([&](std::size_t b, const Vec<Dim>& shift, const Spin<Dim>& turn) {
    Body& body = bodies_[b];
    const Load<Dim> load = forces().applied(b);
    audit_.loads += load.force.dot(shift) + load.moment.dot(turn);
    audit_.gravity -= body.mass * settings_.gravity * shift[Dim - 1];
    body.pose.position += shift;
    body.pose.rotation = rotation_by(turn) * body.pose.rotation;
    if constexpr (Dim == 2) body.angle += turn[0];
  });
  fresh_ = only_part_has_moved_ = false;
  audit_.friction += freshen().friction;
  each(work);
  return audit_.damping - before;
}

template <int Dim, class Detector>
void Motion<Dim, Detector>::take_in() {
  if (known_bodies_ == bodies_.size() && known_bodies_ > 0) return;
  const bool is_first = known_bodies_ == 0;
  if (is_first) {
    sizes_ = detail::RunSizes::choose(bodies_, settings_);
    tracker_.emplace(sizes_.reach, sizes_.refresh, 8 * sizes_.reach);
  }
  for (; known_shapes_ < shapes_.size(); ++known_shapes_) {
    const auto& [shape, b] = shapes_[known_shapes_];
    const Pose<Dim> home = this->home(b);
    // Nodes of a lining do not touch one another: they are one family.
    const bool of_lining = roles_[index(b)] == BodyRole::lining;
    tracker_->add(shape, home.position, b, home.rotation, of_lining ? lining_family : b,
                  is_filling_[known_shapes_] != 0 ? std::optional(lining_family) : std::nullopt);
  }
  known_bodies_ = bodies_.size();
  held_.resize(known_bodies_);
  stepping_.resize(known_bodies_);
  find_contacts();
  forget();
  if (is_first) start_audit();
}

template <int Dim, class Detector>
void Motion<Dim, Detector>::find_contacts() {
  const auto cut_of = [this](std::size_t shape, const Vec<Dim>& outward) {
    const auto& [part, b] = shapes_[shape];
    const Rotation<Dim> turn =
        home_[index(b)].rotation * transposed(bodies_[index(b)].pose.rotation);
    return cut_facing(part, Vec<Dim>(turn * outward));
  };
  const std::vector<std::uint32_t>* const moved =
      only_part_has_moved_ && !part_.is_all ? &part_.bodies : nullptr;
  UpdateEnergy energy;
  const ContactChange change = network_.find(*tracker_, bodies_, moved, roles_, cut_of, energy);
  // The energy of all contacts is asked for where that of those that were updated is not enough.
  VOUSSOIR_ASSERT(energy.made <= 1e-9 * energy.held + 1e-12 ||
                      energy.made <= 1e-9 * network_.stored_energy(bodies_),
                  "contact updates make no energy");
  audit_.contact_updates += energy.given;
  audit_.made_by_updates += energy.made;
  only_part_has_moved_ = true;
  if (change == ContactChange::none) return;
  stable_step_ = 0;
  is_part_fresh_ = false;
  if (change == ContactChange::renumbered) fresh_ = false;
}

template <int Dim, class Detector>
void Motion<Dim, Detector>::check() {
  const std::string fault =
      detail::RunDiagnostics<Dim>(bodies_, roles_, origin_, sizes_.speed_limit,
                                  settings_.speed_limit > 0, settings_.overlap_limit)
          .fault(std::as_const(network_), energy(), kinetic_given_, sizes_.unnoticed, step_);
  checked_ = steps_;
  audit_.highest_kinetic =
      std::max(audit_.highest_kinetic, this->kinetic_energy() - kinetic_given_);
  if (fault.empty()) {
    if (settings_.goes_back) sound_.emplace(state());
    return;
  }
  const std::string where = "dynamics: step " + std::to_string(steps_) + ": " + fault;
  if (!sound_) throw NumericalFault(where);
  take(*sound_);
  part_ = {};
  checked_ = steps_;
  stable_step_ = 0;
  only_part_has_moved_ = fresh_ = false;
  throw NumericalFault(where + " (the state kept is that of step " + std::to_string(steps_) + ")");
}

template <int Dim, class Detector>
void Motion<Dim, Detector>::take(const State& state) {
  bodies_ = state.bodies;
  network_ = state.network;
  tracker_ = state.tracker;
  audit_ = state.audit;
  supports_.restore(state.supports);
  kinetic_given_ = state.kinetic_given;
  time_ = state.time;
  steps_ = checked_ = state.steps;
  held_fraction_ = state.held_fraction;
  part_ = state.part;
}

template <int Dim, class Detector>
double Motion<Dim, Detector>::choose_step() {
  take_in();
  if (settings_.goes_back && !sound_) check();
  if (stable_step_ == 0) stable_step_ = longest_step();
  step_ = detail::chosen_time_step(settings_, stable_step_, steps_);
  if (!settings_.find_contacts || shapes_.size() < 2) return step_;
  begin();
  const auto each = [this](auto&& visit) { part_.each_body(bodies_.size(), visit); };
  step_ = detail::watched_time_step(step_, sizes_.longest_step(bodies_, stepping_.acting(), each),
                                    sizes_.reach, settings_, steps_);
  return step_;
}

template <int Dim, class Detector>
int Motion<Dim, Detector>::run_batch(int count, double step) {
  begin();
  step_ = step;
  constexpr double never = std::numeric_limits<double>::infinity();
  typename detail::Stepping<Dim, Network>::Ways ways{never, never};
  if (settings_.find_contacts) ways = {sizes_.travel_limit(), 0.25 * sizes_.reach};
  const int made = stepping_.run(forces(), count, step, ways, audit_);
  steps_ += made;
  time_ += made * step;
  if (steps_ - checked_ >= settings_.check_every) check();
  if (settings_.find_contacts) find_contacts();
  return made;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class ContactNetwork<2>;
VOUSSOIR_PLANAR_TEMPLATE class detail::Stepping<2, ContactNetwork<2>>;
VOUSSOIR_PLANAR_TEMPLATE class Motion<2>;
VOUSSOIR_SPATIAL_TEMPLATE class ContactNetwork<3>;
VOUSSOIR_SPATIAL_TEMPLATE class detail::Stepping<3, ContactNetwork<3>>;
VOUSSOIR_SPATIAL_TEMPLATE class Motion<3>;
#endif

}  // namespace voussoir
