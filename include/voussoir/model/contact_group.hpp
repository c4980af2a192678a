// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/contact_arrays.hpp>
#include <voussoir/model/detail/difference_forces.hpp>
#include <voussoir/model/detail/law_model.hpp>
#include <voussoir/model/point_loads.hpp>
#include <voussoir/model/reference_contact.hpp>

namespace voussoir {

/// All contacts of one kind, with their points and history. Their laws are of one type, known at
/// run time: everything but the kernels of forces is compiled once for all of them.
///
/// Points lie in flat arrays (`ContactArrays`), of which forces read what they need. To everybody
/// else a point is a value, put together when asked for and stored back when changed.
template <class Geometry>
class ContactGroup {
 public:
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;
  using Law = AnyLaw<dim>;
  using Contact = ReferenceContact<dim>;
  using Points = ContactArrays<dim>;
  using Point = typename Points::Point;

  /// @throws InvalidInput  laws of different types
  explicit ContactGroup(std::vector<Law> laws) { set_laws(std::move(laws)); }

  [[nodiscard]] const std::vector<Law>& laws() const { return laws_; }
  /// @return  its index
  /// @throws InvalidInput  it is not of the type of those that there are
  int add_law(Law law) {
    std::vector<Law> laws = laws_;
    laws.push_back(std::move(law));
    set_laws(std::move(laws));
    return static_cast<int>(laws_.size()) - 1;
  }
  /// Gives the contacts other laws; what their points remember stays.
  /// @throws InvalidInput  they are not as many, or of another type
  void replace_laws(std::vector<Law> laws) {
    require(laws.size() == laws_.size(), "contact laws in place of others",
            static_cast<double>(laws.size()), "as many as there are");
    std::vector<Law> both = laws_;
    both.insert(both.end(), laws.begin(), laws.end());
    (void)detail::states_of(both);
    laws_ = std::move(laws);
  }
  [[nodiscard]] const Law& law_of(const Contact& c) const {
    return laws_[static_cast<std::size_t>(c.law)];
  }
  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }
  /// A range of values.
  [[nodiscard]] const Points& points() const { return points_; }
  [[nodiscard]] std::vector<Point> points_of(const Contact& c) const {
    std::vector<Point> points;
    points.reserve(c.count);
    for (int k = c.first; k < c.last(); ++k) points.push_back(points_[static_cast<std::size_t>(k)]);
    return points;
  }

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
  /// Adds a contact as it is, but for the place of its points.
  /// @param uncounted  of the overlap of its bodies, see `MovingContact` [m]
  void add(Contact contact, std::span<const Point> points, double uncounted = 0) {
    contact.set_points(static_cast<int>(points_.size()), points.size());
    for (const Point& p : points) points_.push_back(p);
    contacts_.push_back(contact);
    if (uncounted == 0) return;
    uncounted_.resize(contacts_.size(), 0.0);
    uncounted_.back() = uncounted;
  }
  /// Of the overlap of the bodies of a contact, that presses on no spring [m].
  [[nodiscard]] double uncounted(std::size_t contact) const {
    return contact < uncounted_.size() ? uncounted_[contact] : 0.0;
  }

  /// Calls visit(contact, points) for every contact; both may be changed, but for their number, and
  /// are stored back.
  template <class Visit>
  void each_contact(Visit&& visit) {
    for (Contact& c : contacts_) {
      std::vector<Point> points = points_of(c);
      visit(c, std::span<Point>(points));
      for (std::size_t k = 0; k < points.size(); ++k)
        points_.set(static_cast<std::size_t>(c.first) + k, points[k]);
    }
  }

  /// Sets the initial force at every point from the stress there: on b, -traction of the facet.
  template <class StressAt>
  void set_initial(StressAt&& stress_at) {
    for_each_point(
        [&](const Contact& c, std::size_t k, ReferencePoint<dim> p, const Vec<dim>& offset) {
          const Vec<dim> force = stress_at(c, offset) * c.normal * p.weight;
          p.initial = {c.normal.dot(force), transposed(c.tangents()) * force};
          points_.set_place(k, p);
        });
  }

  /// Makes `u` the displacement at which contacts first, first + 1, ... touch without force: for
  /// those that are installed on ground which has already moved.
  void touch_at(const double* u, std::size_t first) {
    for (std::size_t k = first; k < contacts_.size(); ++k) {
      const Contact& c = contacts_[k];
      for (auto i = static_cast<std::size_t>(c.first); i < static_cast<std::size_t>(c.last());
           ++i) {
        ReferencePoint<dim> p = points_.place(i);
        p.initial = {};
        p.start = -c.linear_motion(p, u);
        points_.set_place(i, p);
      }
    }
  }

  /// Adds the contact forces at displacement `u` to `f`, both dof values per body.
  template <class History>
  void add_forces(const double* u, double* f) {
    add_forces<History>(nullptr, contacts_.size(), u, f);
  }
  /// The same for the contacts with these numbers only.
  template <class History>
  void add_forces(std::span<const int> which, const double* u, double* f) {
    VOUSSOIR_ASSERT(
        std::all_of(which.begin(), which.end(),
                    [&](int k) { return static_cast<std::size_t>(k) < contacts_.size(); }),
        "there are such contacts");
    if (!which.empty()) add_forces<History>(which.data(), which.size(), u, f);
  }

  /// Brings the history up to date with displacement `u`.
  /// @return  points whose force changed by that: joints that failed, and are weaker now
  int commit(const double* u);

  /// Lets joints creep for a time [s] at displacement `u`, those whose law does.
  void creep(const double* u, double time) {
    for (const Contact& c : contacts_)
      visit_loads(c, u, [&](std::size_t k, const auto&, const auto&, const PointLoad<dim>& load) {
        law_of(c).model().creep(load, points_.states().at(k), time);
      });
  }

  /// Hands the elastic (closed, sticking) stiffness of each contact to `sink(a, b, aa, ab, bb)`.
  template <class Sink>
  void add_stiffness(Sink&& sink) const {
    using Block = Fixed<dof, dof>;
    for (const Contact& c : contacts_) {
      Block aa = zeros<Block>(), ab = zeros<Block>(), bb = zeros<Block>();
      for (int k = c.first; k < c.last(); ++k) {
        const ReferencePoint<dim> p = points_.place(static_cast<std::size_t>(k));
        const Vec<dim> offset = c.offset_of(p);
        for (int direction = 0; direction < dim; ++direction) {
          const Vec<dim> unit = direction == 0 ? c.normal : column(c.tangents(), direction - 1);
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
    for (const int number : which) {
      const Contact& c = contacts_[static_cast<std::size_t>(number)];
      Block aa = zeros<Block>(), ab = zeros<Block>(), ba = zeros<Block>(), bb = zeros<Block>();
      bool is_whole = true;
      visit_loads(
          c, u,
          [&](std::size_t k, const auto&, const Vec<dim>& offset, const PointLoad<dim>& load) {
            is_whole = is_whole && load.whole_over_part == 1 && !load.is_lifted();
            if (!is_whole) return;
            const Stress<dim> stiffness =
                law_of(c).model().tangent_at(load, points_.states().at(k));
            Rows a, b;
            for (int l = 0; l < dim; ++l) {
              const Vec<dim> axis = l == 0 ? c.normal : column(c.tangents(), l - 1);
              set_column(a, l, stacked(axis, moment_of(c.arm_a + offset, axis)));
              set_column(b, l, stacked(axis, moment_of(c.arm_b + offset, axis)));
            }
            const Rows sa = a * stiffness, sb = b * stiffness;
            aa += sa * transposed(a);
            ab -= sa * transposed(b);
            ba -= sb * transposed(a);
            bb += sb * transposed(b);
          });
      if (!is_whole)
        detail::difference_forces(
            c, u, [&](detail::ForceTask<dim>& task) { add_forces_of(task); }, aa, ab, ba, bb);
      sink(c.a, c.b, aa, ab, ba, bb);
    }
  }

  /// Calls visit(contact, point, load, force) for every point at displacement `u`; where a joint is
  /// open from one edge on, those of its pressed part.
  template <class Visit>
  void visit(const double* u, Visit&& visit) const {
    for (const Contact& c : contacts_)
      visit_loads(c, u,
                  [&](std::size_t k, const ReferencePoint<dim>& at, const auto&,
                      const PointLoad<dim>& load) {
                    Point p = points_[k];
                    static_cast<ReferencePoint<dim>&>(p) = at;
                    visit(c, p, load, law_of(c).force(load, p.state));
                  });
  }

  /// Sum of the shear forces of a contact at displacement `u` [N].
  /// @param points  of the contact, here or to be
  [[nodiscard]] Vec<dim - 1> shear_of(const Contact& c, std::span<const Point> points,
                                      const double* u) const {
    Vec<dim - 1> sum = zeros<Vec<dim - 1>>();
    detail::visit_pressed<dim>(
        points.size(), c.outline, [&](std::size_t k) { return points[k]; },
        [&](const auto& p) {
          return PointLoad<dim>{p.weight, p.initial, motion_of(c, p, u)};
        },
        detail::PointsOfAny(
            law_of(c).model(),
            [&](std::size_t k) { return points[k].state.of(law_of(c).model().states()); }),
        [&](std::size_t k, const auto&, const PointLoad<dim>& load) {
          sum += law_of(c).force(load, points[k].state).tangential;
        });
    return sum;
  }

  /// Forgets the contacts of bodies for which `gone(body)` holds.
  template <class Gone>
  void remove(Gone&& gone) {
    // In their place: what is kept only moves towards the front.
    std::size_t kept = 0, end = 0;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      Contact c = contacts_[k];
      if (gone(c.a) || gone(c.b)) continue;
      points_.move_down(static_cast<std::size_t>(c.first), end, c.count);
      c.first = static_cast<int>(end);
      end += c.count;
      if (k < uncounted_.size()) uncounted_[kept] = uncounted_[k];
      contacts_[kept++] = c;
    }
    contacts_.erase(contacts_.begin() + static_cast<std::ptrdiff_t>(kept), contacts_.end());
    points_.truncate(end);
    if (uncounted_.size() > kept) uncounted_.resize(kept);
  }

 private:
  /// @param which  null: the first `count`
  template <class History>
  void add_forces(const int* which, std::size_t count, const double* u, double* f) {
    if (count == 0) return;
    detail::ForceTask<dim> task;
    task.commits = std::is_same_v<History, Committing>;
    task.contacts = contacts_.data();
    task.which = which;
    task.count = count;
    task.u = u;
    task.f = f;
    add_forces_of(task);
  }
  void add_forces_of(detail::ForceTask<dim>& task) const {
    task.records = points_.records();
    task.shifts = points_.shifts();
    // Written if the task brings the history up to date, and then asked for by who may.
    task.states = const_cast<void*>(static_cast<const void*>(points_.states().data()));
    task.laws = laws_.data();
    laws_.front().model().add_forces(task);
  }
  void set_laws(std::vector<Law> laws) {
    if (!laws.empty()) points_.states().set_model(detail::states_of(laws));
    laws_ = std::move(laws);
  }

  [[nodiscard]] static PointMotion<dim> motion_of(const Contact& c, const ReferencePoint<dim>& p,
                                                  const double* u) {
    return c.motion(p, c.offset_of(p), u);
  }
  /// What its law says of the points of a contact.
  [[nodiscard]] auto said_of(const Contact& c) const {
    const auto first = static_cast<std::size_t>(c.first);
    return detail::PointsOfAny(
        law_of(c).model(), [this, first](std::size_t k) { return points_.states().at(first + k); });
  }
  /// Calls visit(number of the point, point, offset, load) for the points of a contact at
  /// displacement `u`, on its pressed part.
  template <class Visit>
  void visit_loads(const Contact& c, const double* u, Visit&& visit) const {
    const auto first = static_cast<std::size_t>(c.first);
    detail::visit_pressed<dim>(
        c.count, c.outline, [&](std::size_t k) { return points_.place(first + k); },
        [&](const auto& p) {
          return PointLoad<dim>{p.weight, p.initial, motion_of(c, p, u)};
        },
        said_of(c),
        [&](std::size_t k, const ReferencePoint<dim>& p, const PointLoad<dim>& load) {
          visit(first + k, p, c.offset_of(p), load);
        });
  }
  /// Calls visit(contact, number of the point, point, offset) for every point.
  template <class Visit>
  void for_each_point(Visit&& visit) {
    for (const Contact& c : contacts_)
      for (auto k = static_cast<std::size_t>(c.first); k < static_cast<std::size_t>(c.last());
           ++k) {
        const ReferencePoint<dim> p = points_.place(k);
        visit(c, k, p, c.offset_of(p));
      }
  }

  std::vector<Law> laws_;
  std::vector<Contact> contacts_;
  std::vector<double> uncounted_;  ///< of the first contacts; of those behind it is 0
  Points points_;
};

template <class Geometry>
template <class Area>
void ContactGroup<Geometry>::add(int a, int b, const Area& area, const Vec<dim>& centre_a,
                                 const Vec<dim>& centre_b, std::span<const FacetPoint<dim>> at,
                                 int law) {
  Contact contact;
  contact.set_law(law);
  const Vec<dim> normal = area.area_vector().normalized();
  const TangentBasis<dim> tangents = tangent_basis(normal);
  contact.set_frame(normal, tangents);
  contact.arm_a = area.centre_from(centre_a);
  contact.arm_b = area.centre_from(centre_b);
  contact.a = a;
  contact.b = b;
  contact.set_points(static_cast<int>(points_.size()), at.size());
  contact.outline = detail::kept_outline(area, area.centre(), at.data(), at.size());
  for (const FacetPoint<dim>& point : at) {
    Point p;
    p.offset = stacked(0.0, transposed(tangents) * point.offset);
    p.weight = point.weight;
    points_.push_back(p);
  }
  contacts_.push_back(contact);
}

template <class Geometry>
int ContactGroup<Geometry>::commit(const double* u) {
  int weakened = 0;
  const auto commit_point = [&](const Contact& c, std::size_t k, const PointLoad<dim>& load) {
    return law_of(c).model().commit_point(load, points_.states().at(k));
  };
  for (const Contact& c : contacts_) {
    std::array<PointLoad<dim>, PressedPart<dim>::count> loads;
    const auto first = static_cast<std::size_t>(c.first);
    visit_loads(c, u, [&](std::size_t k, const auto&, const auto&, const PointLoad<dim>& load) {
      weakened += commit_point(c, k, load) ? 1 : 0;
      if (k - first < loads.size()) loads[k - first] = load;
    });
    if (c.count != loads.size()) continue;
    (void)detail::let_go_of_bond<dim>(
        loads.data(), c.outline,
        [&](std::size_t k) {
          const ReferencePoint<dim> p = points_.place(first + k);
          return PointLoad<dim>{p.weight, p.initial, motion_of(c, p, u)};
        },
        said_of(c),
        [&](std::size_t k, const PointLoad<dim>& load) {
          weakened += commit_point(c, first + k, load) ? 1 : 0;
          return 0.0;
        });
  }
  return weakened;
}

}  // namespace voussoir
