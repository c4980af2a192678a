// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>

namespace voussoir::detail {

// The forces of one contact of bodies that move, history brought up to date.
//
// states.of(point, number) is what the law remembers of a point: it lies in the point, or in a
// column beside the points.

/// In the points.
struct StatesOfPoints {
  template <class Point>
  [[nodiscard]] auto& of(Point& point, std::ptrdiff_t) const {
    return point.state;
  }
};
/// In a column.
template <class State>
struct StatesInColumn {
  State* first;
  template <class Point>
  [[nodiscard]] State& of(Point&, std::ptrdiff_t number) const {
    return first[number];
  }
};

/// Number by number: small vectors are carried through memory by g++ 12 when they are put
/// together from parts, which doubles the time. So in 3-D.
template <class Law, class Point, class States>
[[nodiscard]] Reaction<2> reaction(const Law& law, const MovingContact<2>& c, Point* points,
                                   States states, const MovingBody<2>& a, const MovingBody<2>& b,
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
  const Point* const end = points + c.last;
  for (Point* p = points + c.first; p != end; ++p) {
    auto& state = states.of(*p, p - points);
    const double px = p->place.x(), py = p->place.y();
    const double along_n = mx * px + my * py, along_t = mx * py - my * px;
    PointLoad<2> load{p->weight, p->initial, {base_n + along_n - p->zero[0], {}}};
    load.motion.slip[0] = base_t + along_t - p->zero[1];
    const PointForce<2> f = law.force(load, state);
    lost.friction += law.commit(load, state);
    double normal = f.normal;
    if (c.viscosity > 0 && normal > 0) {
      const double rate = nx * (b.velocity.x() - a.velocity.x()) +
                          ny * (b.velocity.y() - a.velocity.y()) - b.spin()[0] * along_t +
                          a.spin()[0] * (base_t + along_t);
      const double viscous =
          std::max(-c.viscosity * p->weight * law.joint_normal_stiffness() * rate, -normal);
      lost.viscosity -= viscous * rate;
      normal += viscous;
    }
    force_n += normal;
    force_t += f.tangential[0];
    // place x force, both in the contact's frame
    moment += along_n * f.tangential[0] - along_t * normal;
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

template <class Law, class Point, class States>
[[nodiscard]] Reaction<3> reaction(const Law& law, const MovingContact<3>& c, Point* points,
                                   States states, const MovingBody<3>& a, const MovingBody<3>& b,
                                   Dissipation& lost) {
  const Rotation<3> frame = a.pose.rotation * c.frame;
  const Vec<3> arm = b.pose.position - a.pose.position;
  const MovingContact<3>::Place at{transposed_product(b.pose.rotation, frame),
                                   transposed_product(frame, arm)};
  const double *n = at.frame_b.data(), *s = n + 3, *t = n + 6, *base = at.base.data();
  double x = 0, y = 0, z = 0;     // force on b, along its axes
  double mx = 0, my = 0, mz = 0;  // moment about its centre
  const Point* const end = points + c.last;
  for (Point* p = points + c.first; p != end; ++p) {
    auto& state = states.of(*p, p - points);
    const double px = p->place.data()[0], py = p->place.data()[1], pz = p->place.data()[2];
    PointLoad<3> load;
    load.weight = p->weight;
    load.initial.normal = p->initial.normal;
    for (int k = 0; k < 2; ++k) load.initial.tangential.data()[k] = p->initial.tangential.data()[k];
    load.motion.opening = base[0] + (n[0] * px + n[1] * py + n[2] * pz) - p->zero.data()[0];
    load.motion.slip.data()[0] = base[1] + (s[0] * px + s[1] * py + s[2] * pz) - p->zero.data()[1];
    load.motion.slip.data()[1] = base[2] + (t[0] * px + t[1] * py + t[2] * pz) - p->zero.data()[2];
    const PointForce<3> f = law.force(load, state);
    lost.friction += law.commit(load, state);
    double normal = f.normal;
    const double along_s = f.tangential.data()[0], along_t = f.tangential.data()[1];
    if (c.viscosity > 0 && normal > 0)
      normal += damping_force(p->place, -c.viscosity * p->weight * law.joint_normal_stiffness(), a,
                              b, column(frame, 0), arm, f.normal, lost);
    const double fx = n[0] * normal + s[0] * along_s + t[0] * along_t,
                 fy = n[1] * normal + s[1] * along_s + t[1] * along_t,
                 fz = n[2] * normal + s[2] * along_s + t[2] * along_t;
    x += fx;
    y += fy;
    z += fz;
    mx += py * fz - pz * fy;
    my += pz * fx - px * fz;
    mz += px * fy - py * fx;
  }
  Reaction<3> r;
  r.force = b.pose.rotation * Vec<3>(x, y, z);
  r.moment[1] = b.pose.rotation * Spin<3>(mx, my, mz);
  r.moment[0] = -(r.moment[1] + moment_of(arm, r.force));
  return r;
}

}  // namespace voussoir::detail
