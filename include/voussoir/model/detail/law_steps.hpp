// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/contact_kernel.hpp>

namespace voussoir::detail {

// All that is compiled for a contact law at rest; the rest does not know which it is.

/// Brings the memory of a point up to date.
/// @return  true if its force has changed by that: it has failed, and is weaker now
template <int Dim, class Law>
bool commit_point(const Law& law, const PointLoad<Dim>& load,
                  typename Law::template State<Dim>& state) {
  const PointForce<Dim> before = law.force(load, state);
  law.commit(load, state);
  const PointForce<Dim> after = law.force(load.committed(), state);
  const double change =
      std::abs(after.normal - before.normal) + (after.tangential - before.tangential).norm();
  return change > 1e-9 * (std::abs(before.normal) + before.tangential.norm());
}

/// The negative derivative of normal force and shears by opening and slips, by differences.
template <int Dim, class Law>
[[nodiscard]] Stress<Dim> tangent_at(const Law& law, const PointLoad<Dim>& load,
                                     const typename Law::template State<Dim>& state) {
  constexpr double step = 1e-9;
  Stress<Dim> stiffness;
  for (int l = 0; l < Dim; ++l) {
    PointLoad<Dim> more = load, less = load;
    (l == 0 ? more.motion.opening : more.motion.slip[l - 1]) += step;
    (l == 0 ? less.motion.opening : less.motion.slip[l - 1]) -= step;
    const PointForce<Dim> up = law.force(more, state), down = law.force(less, state);
    stiffness(0, l) = (down.normal - up.normal) / (2 * step);
    for (int m = 1; m < Dim; ++m)
      stiffness(m, l) = (down.tangential[m - 1] - up.tangential[m - 1]) / (2 * step);
  }
  return stiffness;
}

template <int Dim, class Law, class History, bool Shifted, class LawOf>
void add_forces_by(const ForceTask<Dim>& task, const LawOf& law_of) {
  const ContactKernel<Dim, Law, History, Shifted> kernel(
      task.records, task.shifts, static_cast<typename Law::template State<Dim>*>(task.states));
  for (std::size_t n = 0; n < task.count; ++n) {
    const std::size_t k = task.which != nullptr ? static_cast<std::size_t>(task.which[n]) : n;
    const ReferenceContact<Dim>& c = task.contacts[k];
    kernel.add(c, law_of(c.law), task.u, task.f);
  }
}

/// @param law_of  law_of(number)
template <int Dim, class Law, class LawOf>
void add_forces(const ForceTask<Dim>& task, const LawOf& law_of) {
  if (task.commits && task.shifts != nullptr)
    add_forces_by<Dim, Law, Committing, true>(task, law_of);
  else if (task.commits)
    add_forces_by<Dim, Law, Committing, false>(task, law_of);
  else if (task.shifts != nullptr)
    add_forces_by<Dim, Law, Frozen, true>(task, law_of);
  else
    add_forces_by<Dim, Law, Frozen, false>(task, law_of);
}

}  // namespace voussoir::detail
