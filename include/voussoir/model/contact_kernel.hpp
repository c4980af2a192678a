// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/lane_pair.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_arrays.hpp>
#include <voussoir/model/point_loads.hpp>
#include <voussoir/model/reference_contact.hpp>
#include <voussoir/model/small_displacement.hpp>

namespace voussoir {

/// What evaluating forces does to the contact history.
struct Frozen {};      ///< read it: the force depends on the displacement alone
struct Committing {};  ///< and bring it up to date at every evaluation

namespace detail {

/// The forces of one contact, from its record and those of its points.
///
/// @tparam Shifted  points have heights and starts; false: these are zero, and nothing reads them
template <int Dim, class Law, class History, bool Shifted>
class ContactKernel {
 public:
  using State = typename Law::template State<Dim>;
  using Contact = ReferenceContact<Dim>;
  static constexpr bool has_pairs =
      std::is_same_v<History, Frozen> && Dim == 2 && HasPairForce<Law>;
  static constexpr int dof = Contact::dof;

  /// @param shifts  null where none is shifted
  ContactKernel(const PointRecord<Dim>* records, const PointShift<Dim>* shifts, State* states)
      : records_(records), shifts_(shifts), states_(states) {}

  /// Adds the force of a contact at displacement `u` to `f`, both dof values per body.
  void add(const Contact& c, const Law& law, const double* u, double* f) const {
    if constexpr (Dim == 2)
      add_in_plane(c, law, u, f);
    else
      add_in_space(c, law, u, f);
  }

 private:
  /// What a point carries in the in-situ state.
  void read(std::size_t k, PointLoad<Dim>& load) const {
    const PointRecord<Dim>& r = records_[k];
    load.weight = r.weight;
    load.initial.normal = r.initial_normal;
    for (int m = 0; m < Dim - 1; ++m) load.initial.tangential.data()[m] = r.initial_tangential[m];
  }
  /// A point's force, its history brought up to date if asked.
  [[nodiscard]] PointForce<Dim> react(const Law& law, std::size_t k,
                                      const PointLoad<Dim>& load) const {
    const PointForce<Dim> at = law.force(load, states_[k]);
    if constexpr (std::is_same_v<History, Committing>) law.commit(load, states_[k]);
    return at;
  }

  /// Of body b against body a, along normal and tangent, and its turn.
  struct PlaneMotion {
    double normal, tangential, turn;
  };
  struct PlaneSums {
    double normal = 0, tangential = 0, moment = 0;
  };
  /// Place and load of a point in 2-D.
  struct PlanePoint {
    double along, height = 0;
    PointLoad<2> load;
  };
  [[nodiscard]] PlanePoint plane_point(std::size_t k, const PlaneMotion& motion) const
      requires(Dim == 2) {
    PlanePoint p;
    p.along = records_[k].along[0];
    p.load.motion.opening = motion.normal - motion.turn * p.along;
    p.load.motion.slip.data()[0] = motion.tangential;
    if constexpr (Shifted) {
      const double* start = shifts_[k].start.data();
      p.height = shifts_[k].height;
      p.load.motion.opening = start[0] + motion.normal - motion.turn * p.along;
      p.load.motion.slip.data()[0] = start[1] + motion.tangential + motion.turn * p.height;
    }
    read(k, p.load);
    return p;
  }
  void add_point(const Law& law, std::size_t k, double along, [[maybe_unused]] double height,
                 const PointLoad<2>& load, PlaneSums& sums) const requires(Dim == 2) {
    const PointForce<2> at = react(law, k, load);
    sums.normal += at.normal;
    sums.tangential += at.tangential.data()[0];
    if constexpr (Shifted)
      sums.moment += height * at.tangential.data()[0] - along * at.normal;
    else
      sums.moment -= along * at.normal;
  }
  /// Both points of a contact that has two, on its pressed part.
  void add_two(const Law& law, std::size_t k, const PlaneMotion& motion, PlaneSums& sums) const
      requires(Dim == 2) {
    const PlanePoint p = plane_point(k, motion), q = plane_point(k + 1, motion);
    PointLoad<2> loads[2] = {p.load, q.load};
    const auto state_of = [&](std::size_t i) -> const State& { return states_[k + i]; };
    const PointsOf<2, Law, decltype(state_of)> points(law, state_of);
    const auto part = press<2>(loads, {}, points);
    if (part.is_whole()) {
      add_point(law, k, p.along, p.height, loads[0], sums);
      add_point(law, k + 1, q.along, q.height, loads[1], sums);
    } else {
      add_point(law, k, part.at(0, p.along, q.along), p.height, loads[0], sums);
      add_point(law, k + 1, part.at(1, p.along, q.along), q.height, loads[1], sums);
    }
    if constexpr (std::is_same_v<History, Committing>)
      let_go_of_bond<2>(
          loads, {}, [&](std::size_t i) { return i == 0 ? p.load : q.load; }, points,
          [&](std::size_t i, const PointLoad<2>& load) {
            return law.commit(load, states_[k + i]);
          });
  }

  /// Both points of a contact that has two.
  [[nodiscard]] PlaneSums pair_of_points(const Law& law, std::size_t k,
                                         const PlaneMotion& motion) const
      requires(Dim == 2 && has_pairs) {
    const PointRecord<2>&p = records_[k], &q = records_[k + 1];
    LanePair along(p.along[0], q.along[0]);
    PairLoad load;
    load.weight = LanePair(p.weight, q.weight);
    load.initial_normal = LanePair(p.initial_normal, q.initial_normal);
    load.initial_shear = LanePair(p.initial_tangential[0], q.initial_tangential[0]);
    load.opening = LanePair(motion.normal);
    load.slip = LanePair(motion.tangential);
    [[maybe_unused]] LanePair height(0.0);  // of the shear: it stays where its slip is
    if constexpr (Shifted) {
      const PointShift<2>&of_p = shifts_[k], &of_q = shifts_[k + 1];
      height = LanePair(of_p.height, of_q.height);
      load.opening = LanePair(of_p.start.data()[0], of_q.start.data()[0]) + load.opening;
      load.slip =
          LanePair(of_p.start.data()[1], of_q.start.data()[1]) + load.slip + motion.turn * height;
    }
    load.opening = load.opening - motion.turn * along;
    const LanePair normal =
        load.initial_normal - law.joint_normal_stiffness() * load.weight * load.opening;
    const double mean = normal[0] + normal[1],
                 steep = PressedPart<2>::root * (normal[1] - normal[0]);
    if (std::abs(mean) < std::abs(steep)) {
      const auto part = PressedPart<2>::of(normal[0], normal[1]);
      const auto move = [&part](LanePair of) {
        return LanePair(part.at(0, of[0], of[1]), part.at(1, of[0], of[1]));
      };
      along = move(along);
      load.opening = move(load.opening);
      load.initial_normal = part.share * move(load.initial_normal);
      load.initial_shear = part.share * load.initial_shear;
      load.weight = part.share * load.weight;
    }
    const PairForce at = law.pair_force(load, states_ + k);
    LanePair moment = -(along * at.normal);
    if constexpr (Shifted) moment = height * at.shear + moment;
    return {at.normal.sum(), at.shear.sum(), moment.sum()};
  }

  /// In 2-D, in the axes of the contact, two numbers at a time. Half the time: g++ 12 carries
  /// Eigen's two-vectors through memory when they are put together from parts, and makes pairs of
  /// plain numbers where these cost more than they save.
  void add_in_plane(const Contact& c, const Law& law, const double* u, double* f) const
      requires(Dim == 2) {
    const double *ua = u + dof * c.a, *ub = u + dof * c.b;
    const LanePair n(c.normal.x(), c.normal.y()), t(-c.normal.y(), c.normal.x());
    const LanePair turned_a(-c.arm_a.y(), c.arm_a.x()), turned_b(-c.arm_b.y(), c.arm_b.x());
    const LanePair jump =
        LanePair::load(ub) + ub[2] * turned_b - LanePair::load(ua) - ua[2] * turned_a;
    const double jump_n = (n * jump).sum(), jump_t = (t * jump).sum(), turn = ub[2] - ua[2];
    PlaneSums sums;
    const PlaneMotion motion{jump_n, jump_t, turn};
    const auto first = static_cast<std::size_t>(c.first);
    bool is_done = false;
    if constexpr (has_pairs) {
      is_done = c.count == 2;  // as nearly all have
      if (is_done) sums = pair_of_points(law, first, motion);
    }
    if (!is_done && c.count == 2) {
      add_two(law, first, motion, sums);
    } else if (!is_done) {
      for (std::size_t k = first; k < first + c.count; ++k) {
        const PlanePoint p = plane_point(k, motion);
        add_point(law, k, p.along, p.height, p.load, sums);
      }
    }
    const LanePair force = n * sums.normal + t * sums.tangential;
    double *fa = f + dof * c.a, *fb = f + dof * c.b;
    (LanePair::load(fb) + force).store(fb);
    fb[2] += sums.moment + c.arm_b.x() * force[1] - c.arm_b.y() * force[0];
    (LanePair::load(fa) - force).store(fa);
    fa[2] -= sums.moment + c.arm_a.x() * force[1] - c.arm_a.y() * force[0];
  }

  /// Sums of the points of a contact in its axes: normal, first and second tangent.
  struct Sums {
    double force[3] = {0, 0, 0};
    double moment[3] = {0, 0, 0};
  };
  [[nodiscard]] static double along(const double* axis, const Vec<3>& v) {
    return axis[0] * v.data()[0] + axis[1] * v.data()[1] + axis[2] * v.data()[2];
  }

  /// Place along tangents and normal, and load, of a point in 3-D.
  struct SpacePoint {
    double s, t, height = 0;
    PointLoad<3> load;
  };
  /// @param jump, spin  of body b against body a, along normal and tangents
  [[nodiscard]] SpacePoint space_point(std::size_t k, const double* jump, const double* spin) const
      requires(Dim == 3) {
    SpacePoint p;
    p.s = records_[k].along[0];
    p.t = records_[k].along[1];
    if constexpr (Shifted) {
      const double* start = shifts_[k].start.data();
      p.height = shifts_[k].height;
      p.load.motion.opening = start[0] + jump[0] + spin[1] * p.t - spin[2] * p.s;
      p.load.motion.slip = {start[1] + jump[1] + spin[2] * p.height - spin[0] * p.t,
                            start[2] + jump[2] + spin[0] * p.s - spin[1] * p.height};
    } else {
      p.load.motion.opening = jump[0] + spin[1] * p.t - spin[2] * p.s;
      p.load.motion.slip = {jump[1] - spin[0] * p.t, jump[2] + spin[0] * p.s};
    }
    read(k, p.load);
    return p;
  }
  /// @param p     where the shear acts: where its slip is
  /// @param s, t  where the normal force does
  void add_point(const Law& law, std::size_t k, const SpacePoint& p, double s, double t,
                 const PointLoad<3>& load, Sums& sums) const requires(Dim == 3) {
    const PointForce<3> at = react(law, k, load);
    const double fn = at.normal, fs = at.tangential.data()[0], ft = at.tangential.data()[1];
    sums.force[0] += fn;
    sums.force[1] += fs;
    sums.force[2] += ft;
    sums.moment[0] += p.s * ft - p.t * fs;
    if constexpr (Shifted) {
      sums.moment[1] += t * fn - p.height * ft;
      sums.moment[2] += p.height * fs - s * fn;
    } else {
      sums.moment[1] += t * fn;
      sums.moment[2] -= s * fn;
    }
  }
  void add_points(const Contact& c, const Law& law, const double* jump, const double* spin,
                  Sums& sums) const requires(Dim == 3) {
    const auto first = static_cast<std::size_t>(c.first);
    constexpr std::size_t four = PressedPart<3>::count;
    const auto state_of = [&](std::size_t k) -> const State& { return states_[first + k]; };
    const PointsOf<3, Law, decltype(state_of)> all(law, state_of);
    if (c.count != four || c.outline.radius == 0 || !may_be_cut(c.outline, all, [&](std::size_t k) {
          return space_point(first + k, jump, spin).load;
        })) {
      for (std::size_t k = first; k < first + c.count; ++k) {
        const SpacePoint p = space_point(k, jump, spin);
        add_point(law, k, p, p.s, p.t, p.load, sums);
      }
      return;
    }
    SpacePoint points[four];
    PointLoad<3> loads[four];
    for (std::size_t k = 0; k < four; ++k) {
      points[k] = space_point(first + k, jump, spin);
      loads[k] = points[k].load;
    }
    const auto part = press<3>(loads, c.outline, all);
    for (std::size_t k = 0; k < four; ++k) {
      const SpacePoint& p = points[k];
      if (part.is_whole())
        add_point(law, first + k, p, p.s, p.t, loads[k], sums);
      else
        add_point(law, first + k, p, part.at(k, [&](std::size_t i) { return points[i].s; }),
                  part.at(k, [&](std::size_t i) { return points[i].t; }), loads[k], sums);
    }
    if constexpr (std::is_same_v<History, Committing>)
      let_go_of_bond<3>(
          loads, c.outline, [&](std::size_t k) { return points[k].load; }, all,
          [&](std::size_t k, const PointLoad<3>& load) {
            return law.commit(load, states_[first + k]);
          });
  }

  /// In the axes of the contact, normal and tangents: only what is the same for all its points is
  /// turned there and back. A third of the time that turning every point takes.
  void add_in_space(const Contact& c, const Law& law, const double* u, double* f) const
      requires(Dim == 3) {
    const double *ua = u + dof * c.a, *ub = u + dof * c.b;
    const Vec<3> gap = displacement_at<3>(ub, c.arm_b) - displacement_at<3>(ua, c.arm_a);
    const Vec<3> turn = vector_at<3>(ub + 3) - vector_at<3>(ua + 3);
    const double *n = c.normal.data(), *s = c.kept_tangents.first.data(),
                 *t = c.kept_tangents.second.data();
    // In a left-handed frame a cross product has the other sign.
    const double volume = n[0] * (s[1] * t[2] - s[2] * t[1]) + n[1] * (s[2] * t[0] - s[0] * t[2]) +
                          n[2] * (s[0] * t[1] - s[1] * t[0]);
    const double hand = volume < 0 ? -1.0 : 1.0;
    const double jump[3] = {along(n, gap), along(s, gap), along(t, gap)};
    const double spin[3] = {hand * along(n, turn), hand * along(s, turn), hand * along(t, turn)};
    Sums sums;
    add_points(c, law, jump, spin, sums);
    Vec<3> force, moment;
    for (int k = 0; k < 3; ++k) {
      force.data()[k] = sums.force[0] * n[k] + sums.force[1] * s[k] + sums.force[2] * t[k];
      moment.data()[k] =
          hand * (sums.moment[0] * n[k] + sums.moment[1] * s[k] + sums.moment[2] * t[k]);
    }
    double *fa = f + dof * c.a, *fb = f + dof * c.b;
    add_at<3>(fb, force);
    add_at<3>(fa, -force);
    add_at<3>(fb + 3, moment + moment_of(c.arm_b, force));
    add_at<3>(fa + 3, -(moment + moment_of(c.arm_a, force)));
  }

  const PointRecord<Dim>* records_;
  const PointShift<Dim>* shifts_;
  State* states_;
};

}  // namespace detail
}  // namespace voussoir
