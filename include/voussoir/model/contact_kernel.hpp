// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/lane_pair.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_arrays.hpp>
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
  /// A point's force, its history brought up to date if asked.
  /// @param load  its motion, the rest is filled in
  [[nodiscard]] PointForce<Dim> react(const Law& law, std::size_t k, PointLoad<Dim>& load) const {
    const PointRecord<Dim>& r = records_[k];
    load.weight = r.weight;
    load.initial.normal = r.initial_normal;
    for (int m = 0; m < Dim - 1; ++m) load.initial.tangential.data()[m] = r.initial_tangential[m];
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
  void add_point(const Law& law, std::size_t k, const PlaneMotion& motion, PlaneSums& sums) const
      requires(Dim == 2) {
    const double along = records_[k].along[0];
    PointLoad<2> load;
    load.motion.opening = motion.normal - motion.turn * along;
    load.motion.slip.data()[0] = motion.tangential;
    double height = 0;
    if constexpr (Shifted) {
      const double* start = shifts_[k].start.data();
      height = shifts_[k].height;
      load.motion.opening = start[0] + motion.normal - motion.turn * along;
      load.motion.slip.data()[0] = start[1] + motion.tangential + motion.turn * height;
    }
    const PointForce<2> at = react(law, k, load);
    sums.normal += at.normal;
    sums.tangential += at.tangential.data()[0];
    if constexpr (Shifted)
      sums.moment += height * at.tangential.data()[0] - along * at.normal;
    else
      sums.moment -= along * at.normal;
  }

  /// Both points of a contact that has two.
  [[nodiscard]] PlaneSums pair_of_points(const Law& law, std::size_t k,
                                         const PlaneMotion& motion) const
      requires(Dim == 2 && has_pairs) {
    const PointRecord<2>&p = records_[k], &q = records_[k + 1];
    const LanePair along(p.along[0], q.along[0]);
    PairLoad load;
    load.weight = LanePair(p.weight, q.weight);
    load.initial_normal = LanePair(p.initial_normal, q.initial_normal);
    load.initial_shear = LanePair(p.initial_tangential[0], q.initial_tangential[0]);
    load.opening = LanePair(motion.normal);
    load.slip = LanePair(motion.tangential);
    [[maybe_unused]] LanePair height(0.0);
    if constexpr (Shifted) {
      const PointShift<2>&of_p = shifts_[k], &of_q = shifts_[k + 1];
      height = LanePair(of_p.height, of_q.height);
      load.opening = LanePair(of_p.start.data()[0], of_q.start.data()[0]) + load.opening;
      load.slip =
          LanePair(of_p.start.data()[1], of_q.start.data()[1]) + load.slip + motion.turn * height;
    }
    load.opening = load.opening - motion.turn * along;
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
    if (!is_done)
      for (std::size_t k = first; k < first + c.count; ++k) add_point(law, k, motion, sums);
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

  /// @param jump, spin  of body b against body a, along normal and tangents
  void add_points(const Contact& c, const Law& law, const double* jump, const double* spin,
                  Sums& sums) const requires(Dim == 3) {
    const auto end = static_cast<std::size_t>(c.last());
    for (auto k = static_cast<std::size_t>(c.first); k < end; ++k) {
      const double s = records_[k].along[0], t = records_[k].along[1];
      PointLoad<3> load;
      double height = 0;
      if constexpr (Shifted) {
        const double* start = shifts_[k].start.data();
        height = shifts_[k].height;
        load.motion.opening = start[0] + jump[0] + spin[1] * t - spin[2] * s;
        load.motion.slip = {start[1] + jump[1] + spin[2] * height - spin[0] * t,
                            start[2] + jump[2] + spin[0] * s - spin[1] * height};
      } else {
        load.motion.opening = jump[0] + spin[1] * t - spin[2] * s;
        load.motion.slip = {jump[1] - spin[0] * t, jump[2] + spin[0] * s};
      }
      const PointForce<3> at = react(law, k, load);
      const double fn = at.normal, fs = at.tangential.data()[0], ft = at.tangential.data()[1];
      sums.force[0] += fn;
      sums.force[1] += fs;
      sums.force[2] += ft;
      sums.moment[0] += s * ft - t * fs;
      if constexpr (Shifted) {
        sums.moment[1] += t * fn - height * ft;
        sums.moment[2] += height * fs - s * fn;
      } else {
        sums.moment[1] += t * fn;
        sums.moment[2] -= s * fn;
      }
    }
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
