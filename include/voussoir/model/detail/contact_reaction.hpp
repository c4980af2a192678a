// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/detail/impact.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/point_loads.hpp>

namespace voussoir::detail {

// The forces of one contact of bodies that move, history brought up to date.
//
// states: what the law remembers of the points, one behind the other.

/// Brings the history of a point up to date once more where it is, on another part of the joint.
/// @param before  how it was loaded;  @param now  how it is
/// @return  energy that is lost: what it holds less, for nothing moves [J]
template <int Dim, class Law>
double commit_again(const Law& law, const PointLoad<Dim>& before, const PointLoad<Dim>& now,
                    typename Law::template State<Dim>& state) {
  const double held = law.stored_energy(before.committed(), state);
  (void)law.commit(now, state);
  return held - law.stored_energy(now, state);
}

struct PlanePlace {
  double normal, tangential;
};

/// Number by number: small vectors are carried through memory by g++ 12 when they are put
/// together from parts, which doubles the time. So in 3-D.
template <class Law, class Point, class State>
[[nodiscard]] Reaction<2> reaction(const Law& law, const MovingContact<2>& c, Point* points,
                                   State* states, const MovingBody<2>& a, const MovingBody<2>& b,
                                   Dissipation& lost) {
  const double ca = a.pose.rotation(0, 0), sa = a.pose.rotation(1, 0);
  const double cb = b.pose.rotation(0, 0), sb = b.pose.rotation(1, 0);
  const double fx = c.frame(0, 0), fy = c.frame(1, 0);
  const double nx = ca * fx - sa * fy, ny = sa * fx + ca * fy;  // normal, world
  const double mx = cb * nx + sb * ny, my = cb * ny - sb * nx;  // normal, frame of b
  const double dx = b.pose.position.x() - a.pose.position.x();
  const double dy = b.pose.position.y() - a.pose.position.y();
  const double base_n = nx * dx + ny * dy, base_t = nx * dy - ny * dx;  // tangent (-ny, nx)
  double force_n = 0, force_t = 0, moment = 0;
  // Along normal and tangent from the centre of b.
  const auto place_of = [&](const Point& p) {
    const double px = p.place.x(), py = p.place.y();
    return PlanePlace{mx * px + my * py, mx * py - my * px};
  };
  const auto load_of = [&](const Point& p, const PlanePlace& at) {
    PointLoad<2> load{p.weight, p.initial, {base_n + at.normal - p.zero[0], {}}};
    load.motion.slip[0] = base_t + at.tangential - p.zero[1];
    return load;
  };
  const auto react = [&](auto& state, const PlanePlace& at, const PointLoad<2>& load) {
    const PointForce<2> f = law.force(load, state);
    lost.friction += law.commit(load, state);
    double normal = f.normal;
    if (c.viscosity > 0 && normal > 0) {
      const double rate = nx * (b.velocity.x() - a.velocity.x()) +
                          ny * (b.velocity.y() - a.velocity.y()) - b.spin()[0] * at.tangential +
                          a.spin()[0] * (base_t + at.tangential);
      const double viscous = std::max(
          -c.viscosity * dashpot_of_part(load) * load.weight * law.joint_normal_stiffness() * rate,
          -normal);
      lost.viscosity -= viscous * rate;
      normal += viscous;
    }
    force_n += normal;
    force_t += f.tangential[0];
    // place x force, both in the contact's frame
    moment += at.normal * f.tangential[0] - at.tangential * normal;
  };
  Point* const p = points + c.first;
  if (c.last - c.first == 2) {
    Point* const q = p + 1;
    auto &state_p = states[p - points], &state_q = states[q - points];
    PlanePlace at_p = place_of(*p), at_q = place_of(*q);
    const PointLoad<2> of_whole[2] = {load_of(*p, at_p), load_of(*q, at_q)};
    PointLoad<2> loads[2] = {of_whole[0], of_whole[1]};
    const auto state_of = [&](std::size_t k) -> const State& { return k == 0 ? state_p : state_q; };
    const PointsOf<2, Law, decltype(state_of)> both(law, state_of);
    const auto part = press_in_motion(
        loads, c.outline, [p](std::size_t k) -> const Point& { return p[k]; }, both);
    if (!part.is_whole()) {
      const PlanePlace first = at_p, second = at_q;
      at_p = {part.at(0, first.normal, second.normal),
              part.at(0, first.tangential, second.tangential)};
      at_q = {part.at(1, first.normal, second.normal),
              part.at(1, first.tangential, second.tangential)};
    }
    react(state_p, at_p, loads[0]);
    react(state_q, at_q, loads[1]);
    lost.friction += let_go_of_bond<2>(
        loads, c.outline,
        [&](std::size_t k) {
          PointLoad<2> load = of_whole[k];
          load.motion.slip = loads[k].motion.slip;
          return load;
        },
        both,
        [&](std::size_t k, const PointLoad<2>& load) {
          return commit_again(law, loads[k], load, k == 0 ? state_p : state_q);
        });
    for (int k = 0; k < 2; ++k) {
      // The law goes on from the slip that it has.
      p[k].zero[1] += of_whole[k].motion.slip[0] - loads[k].motion.slip[0];
      p[k].committed.commit(loads[k].motion.slip);
    }
  } else {
    for (Point* k = p; k != points + c.last; ++k) {
      const PlanePlace at = place_of(*k);
      react(states[k - points], at, load_of(*k, at));
    }
  }
  Reaction<2> r;
  const double x = nx * force_n - ny * force_t, y = ny * force_n + nx * force_t;
  r.force << x, y;
  r.moment[1][0] = moment;
  r.moment[0][0] = -(moment + dx * y - dy * x);
  return r;
}

/// The dashpot beside a normal spring. It never pulls the blocks together. There is none in
/// shear: it would carry what friction has let go.
/// @param place    of the point, in the frame of body b [m]
/// @param damping  force over the speed at which the bodies part, <= 0 [N s/m]
[[nodiscard]] inline double damping_force(const Vec<3>& place, double damping,
                                          const MovingBody<3>& a, const MovingBody<3>& b,
                                          const Vec<3>& normal_axis, const Vec<3>& arm,
                                          double normal, Dissipation& lost) {
  const Vec<3> of_a = arm + b.pose.rotation * place;  // from the centre of a, world axes
  const double rate =
      normal_axis.dot(b.velocity_at(place) - a.velocity_at(transposed(a.pose.rotation) * of_a));
  const double viscous = std::max(damping * rate, -normal);
  lost.viscosity -= viscous * rate;
  return viscous;
}

template <class Law, class Point, class State>
[[nodiscard]] Reaction<3> reaction(const Law& law, const MovingContact<3>& c, Point* points,
                                   State* states, const MovingBody<3>& a, const MovingBody<3>& b,
                                   Dissipation& lost) {
  const Rotation<3> frame = a.pose.rotation * c.frame;
  const Vec<3> arm = b.pose.position - a.pose.position;
  const MovingContact<3>::Place at{transposed_product(b.pose.rotation, frame),
                                   transposed_product(frame, arm)};
  const double *n = at.frame_b.data(), *s = n + 3, *t = n + 6, *base = at.base.data();
  double x = 0, y = 0, z = 0;     // force on b, along its axes
  double mx = 0, my = 0, mz = 0;  // moment about its centre
  const auto add = [&](const Vec<3>& place, double fx, double fy, double fz) {
    const double px = place.data()[0], py = place.data()[1], pz = place.data()[2];
    x += fx;
    y += fy;
    z += fz;
    mx += py * fz - pz * fy;
    my += pz * fx - px * fz;
    mz += px * fy - py * fx;
  };
  const auto load_of = [&](const Point& p) {
    const double px = p.place.data()[0], py = p.place.data()[1], pz = p.place.data()[2];
    PointLoad<3> load;
    load.weight = p.weight;
    load.initial.normal = p.initial.normal;
    for (int k = 0; k < 2; ++k) load.initial.tangential.data()[k] = p.initial.tangential.data()[k];
    load.motion.opening = base[0] + (n[0] * px + n[1] * py + n[2] * pz) - p.zero.data()[0];
    load.motion.slip.data()[0] = base[1] + (s[0] * px + s[1] * py + s[2] * pz) - p.zero.data()[1];
    load.motion.slip.data()[1] = base[2] + (t[0] * px + t[1] * py + t[2] * pz) - p.zero.data()[2];
    return load;
  };
  const auto react = [&](auto& state, const Vec<3>& place, const Vec<3>& of_shear,
                         const PointLoad<3>& load) {
    const PointForce<3> f = law.force(load, state);
    lost.friction += law.commit(load, state);
    double normal = f.normal;
    const double along_s = f.tangential.data()[0], along_t = f.tangential.data()[1];
    if (c.viscosity > 0 && normal > 0)
      normal += damping_force(
          place, -c.viscosity * dashpot_of_part(load) * load.weight * law.joint_normal_stiffness(),
          a, b, column(frame, 0), arm, f.normal, lost);
    add(place, n[0] * normal, n[1] * normal, n[2] * normal);
    add(of_shear, s[0] * along_s + t[0] * along_t, s[1] * along_s + t[1] * along_t,
        s[2] * along_s + t[2] * along_t);
  };
  Point* const first = points + c.first;
  constexpr std::size_t four = PressedPart<3>::count;
  const auto state_of = [&](std::size_t k) -> const State& { return states[first + k - points]; };
  const PointsOf<3, Law, decltype(state_of)> all(law, state_of);
  const bool is_cut = c.last - c.first == static_cast<std::ptrdiff_t>(four) &&
                      c.outline.radius > 0 &&
                      may_be_cut(c.outline, all, [&](std::size_t k) { return load_of(first[k]); });
  if (is_cut) {
    PointLoad<3> loads[four];
    for (std::size_t k = 0; k < four; ++k) loads[k] = load_of(first[k]);
    const auto part = press<3>(loads, c.outline, all);
    for (std::size_t k = 0; k < four; ++k) {
      const Vec<3> place =
          part.is_whole()
              ? first[k].place
              : part.at(k, [&](std::size_t i) -> const Vec<3>& { return first[i].place; });
      react(states[first + k - points], place, first[k].place, loads[k]);
    }
    lost.friction += let_go_of_bond<3>(
        loads, c.outline, [&](std::size_t k) { return load_of(first[k]); }, all,
        [&](std::size_t k, const PointLoad<3>& load) {
          return commit_again(law, loads[k], load, states[first + k - points]);
        });
  } else {
    for (Point* p = first; p != points + c.last; ++p)
      react(states[p - points], p->place, p->place, load_of(*p));
  }
  Reaction<3> r;
  r.force = b.pose.rotation * Vec<3>(x, y, z);
  r.moment[1] = b.pose.rotation * Spin<3>(mx, my, mz);
  r.moment[0] = -(r.moment[1] + moment_of(arm, r.force));
  return r;
}

}  // namespace voussoir::detail
