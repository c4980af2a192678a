// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/point_loads.hpp>

namespace voussoir::detail {

/// Adds a contact whose pressed part has changed within the last step to those that there are. Not
/// one with a dashpot or a bond.
/// @param points, states  of all contacts
template <int Dim, class Law, class Point, class State>
void add_crossing(const Law& law, const MovingContact<Dim>& c, const Point* points,
                  const State* states, const MovingBody<Dim>& a, const MovingBody<Dim>& b,
                  StepCrossings<Dim>& crossings) {
  constexpr std::size_t most = PressedPart<Dim>::count;
  const auto count = static_cast<std::size_t>(c.last - c.first);
  if (count == 0 || count > most || c.viscosity > 0) return;
  points += c.first;
  states += c.first;
  const double step = crossings.step;
  const auto at = c.place(a.pose, b.pose);
  const Vec<Dim> normal = a.pose.rotation * column(c.frame, 0);
  const Vec<Dim> arm = b.pose.position - a.pose.position;
  // Loads and how far points are pressed in, at both ends of the step.
  PointLoad<Dim> loads[2][most];
  double pressed_in[2][most];
  for (std::size_t k = 0; k < count; ++k) {
    const Vec<Dim> of_a = arm + b.pose.rotation * points[k].place;
    const double rate =
        normal.dot(b.velocity_at(points[k].place) -
                   a.velocity_at(Vec<Dim>(transposed_product(a.pose.rotation, of_a))));
    loads[0][k] = loads[1][k] = points[k].load(at);
    loads[0][k].motion.opening -= step * rate;
    const auto release = release_opening<Dim>(law, loads[1][k], states[k]);
    if constexpr (!std::is_same_v<decltype(release), const double>)
      if (release.stretch > 0) return;
    for (int end = 0; end < 2; ++end)
      pressed_in[end][k] = opening_of(release) - loads[end][k].motion.opening;
  }
  bool is_open[2], is_whole = true;
  for (int end = 0; end < 2; ++end) {
    const double* in = pressed_in[end];
    is_open[end] = !((count == most ? PressedPart<Dim>::deepest(in, c.outline)
                                    : *std::max_element(in, in + count)) > 0);
    is_whole = is_whole && !is_open[end] &&
               (count < most ? *std::min_element(in, in + count) >= 0
                             : PressedPart<Dim>::of(in, c.outline).is_whole());
  }
  if (is_whole || (is_open[0] && is_open[1])) return;
  // Normal forces and what their springs store, there.
  const auto state_of = [&](std::size_t k) -> const State& { return states[k]; };
  double sum[2] = {0, 0}, stored[2] = {0, 0};
  Spin<Dim> moment[2] = {zeros<Spin<Dim>>(), zeros<Spin<Dim>>()};
  for (int end = 0; end < 2; ++end) {
    if (is_open[end]) continue;
    PressedPart<Dim> part;
    if (count == most)
      part =
          press<Dim>(loads[end], c.outline, PointsOf<Dim, Law, decltype(state_of)>(law, state_of));
    for (std::size_t k = 0; k < count; ++k) {
      const PointLoad<Dim>& load = loads[end][k];
      const Vec<Dim> place =
          part.is_whole()
              ? points[k].place
              : part.at(k, [&](std::size_t i) -> const Vec<Dim>& { return points[i].place; });
      const double force = law.force(load, states[k]).normal;
      sum[end] += force;
      stored[end] += 0.5 * force *
                     (opening_of(release_opening<Dim>(law, load, states[k])) - load.motion.opening);
      moment[end] += moment_of(Vec<Dim>(b.pose.rotation * place), Vec<Dim>(force * normal));
    }
  }
  typename StepCrossings<Dim>::Entry entry{c.a, c.b, {}, {}, stored[1] - stored[0]};
  for (int end = 0; end < 2; ++end) {
    Reaction<Dim>& of = entry.of[end];
    of.force = sum[end] * normal;
    of.moment[1] = moment[end];
    of.moment[0] = -(moment[end] + moment_of(arm, of.force));
    entry.power[end] = of.force.dot(b.velocity - a.velocity) +
                       b.to_body(of.moment[1]).dot(b.spin()) +
                       a.to_body(of.moment[0]).dot(a.spin());
  }
  crossings.entries.push_back(entry);
}

}  // namespace voussoir::detail
