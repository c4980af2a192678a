// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// What a contact does to its two bodies at one instant.
template <int Dim>
struct Reaction {
  Vec<Dim> force;       ///< on b; a gets the opposite [N]
  Spin<Dim> moment[2];  ///< on a and on b, about their centres, world axes [N m]
};

/// What contacts turn into heat.
struct Dissipation {
  double friction = 0;   ///< slip and damage, as the law says [J]
  double viscosity = 0;  ///< dashpots, per time [W]
};

/// A contact between bodies that move and turn by any amount.
template <int Dim>
struct MovingContact {
  Rotation<Dim> frame;       ///< columns: normal from a to b, tangents; in the frame of body a
  std::int32_t a, b;         ///< bodies; a owns the face
  std::int32_t first, last;  ///< points
  std::int32_t law = 0;      ///< index into the laws of the group
  bool is_centred = false;   ///< touches in the middle alone: a lining that was installed at rest
  double viscosity = 0;      ///< damping force over (stiffness times velocity) [s]
  double uncounted = 0;      ///< of the overlap, that presses on no spring (`limit_energy`) [m]
  double least_area = 0;     ///< its points' together, since the impact (`Impact`) [m], [m^2]

  /// Where its frame is with its bodies at these poses, and what follows from that.
  struct Place {
    Rotation<Dim> frame_b;  ///< columns: normal and tangents in the frame of b
    Vec<Dim> base;          ///< centre of b less centre of a, in the contact's frame
  };
  [[nodiscard]] Place place(const Pose<Dim>& at_a, const Pose<Dim>& at_b) const {
    const Rotation<Dim> now = at_a.rotation * frame;
    return {transposed_product(at_b.rotation, now),
            transposed_product(now, Vec<Dim>(at_b.position - at_a.position))};
  }
};

/// A point of a contact, fixed in body b.
/// @tparam State  what the contact law remembers of it
template <int Dim, class State>
struct MovingContactPoint {
  Vec<Dim> place;  ///< in the frame of body b [m]
  Vec<Dim> zero;   ///< coordinates in the contact's frame at which opening and slip are zero [m]
  double weight;   ///< length or area [m], [m^2]
  PointForce<Dim> initial;
  [[no_unique_address]] State state;

  [[nodiscard]] PointMotion<Dim> motion(const typename MovingContact<Dim>::Place& at) const {
    const Vec<Dim> m = at.base + transposed_product(at.frame_b, place) - zero;
    return {m[0], part<Dim - 1>(m, 1)};
  }
  [[nodiscard]] PointLoad<Dim> load(const typename MovingContact<Dim>::Place& at) const {
    return {weight, initial, motion(at)};
  }
};

/// Contacts that follow laws of one kind, between bodies that move and turn by any amount.
///
/// A contact point is fixed in body b, and touches the face of body a: its opening and slip are its
/// coordinates in a frame that turns with that face, less what they were when the joint was closed.
/// Forces on both bodies act in the same place, so that momentum and angular momentum are kept to
/// rounding.
template <int Dim, class Law>
class MovingContacts {
 public:
  using State = typename Law::template State<Dim>;

  using Point = MovingContactPoint<Dim, State>;
  using Contact = MovingContact<Dim>;

  explicit MovingContacts(std::vector<Law> laws) : laws_(std::move(laws)) {}

  [[nodiscard]] const std::vector<Law>& laws() const { return laws_; }
  /// @return  its index
  std::int32_t add_law(Law law) {
    laws_.push_back(std::move(law));
    return static_cast<std::int32_t>(laws_.size()) - 1;
  }
  /// @throws InvalidInput  not as many as there are
  void set_laws(std::vector<Law> laws) {
    require(laws.size() == laws_.size(), "number of contact laws", static_cast<double>(laws.size()),
            "as many as before");
    laws_ = std::move(laws);
  }
  [[nodiscard]] const Law& law_of(const Contact& c) const {
    return laws_[static_cast<std::size_t>(c.law)];
  }
  [[nodiscard]] std::vector<Contact>& contacts() { return contacts_; }
  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }
  [[nodiscard]] std::vector<Point>& points() { return points_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] std::size_t size() const { return contacts_.size(); }
  [[nodiscard]] std::span<const Point> points_of(const Contact& c) const {
    return {points_.data() + c.first, static_cast<std::size_t>(c.last - c.first)};
  }

  /// Puts a contact with its points in the place of another, or behind all.
  /// @param number  of the other, which leaves its points behind if they are fewer or more; -1:
  ///                none. The number of the new one afterwards
  /// @return  true if its points lie where those of the other did
  bool put(std::int32_t& number, Contact contact, const std::vector<Point>& points) {
    const auto count = static_cast<std::int32_t>(points.size());
    const bool is_new = number < 0;
    if (is_new) {
      number = static_cast<std::int32_t>(contacts_.size());
      contacts_.emplace_back();
    }
    Contact& place = contacts_[static_cast<std::size_t>(number)];
    const bool fits = !is_new && place.last - place.first == count;
    contact.first = fits ? place.first : static_cast<std::int32_t>(points_.size());
    contact.last = contact.first + count;
    if (fits)
      std::copy(points.begin(), points.end(), points_.begin() + contact.first);
    else
      points_.insert(points_.end(), points.begin(), points.end());
    place = contact;
    return fits;
  }
  /// Keeps these contacts and their points alone, in this order, and numbers them anew.
  /// @param each  each(visit) calls visit(number) for every one, to be changed
  template <class Each>
  void keep(Each&& each) {
    std::vector<Contact> contacts;
    std::vector<Point> points;
    contacts.reserve(contacts_.size());
    points.reserve(points_.size());
    each([&](std::int32_t& number) {
      Contact c = contacts_[static_cast<std::size_t>(number)];
      const std::span<const Point> own = points_of(c);
      c.first = static_cast<std::int32_t>(points.size());
      points.insert(points.end(), own.begin(), own.end());
      c.last = static_cast<std::int32_t>(points.size());
      number = static_cast<std::int32_t>(contacts.size());
      contacts.push_back(c);
    });
    contacts_.swap(contacts);
    points_.swap(points);
  }

  /// Forces of contact `k` with the bodies at these poses, history brought up to date.
  template <class Bodies>
  [[nodiscard]] Reaction<Dim> react(std::size_t k, const Bodies& bodies, Dissipation& lost) {
    const Contact& c = contacts_[k];
    const auto &a = bodies[static_cast<std::size_t>(c.a)],
               &b = bodies[static_cast<std::size_t>(c.b)];
    if constexpr (Dim == 2)
      return react_in_plane(c, a, b, lost);
    else
      return react_in_space(c, a, b, lost);
  }

  /// Energy that the springs of contact `k` hold [J].
  template <class Bodies>
  [[nodiscard]] double stored_energy(std::size_t k, const Bodies& bodies) const {
    const Contact& c = contacts_[k];
    const auto at = c.place(bodies[static_cast<std::size_t>(c.a)].pose,
                            bodies[static_cast<std::size_t>(c.b)].pose);
    double sum = 0;
    for (auto i = static_cast<std::size_t>(c.first); i < static_cast<std::size_t>(c.last); ++i)
      sum += law_of(c).stored_energy(points_[i].load(at), points_[i].state);
    return sum;
  }

 private:
  /// Number by number: small vectors are carried through memory by g++ 12 when they are put
  /// together from parts, which doubles the time. So in 3-D.
  template <class Body>
  [[nodiscard]] Reaction<Dim> react_in_plane(const Contact& c, const Body& a, const Body& b,
                                             Dissipation& lost) requires(Dim == 2) {
    const double ca = a.pose.rotation(0, 0), sa = a.pose.rotation(1, 0);
    const double cb = b.pose.rotation(0, 0), sb = b.pose.rotation(1, 0);
    const double fx = c.frame(0, 0), fy = c.frame(1, 0);
    const double nx = ca * fx - sa * fy, ny = sa * fx + ca * fy;  // normal, world
    const double mx = cb * nx + sb * ny, my = cb * ny - sb * nx;  // normal, frame of b
    const double dx = b.pose.position.x() - a.pose.position.x();
    const double dy = b.pose.position.y() - a.pose.position.y();
    const double base_n = nx * dx + ny * dy, base_t = nx * dy - ny * dx;  // tangent (-ny, nx)
    double force_n = 0, force_t = 0, moment = 0;
    const Law& law = law_of(c);
    const Point* const end = points_.data() + c.last;
    for (Point* p = points_.data() + c.first; p != end; ++p) {
      const double px = p->place.x(), py = p->place.y();
      const double along_n = mx * px + my * py, along_t = mx * py - my * px;
      PointLoad<Dim> load{p->weight, p->initial, {base_n + along_n - p->zero[0], {}}};
      load.motion.slip[0] = base_t + along_t - p->zero[1];
      const PointForce<Dim> f = law.force(load, p->state);
      lost.friction += law.commit(load, p->state);
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
    Reaction<Dim> r;
    const double x = nx * force_n - ny * force_t, y = ny * force_n + nx * force_t;
    r.force << x, y;
    r.moment[1][0] = moment;
    r.moment[0][0] = -(moment + dx * y - dy * x);
    return r;
  }

  template <class Body>
  [[nodiscard]] Reaction<Dim> react_in_space(const Contact& c, const Body& a, const Body& b,
                                             Dissipation& lost) requires(Dim == 3) {
    const Rotation<Dim> frame = a.pose.rotation * c.frame;
    const Vec<Dim> arm = b.pose.position - a.pose.position;
    const typename Contact::Place at{transposed_product(b.pose.rotation, frame),
                                     transposed_product(frame, arm)};
    const Law& law = law_of(c);
    const double *n = at.frame_b.data(), *s = n + 3, *t = n + 6, *base = at.base.data();
    double x = 0, y = 0, z = 0;     // force on b, along its axes
    double mx = 0, my = 0, mz = 0;  // moment about its centre
    const Point* const end = points_.data() + c.last;
    for (Point* p = points_.data() + c.first; p != end; ++p) {
      const double px = p->place.data()[0], py = p->place.data()[1], pz = p->place.data()[2];
      PointLoad<Dim> load;
      load.weight = p->weight;
      load.initial.normal = p->initial.normal;
      for (int k = 0; k < 2; ++k)
        load.initial.tangential.data()[k] = p->initial.tangential.data()[k];
      load.motion.opening = base[0] + (n[0] * px + n[1] * py + n[2] * pz) - p->zero.data()[0];
      load.motion.slip.data()[0] =
          base[1] + (s[0] * px + s[1] * py + s[2] * pz) - p->zero.data()[1];
      load.motion.slip.data()[1] =
          base[2] + (t[0] * px + t[1] * py + t[2] * pz) - p->zero.data()[2];
      const PointForce<Dim> f = law.force(load, p->state);
      lost.friction += law.commit(load, p->state);
      double normal = f.normal;
      const double along_s = f.tangential.data()[0], along_t = f.tangential.data()[1];
      if (c.viscosity > 0 && normal > 0)
        normal += damping_force(c, *p, a, b, frame, arm, f.normal, lost);
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
    Reaction<Dim> r;
    r.force = b.pose.rotation * Vec<3>(x, y, z);
    r.moment[1] = b.pose.rotation * Spin<3>(mx, my, mz);
    r.moment[0] = -(r.moment[1] + moment_of(arm, r.force));
    return r;
  }

  /// The dashpot beside a normal spring. It never pulls the blocks together. There is none in
  /// shear: it would carry what friction has let go.
  template <class Body>
  [[nodiscard]] double damping_force(const Contact& c, const Point& p, const Body& a, const Body& b,
                                     const Rotation<Dim>& frame, const Vec<Dim>& arm, double normal,
                                     Dissipation& lost) const {
    const Vec<Dim> place = arm + b.pose.rotation * p.place;  // from the centre of a, world axes
    const double rate = column(frame, 0).dot(b.velocity_at(p.place) -
                                             a.velocity_at(transposed(a.pose.rotation) * place));
    const double viscous =
        std::max(-c.viscosity * p.weight * law_of(c).joint_normal_stiffness() * rate, -normal);
    lost.viscosity -= viscous * rate;
    return viscous;
  }

  std::vector<Law> laws_;
  std::vector<Contact> contacts_;
  std::vector<Point> points_;
};

}  // namespace voussoir
