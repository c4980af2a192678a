// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/model/small_displacement.hpp>

namespace voussoir {

/// A point of a contact in the reference configuration, but for what the contact law remembers.
template <int Dim>
struct ReferencePoint {
  Vec<Dim> offset;          ///< from the centre of the area, along normal and tangents [m]
  double weight;            ///< [m] or [m^2]
  PointForce<Dim> initial;  ///< in the in-situ state
  /// Opening and slips at displacement zero: not zero once contacts have been updated, or where
  /// the contact has been made on ground that had already moved [m].
  Vec<Dim> start = zeros<Vec<Dim>>();
};

/// What body a shares with body b on one plane, in the reference configuration: where the bodies
/// were when contacts were found.
template <int Dim>
struct ReferenceContact {
  static constexpr int dof = Dim + spin_count<Dim>;

  Vec<Dim> normal;  ///< from a to b
  /// With the normal a frame: right-handed, but in 3-D left-handed where a contact update has found
  /// the bodies the other way round and turned all its axes about.
  TangentBasis<Dim> tangents;
  Vec<Dim> arm_a, arm_b;  ///< from the centres of the bodies to the centre of the area [m]
  int a, b;
  int first, last;  ///< points first, ..., last - 1
  int law = 0;      ///< index into the laws of the group

  /// From the centre of the area to a point, world axes [m].
  [[nodiscard]] Vec<Dim> offset_of(const ReferencePoint<Dim>& p) const {
    return p.offset[0] * normal + tangents * part<Dim - 1>(p.offset, 1);
  }
  /// Displacement `u` of body b against body a at an offset from the centre, world axes [m].
  [[nodiscard]] Vec<Dim> jump(const Vec<Dim>& offset, const double* u) const {
    return displacement_at<Dim>(u + dof * b, arm_b + offset) -
           displacement_at<Dim>(u + dof * a, arm_a + offset);
  }
  /// Opening and slips of a point at displacement `u`.
  [[nodiscard]] PointMotion<Dim> motion(const ReferencePoint<Dim>& p, const Vec<Dim>& offset,
                                        const double* u) const {
    const Vec<Dim> jump = this->jump(offset, u);
    return {p.start[0] + normal.dot(jump),
            part<Dim - 1>(p.start, 1) + transposed_product(tangents, jump)};
  }
  /// Opening and slips of a point that displacement `u` makes, besides those at the start [m].
  [[nodiscard]] Vec<Dim> linear_motion(const ReferencePoint<Dim>& p, const double* u) const {
    const Vec<Dim> jump = this->jump(offset_of(p), u);
    return stacked(normal.dot(jump), transposed_product(tangents, jump));
  }
};

/// The order in which contacts that have been found go into their group: by the lower of their two
/// bodies, then by the other one; several of the same two as they were found.
///
/// Neighbours in the rock have numbers near each other, so forces go through the memory of bodies
/// from front to back: in 2-D 40 instead of 140 ns a contact for a million blocks and 46 instead of
/// 62 for 105 000, which is what it takes to read the 256 bytes of each.
/// @param bodies_of  bodies_of(contact) are the two bodies, either first
/// @return  indices into `contacts`
template <class Contacts, class BodiesOf>
[[nodiscard]] std::vector<int> order_by_bodies(const Contacts& contacts, BodiesOf&& bodies_of) {
  std::vector<std::pair<int, int>> bodies;
  bodies.reserve(contacts.size());
  int limit = 0;
  for (const auto& contact : contacts) {
    const std::pair<int, int> two = bodies_of(contact);
    bodies.emplace_back(std::minmax(two.first, two.second));
    limit = std::max(limit, bodies.back().second + 1);
  }
  return order_of_pairs(bodies, limit);
}

/// What evaluating forces does to the contact history.
struct Frozen {};      ///< read it: the force depends on the displacement alone
struct Committing {};  ///< and bring it up to date at every evaluation

/// All contacts that follow laws of one kind, with their points and history.
template <class Geometry, class Law>
class ContactGroup {
 public:
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;
  using State = typename Law::template State<dim>;

  using Contact = ReferenceContact<dim>;
  struct Point : ReferencePoint<dim> {
    [[no_unique_address]] State state{};
  };

  explicit ContactGroup(std::vector<Law> laws) : laws_(std::move(laws)) {}

  [[nodiscard]] const std::vector<Law>& laws() const { return laws_; }
  /// @return  its index
  int add_law(Law law) {
    laws_.push_back(std::move(law));
    return static_cast<int>(laws_.size()) - 1;
  }
  [[nodiscard]] const Law& law_of(const Contact& c) const {
    return laws_[static_cast<std::size_t>(c.law)];
  }
  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

  /// Makes room for more contacts of so many points each.
  void reserve(std::size_t contacts, std::size_t points_each) {
    contacts_.reserve(contacts_.size() + contacts);
    points_.reserve(points_.size() + contacts * points_each);
  }

  /// @param area      a facet or a `ContactArea`: its area vector points from a to b
  /// @param centre_a, centre_b  of the bodies [m]
  /// @param at        integration points of the area
  /// @param law       index into the laws of the group
  template <class Area>
  void add(int a, int b, const Area& area, const Vec<dim>& centre_a, const Vec<dim>& centre_b,
           std::span<const FacetPoint<dim>> at, int law = 0);
  /// Adds a contact as it is; `first` and `last` are set.
  void add(Contact contact, std::span<const Point> points) {
    contact.first = static_cast<int>(points_.size());
    points_.insert(points_.end(), points.begin(), points.end());
    contact.last = static_cast<int>(points_.size());
    contacts_.push_back(contact);
  }

  /// Calls visit(contact, points) for every contact; both may be changed, but for their number.
  template <class Visit>
  void each_contact(Visit&& visit) {
    for (Contact& c : contacts_)
      visit(c,
            std::span<Point>(points_.data() + c.first, static_cast<std::size_t>(c.last - c.first)));
  }

  /// Sets the initial force at every point from the stress there: on b, -traction of the facet.
  template <class StressAt>
  void set_initial(StressAt&& stress_at) {
    for_each_point([&](const Contact& c, Point& p, const Vec<dim>& offset) {
      const Vec<dim> force = stress_at(c, offset) * c.normal * p.weight;
      p.initial = {c.normal.dot(force), transposed(c.tangents) * force};
    });
  }

  /// Makes `u` the displacement at which contacts first, first + 1, ... touch without force: for
  /// those that are installed on ground which has already moved.
  void touch_at(const double* u, std::size_t first) {
    for (std::size_t k = first; k < contacts_.size(); ++k) {
      const Contact& c = contacts_[k];
      for (auto i = static_cast<std::size_t>(c.first); i < static_cast<std::size_t>(c.last); ++i) {
        points_[i].initial = {};
        points_[i].start = -c.linear_motion(points_[i], u);
      }
    }
  }

  /// Adds the contact forces at displacement `u` to `f`, both dof values per body.
  template <class History>
  void add_forces(const double* u, double* f) {
    for (const Contact& c : contacts_) add_force<History>(c, u, f);
  }
  /// The same for the contacts with these numbers only.
  template <class History>
  void add_forces(std::span<const int> which, const double* u, double* f) {
    for (const int k : which) add_force<History>(contacts_[static_cast<std::size_t>(k)], u, f);
  }

  /// Brings the history up to date with displacement `u`.
  /// @return  points whose force changed by that: joints that failed, and are weaker now
  int commit(const double* u);

  /// Lets joints creep for a time [s] at displacement `u`. (A template, since clang++ 14 makes a
  /// plain member with an explicit instance of the class even where the law does not creep.)
  template <class CreepLaw = Law>
  requires CreepingLaw<CreepLaw, dim>
  void creep(const double* u, double time) {
    for_each_point([&](const Contact& c, Point& p, const Vec<dim>& offset) {
      law_of(c).creep({p.weight, p.initial, c.motion(p, offset, u)}, p.state, time);
    });
  }

  /// Hands the elastic (closed, sticking) stiffness of each contact to `sink(a, b, aa, ab, bb)`.
  template <class Sink>
  void add_stiffness(Sink&& sink) const {
    using Block = Fixed<dof, dof>;
    for (const Contact& c : contacts_) {
      Block aa = zeros<Block>(), ab = zeros<Block>(), bb = zeros<Block>();
      for (int k = c.first; k < c.last; ++k) {
        const Point& p = points_[static_cast<std::size_t>(k)];
        const Vec<dim> offset = c.offset_of(p);
        for (int direction = 0; direction < dim; ++direction) {
          const Vec<dim> unit = direction == 0 ? c.normal : column(c.tangents, direction - 1);
          const double stiffness = p.weight * (direction == 0 ? law_of(c).joint_normal_stiffness()
                                                              : law_of(c).joint_shear_stiffness());
          const Fixed<dof, 1> a = stacked(unit, moment_of(c.arm_a + offset, unit));
          const Fixed<dof, 1> b = stacked(unit, moment_of(c.arm_b + offset, unit));
          aa += outer<dof, dof>(stiffness * a, a);
          ab -= outer<dof, dof>(stiffness * a, b);
          bb += outer<dof, dof>(stiffness * b, b);
        }
      }
      sink(c.a, c.b, aa, ab, bb);
    }
  }

  /// Hands the tangent stiffness at displacement `u` of the contacts with these numbers to
  /// `sink(a, b, aa, ab, ba, bb)`: the negative derivative of the forces, history frozen.
  ///
  /// Laws give forces, not derivatives: they are differenced here. They are piecewise linear or
  /// nearly so, hence the result is exact to rounding away from kinks and their mean at a kink.
  template <class Sink>
  void add_tangent(std::span<const int> which, const double* u, Sink&& sink) const {
    using Block = Fixed<dof, dof>;
    using Rows = Fixed<dof, dim>;
    constexpr double step = 1e-9;
    for (const int number : which) {
      const Contact& c = contacts_[static_cast<std::size_t>(number)];
      Block aa = zeros<Block>(), ab = zeros<Block>(), ba = zeros<Block>(), bb = zeros<Block>();
      for (int k = c.first; k < c.last; ++k) {
        const Point& p = points_[static_cast<std::size_t>(k)];
        const Vec<dim> offset = c.offset_of(p);
        const PointMotion<dim> motion = c.motion(p, offset, u);
        Stress<dim> stiffness;
        for (int l = 0; l < dim; ++l) {
          PointLoad<dim> more{p.weight, p.initial, motion}, less = more;
          (l == 0 ? more.motion.opening : more.motion.slip[l - 1]) += step;
          (l == 0 ? less.motion.opening : less.motion.slip[l - 1]) -= step;
          const PointForce<dim> up = law_of(c).force(more, p.state),
                                down = law_of(c).force(less, p.state);
          stiffness(0, l) = (down.normal - up.normal) / (2 * step);
          for (int m = 1; m < dim; ++m)
            stiffness(m, l) = (down.tangential[m - 1] - up.tangential[m - 1]) / (2 * step);
        }
        Rows a, b;
        for (int l = 0; l < dim; ++l) {
          const Vec<dim> axis = l == 0 ? c.normal : column(c.tangents, l - 1);
          set_column(a, l, stacked(axis, moment_of(c.arm_a + offset, axis)));
          set_column(b, l, stacked(axis, moment_of(c.arm_b + offset, axis)));
        }
        const Rows sa = a * stiffness, sb = b * stiffness;
        aa += sa * transposed(a);
        ab -= sa * transposed(b);
        ba -= sb * transposed(a);
        bb += sb * transposed(b);
      }
      sink(c.a, c.b, aa, ab, ba, bb);
    }
  }

  /// Calls visit(contact, point, load, force) for every point at displacement `u`.
  template <class Visit>
  void visit(const double* u, Visit&& visit) const {
    for (const Contact& c : contacts_)
      for (int k = c.first; k < c.last; ++k) {
        const Point& p = points_[static_cast<std::size_t>(k)];
        const Vec<dim> offset = c.offset_of(p);
        const PointLoad<dim> load{p.weight, p.initial, c.motion(p, offset, u)};
        visit(c, p, load, law_of(c).force(load, p.state));
      }
  }

  /// Forgets the contacts of bodies for which `gone(body)` holds.
  template <class Gone>
  void remove(Gone&& gone) {
    // In their place: what is kept only moves towards the front.
    std::size_t kept = 0;
    int end = 0;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      Contact c = contacts_[k];
      if (gone(c.a) || gone(c.b)) continue;
      const int count = c.last - c.first;
      if (end != c.first)
        std::move(points_.begin() + c.first, points_.begin() + c.last, points_.begin() + end);
      c.first = end;
      c.last = end += count;
      contacts_[kept++] = c;
    }
    contacts_.erase(contacts_.begin() + static_cast<std::ptrdiff_t>(kept), contacts_.end());
    points_.erase(points_.begin() + end, points_.end());
  }

 private:
  template <class History>
  void add_force(const Contact& c, const double* u, double* f) {
    if constexpr (dim == 2)
      add_force_in_plane<History>(c, u, f);
    else
      add_force_in_space<History>(c, u, f);
  }

  /// In the axes of the contact, normal and tangents: only what is the same for all its points is
  /// turned there and back. A third of the time that turning every point takes.
  template <class History>
  void add_force_in_space(const Contact& c, const double* u, double* f) requires(dim == 3) {
    const double *ua = u + dof * c.a, *ub = u + dof * c.b;
    const Law& law = law_of(c);
    const Vec<3> jump = displacement_at<3>(ub, c.arm_b) - displacement_at<3>(ua, c.arm_a);
    const Vec<3> spin = vector_at<3>(ub + 3) - vector_at<3>(ua + 3);
    const double *n = c.normal.data(), *s = c.tangents.data(), *t = s + 3;
    const auto along = [](const double* axis, const Vec<3>& v) {
      return axis[0] * v.data()[0] + axis[1] * v.data()[1] + axis[2] * v.data()[2];
    };
    const double jump_n = along(n, jump), jump_s = along(s, jump), jump_t = along(t, jump);
    // In a left-handed frame a cross product has the other sign.
    const double volume = n[0] * (s[1] * t[2] - s[2] * t[1]) + n[1] * (s[2] * t[0] - s[0] * t[2]) +
                          n[2] * (s[0] * t[1] - s[1] * t[0]);
    const double hand = volume < 0 ? -1.0 : 1.0;
    const double spin_n = hand * along(n, spin), spin_s = hand * along(s, spin),
                 spin_t = hand * along(t, spin);
    double force_n = 0, force_s = 0, force_t = 0, moment_n = 0, moment_s = 0, moment_t = 0;
    Point* const end = points_.data() + c.last;
    for (Point* p = points_.data() + c.first; p != end; ++p) {
      const double *offset = p->offset.data(), *start = p->start.data();
      const double on = offset[0], os = offset[1], ot = offset[2];
      PointLoad<3> load{p->weight, p->initial, {start[0] + jump_n + spin_s * ot - spin_t * os, {}}};
      load.motion.slip = {start[1] + jump_s + spin_t * on - spin_n * ot,
                          start[2] + jump_t + spin_n * os - spin_s * on};
      const PointForce<3> at = law.force(load, p->state);
      if constexpr (std::is_same_v<History, Committing>) law.commit(load, p->state);
      const double fn = at.normal, fs = at.tangential.data()[0], ft = at.tangential.data()[1];
      force_n += fn;
      force_s += fs;
      force_t += ft;
      moment_n += os * ft - ot * fs;
      moment_s += ot * fn - on * ft;
      moment_t += on * fs - os * fn;
    }
    Vec<3> force, moment;
    for (int k = 0; k < 3; ++k) {
      force.data()[k] = force_n * n[k] + force_s * s[k] + force_t * t[k];
      moment.data()[k] = hand * (moment_n * n[k] + moment_s * s[k] + moment_t * t[k]);
    }
    double *fa = f + dof * c.a, *fb = f + dof * c.b;
    add_at<3>(fb, force);
    add_at<3>(fa, -force);
    add_at<3>(fb + 3, moment + moment_of(c.arm_b, force));
    add_at<3>(fa + 3, -(moment + moment_of(c.arm_a, force)));
  }

  /// The same in 2-D, number by number and in the axes of the contact: half the time, for
  /// g++ 12 carries Eigen's two-vectors through memory when they are put together from parts.
  template <class History>
  void add_force_in_plane(const Contact& c, const double* u, double* f) requires(dim == 2) {
    const double *ua = u + dof * c.a, *ub = u + dof * c.b;
    const double nx = c.normal.x(), ny = c.normal.y();  // tangent (-ny, nx)
    const double jx = ub[0] - ub[2] * c.arm_b.y() - ua[0] + ua[2] * c.arm_a.y();
    const double jy = ub[1] + ub[2] * c.arm_b.x() - ua[1] - ua[2] * c.arm_a.x();
    const double jump_n = nx * jx + ny * jy, jump_t = nx * jy - ny * jx, turn = ub[2] - ua[2];
    const Law& law = law_of(c);
    double force_n = 0, force_t = 0, moment = 0;
    Point* const end = points_.data() + c.last;
    for (Point* p = points_.data() + c.first; p != end; ++p) {
      const double height = p->offset[0], along = p->offset[1];
      PointLoad<dim> load{p->weight, p->initial, {p->start[0] + jump_n - turn * along, {}}};
      load.motion.slip[0] = p->start[1] + jump_t + turn * height;
      const PointForce<dim> at = law.force(load, p->state);
      if constexpr (std::is_same_v<History, Committing>) law.commit(load, p->state);
      force_n += at.normal;
      force_t += at.tangential[0];
      moment += height * at.tangential[0] - along * at.normal;
    }
    const double x = nx * force_n - ny * force_t, y = ny * force_n + nx * force_t;
    double *fa = f + dof * c.a, *fb = f + dof * c.b;
    fb[0] += x;
    fb[1] += y;
    fb[2] += moment + c.arm_b.x() * y - c.arm_b.y() * x;
    fa[0] -= x;
    fa[1] -= y;
    fa[2] -= moment + c.arm_a.x() * y - c.arm_a.y() * x;
  }

  template <class Visit>
  void for_each_point(Visit&& visit) {
    for (const Contact& c : contacts_)
      for (int k = c.first; k < c.last; ++k) {
        Point& p = points_[static_cast<std::size_t>(k)];
        visit(c, p, c.offset_of(p));
      }
  }

  std::vector<Law> laws_;
  std::vector<Contact> contacts_;
  std::vector<Point> points_;
};

template <class Geometry, class Law>
template <class Area>
void ContactGroup<Geometry, Law>::add(int a, int b, const Area& area, const Vec<dim>& centre_a,
                                      const Vec<dim>& centre_b, std::span<const FacetPoint<dim>> at,
                                      int law) {
  Contact contact;
  contact.law = law;
  contact.normal = area.area_vector().normalized();
  contact.arm_a = area.centre_from(centre_a);
  contact.arm_b = area.centre_from(centre_b);
  contact.a = a;
  contact.b = b;
  contact.first = static_cast<int>(points_.size());
  contact.last = contact.first + static_cast<int>(at.size());
  contact.tangents = tangent_basis(contact.normal);
  for (const FacetPoint<dim>& point : at) {
    points_.push_back(
        {{stacked(0.0, transposed(contact.tangents) * point.offset), point.weight, {}}, {}});
  }
  contacts_.push_back(contact);
}

template <class Geometry, class Law>
int ContactGroup<Geometry, Law>::commit(const double* u) {
  int weakened = 0;
  for_each_point([&](const Contact& c, Point& p, const Vec<dim>& offset) {
    const PointLoad<dim> load{p.weight, p.initial, c.motion(p, offset, u)};
    const PointForce<dim> before = law_of(c).force(load, p.state);
    law_of(c).commit(load, p.state);
    const PointForce<dim> after = law_of(c).force(load, p.state);
    const double change =
        std::abs(after.normal - before.normal) + (after.tangential - before.tangential).norm();
    if (change > 1e-9 * (std::abs(before.normal) + before.tangential.norm())) ++weakened;
  });
  return weakened;
}

}  // namespace voussoir
