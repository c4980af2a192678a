// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/detail/open_linings.hpp>
#include <voussoir/model/opened_lining.hpp>
#include <voussoir/model/small_displacement.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// Hands over to the model of rock that has been excavated further what the model before knew:
/// where bodies are, what joints remember, linings and bolts.
///
/// Bodies that are cut go on as pieces, rigidly: every piece is where it was as a part of the
/// whole. A contact that is left gets the history of the nearest point of the same two bodies on
/// the same plane, so that one which has not changed goes on as it was, bit for bit. Its in-situ
/// force is that of the stress field, not of the contact before: rock that is excavated in rounds
/// ends as rock that is excavated at once.
///
/// Where contacts have been updated since the in-situ state, points are handed over by their place
/// instead, each to the pieces that it lies between; a contact update has to follow.
template <class System>
class CarryOver {
 public:
  static constexpr int dim = System::dim;
  static constexpr int dof = System::dof;
  using Opening = typename System::GeometryType::Opening;

  /// @param old      the model so far: blocks, the ground, nodes of linings
  /// @param origins  of every block of the next one, which block it is a piece of; ascending
  /// @param next     its blocks, the ground and the contacts of the in-situ state; shapes
  /// @param tolerance  of the domain [m]
  /// @param opening  what is excavated; it outlives this
  CarryOver(const System& old, const std::vector<int>& origins, System& next, double tolerance,
            const Opening& opening)
      : old_(old),
        next_(next),
        tolerance_(tolerance),
        opening_(opening),
        ground_(next.body_count() - 1) {
    old_ground_ = static_cast<int>(old.shapes->size()) - 1;
    first_piece_.assign(index(old_ground_) + 2, 0);
    for (const int b : origins) ++first_piece_[index(b) + 1];
    for (std::size_t b = 0; b <= index(old_ground_); ++b) first_piece_[b + 1] += first_piece_[b];
    origins_ = origins;
  }

  /// @throws InvalidInput  what is excavated carries a bolt; `next` is then of no use
  void run() {
    add_nodes();
    carry_displacement();
    if (old_.has_updated_contacts()) {
      move_contacts(old_.joints, next_.joints);
      move_contacts(old_.boundary, next_.boundary);
    } else {
      carry_history(old_.joints, next_.joints);
      carry_history(old_.boundary, next_.boundary);
    }
    next_.interface = typename System::Contacts(old_.interface.laws());
    move_contacts(old_.interface, next_.interface);
    next_.supports = old_.supports;
    const auto heir = [this](int b, const Vec<dim>& arm) { return this->heir(b, arm); };
    for (const auto& support : next_.supports) support->take_over(heir);
    std::vector<int> gone;
    for (int b = 0; b < ground_; ++b)
      if (old_.body(origin(b)).is_gone) gone.push_back(b);
    if (!gone.empty()) next_.remove(gone);
    open_linings();
    next_.patterns = old_.patterns;
  }

  /// Linings through which the round goes.
  [[nodiscard]] const std::vector<OpenedLining<dim>>& opened() const { return opened_; }

  /// The pieces of a block of the old model: [first, last) among those of the next one.
  [[nodiscard]] std::pair<int, int> pieces(int old) const {
    return {first_piece_[index(old)], first_piece_[index(old) + 1]};
  }

  /// What is left of a load on the blocks; of one in several pieces the heaviest takes it.
  /// @param load  may end before the nodes of linings that came later
  [[nodiscard]] Eigen::VectorXd carry_load(const Eigen::VectorXd& load) const {
    Eigen::VectorXd next = Eigen::VectorXd::Zero(next_.displacement.size());
    for (int b = 0; b < old_ground_; ++b) {
      const auto [first, last] = pieces(b);
      if (first == last) continue;
      int heir = first;
      for (int k = first + 1; k < last; ++k)
        if (next_.body(k).weight > next_.body(heir).weight) heir = k;
      Fixed<dof, 1> on_body = part<dof>(load, dof * b);
      if (!is_unchanged(b)) {
        const Vec<dim> shift = old_.arm(b, next_.body(heir).centre);
        add_at<dof - dim>(on_body.data() + dim, moment_of(Vec<dim>(-shift), part<dim>(on_body, 0)));
      }
      set_part<dof>(next, dof * heir, on_body);
    }
    for (int b = old_ground_ + 1; b < old_.body_count() && dof * b < load.size(); ++b)
      set_part<dof>(next, dof * number(b), part<dof>(load, dof * b));
    return next;
  }

  /// Marks the blocks that the excavation has changed, and their neighbours, and nodes of linings
  /// that have lost rock or a member: all on which it has acted.
  [[nodiscard]] BodyMarks touched() const {
    BodyMarks marks(index(old_.body_count()), 0);
    for (int b = 0; b < old_ground_; ++b) marks[index(b)] = is_unchanged(b) ? 0 : 1;
    const BodyMarks changed = marks;
    for (const auto& c : old_.joints.contacts()) {
      if (changed[index(c.a)] != 0) marks[index(c.b)] = 1;
      if (changed[index(c.b)] != 0) marks[index(c.a)] = 1;
    }
    BodyMarks of_next = touched_;
    for (int b = 0; b < ground_; ++b) of_next[index(b)] |= marks[index(origin(b))];
    return of_next;
  }

 private:
  using Contact = ReferenceContact<dim>;

  [[nodiscard]] static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] int origin(int next) const { return origins_[index(next)]; }
  /// The new number of the ground or of a node.
  [[nodiscard]] int number(int old) const { return ground_ + (old - old_ground_); }

  [[nodiscard]] bool is_unchanged(int old) const {
    const auto [first, last] = pieces(old);
    if (last - first != 1) return false;
    const auto &was = old_.body(old), &is = next_.body(first);
    return was.weight == is.weight && was.centre == is.centre;
  }

  void add_nodes() {
    for (int b = old_ground_ + 1; b < old_.body_count(); ++b) {
      const int node = next_.add_body(old_.body(b));
      set_part<dof>(next_.load, dof * node, part<dof>(old_.load, dof * b));
    }
    next_.linings = old_.linings;
    for (auto& lining : next_.linings) {
      lining.first = number(lining.first);
      // What fills a hole stays on the piece of its block that is nearest to it.
      for (auto& fill : lining.fills)
        fill.body = piece_near(fill.body, mass_properties(fill.shape).centroid,
                               std::numeric_limits<double>::infinity());
      std::erase_if(lining.fills, [](const auto& fill) { return fill.body < 0; });
    }
  }

  void carry_displacement() {
    const bool updated = old_.has_updated_contacts();
    Eigen::VectorXd updated_at;
    std::vector<Rotation<dim>> turned;
    if (updated) {
      updated_at = Eigen::VectorXd::Zero(next_.displacement.size());
      turned.assign(index(next_.body_count()), diagonal_of<dim>(1));
    }
    for (int next = 0; next < next_.body_count(); ++next) {
      const int b = next < ground_ ? origin(next) : next - ground_ + old_ground_;
      Fixed<dof, 1> u = part<dof>(old_.displacement, dof * b);
      Fixed<dof, 1> found =
          updated ? part<dof>(old_.updated_at(), dof * b) : zeros<Fixed<dof, 1>>();
      if (next < ground_ && !is_unchanged(b)) {
        const Vec<dim> apart = next_.body(next).centre - old_.body(b).centre;
        const Vec<dim> arm = old_.arm(b, next_.body(next).centre);
        const Fixed<dof, 1> since = u - found;
        const Vec<dim> step = displacement_at<dim>(since.data(), arm);
        for (int k = 0; k < dim; ++k) {
          found[k] += arm[k] - apart[k];
          u[k] = found[k] + step[k];
        }
      }
      set_part<dof>(next_.displacement, dof * next, u);
      if (!updated) continue;
      set_part<dof>(updated_at, dof * next, found);
      turned[index(next)] = old_.pose_at_update(b).rotation;
    }
    if (updated) next_.set_updated(std::move(updated_at), std::move(turned));
  }

  /// What has become of a point of a body, at a lever from its centre when contacts were last
  /// updated.
  [[nodiscard]] Heir<dim> heir(int b, const Vec<dim>& arm) const {
    const Pose<dim> pose = old_.pose_at_update(b);
    const Vec<dim> place = old_.body(b).centre + Vec<dim>(transposed_product(pose.rotation, arm));
    if (b >= old_ground_) return {number(b), false, arm, place};
    const int piece = piece_at(b, place);
    if (piece < 0) return {piece, opening_.contains(place), arm, place};
    if (is_unchanged(b)) return {piece, false, arm, place};
    return {piece, false, Vec<dim>(arm - old_.arm(b, next_.body(piece).centre)), place};
  }
  /// The piece of a block in which a place of the in-situ state lies, or, if it lay before the
  /// block, as a lining does where it fills a hole, the piece that is as near as the block was;
  /// -1: that is gone.
  [[nodiscard]] int piece_at(int b, const Vec<dim>& place) const {
    if (is_unchanged(b)) return pieces(b).first;
    double before = std::numeric_limits<double>::infinity();
    for (const auto& part : (*old_.shapes)[index(b)])
      before = std::min(before, outside_of(part, place));
    return piece_near(b, place, std::max(0.0, before) + 100 * tolerance_);
  }
  /// How far a place is outside a convex part, at least [m].
  template <class Part>
  [[nodiscard]] static double outside_of(const Part& part, const Vec<dim>& place) {
    double outside = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < part.size(); ++k)
      outside = std::max(outside, part.half_space(k).distance(place));
    return outside;
  }
  /// The piece of a block that a place is in, or nearest to.
  /// @param least  it is nearer than this [m]
  [[nodiscard]] int piece_near(int b, const Vec<dim>& place, double least) const {
    const auto [first, last] = pieces(b);
    int best = -1;
    for (int piece = first; piece < last; ++piece)
      for (const auto& part : (*next_.shapes)[index(piece)])
        if (const double outside = outside_of(part, place); outside < least) {
          least = outside;
          best = piece;
        }
    return best;
  }

  /// The contacts of a group in the order of their bodies, the lower first.
  template <class Group>
  struct Lookup {
    explicit Lookup(const Group& group, int body_count) : contacts(group.contacts()) {
      for (const Contact& c : contacts) bodies.emplace_back(std::minmax(c.a, c.b));
      order = order_of_pairs(bodies, body_count);
    }
    template <class Visit>
    void each_of(int a, int b, Visit&& visit) const {
      const std::pair<int, int> wanted = std::minmax(a, b);
      auto it = std::lower_bound(
          order.begin(), order.end(), wanted,
          [&](int k, const std::pair<int, int>& value) { return bodies[index(k)] < value; });
      for (; it != order.end() && bodies[index(*it)] == wanted; ++it) visit(contacts[index(*it)]);
    }
    const std::vector<Contact>& contacts;
    std::vector<std::pair<int, int>> bodies;
    std::vector<int> order;
  };

  /// Both groups in the axes of the in-situ state.
  template <class Group>
  void carry_history(const Group& from, Group& to) {
    const Lookup<Group> lookup(from, old_.body_count());
    const auto place = [](const System& system, const Contact& c, const auto& p) {
      return Vec<dim>(system.body(c.a).centre + c.arm_a + c.offset_of(p));
    };
    to.each_contact([&](Contact& c, auto points) {
      const auto old_number = [&](int b) { return b < ground_ ? origin(b) : old_ground_; };
      // The contact of the same plane whose points are nearest.
      const Contact* best = nullptr;
      double least = std::numeric_limits<double>::infinity();
      const Vec<dim> middle = next_.body(c.a).centre + c.arm_a;
      lookup.each_of(old_number(c.a), old_number(c.b), [&](const Contact& was) {
        if (std::abs(was.normal.dot(c.normal)) < 0.999) return;
        const Vec<dim> there = old_.body(was.a).centre + was.arm_a;
        const double across = c.normal.dot(Vec<dim>(there - middle));
        const double distance = (there - middle).squaredNorm() + 1e6 * across * across;
        if (distance >= least) return;
        least = distance;
        best = &was;
      });
      if (best == nullptr) return;
      turn_as(*best, c, points);
      for (auto& p : points) {
        const Vec<dim> at = place(next_, c, p);
        double nearest = std::numeric_limits<double>::infinity();
        for (int k = best->first; k < best->last(); ++k) {
          const auto& was = from.points()[index(k)];
          const double distance = (place(old_, *best, was) - at).squaredNorm();
          if (distance >= nearest) continue;
          nearest = distance;
          p.state = was.state;
          p.start = was.start;
        }
      }
    });
  }
  /// Gives a contact the axes of the one before, in which its history is told.
  template <class Points>
  static void turn_as(const Contact& was, Contact& c, Points points) {
    std::vector<Vec<dim>> offsets;
    for (const auto& p : points) offsets.push_back(c.offset_of(p));
    if (c.normal.dot(was.normal) < 0) {
      std::swap(c.a, c.b);
      std::swap(c.arm_a, c.arm_b);
    }
    c.set_frame(was.normal, was.tangents());
    for (std::size_t k = 0; k < offsets.size(); ++k)
      points[k].offset =
          stacked(c.normal.dot(offsets[k]), transposed_product(c.tangents(), offsets[k]));
  }

  /// Every point by its place to the pieces it lies between; what lay on excavated rock is dropped.
  template <class Group>
  void move_contacts(const Group& from, Group& to) {
    Group moved(from.laws());
    struct Target {
      std::pair<int, int> bodies;
      std::vector<typename Group::Point> points;
    };
    std::vector<Target> targets;
    for (std::size_t n = 0; n < from.contacts().size(); ++n) {
      const Contact& c = from.contacts()[n];
      targets.clear();
      for (int k = c.first; k < c.last(); ++k) {
        const auto& p = from.points()[index(k)];
        const Vec<dim> offset = c.offset_of(p);
        const std::pair<int, int> bodies{heir(c.a, c.arm_a + offset).body,
                                         heir(c.b, c.arm_b + offset).body};
        if (bodies.first < 0 || bodies.second < 0) continue;
        auto it = std::find_if(targets.begin(), targets.end(),
                               [&](const Target& t) { return t.bodies == bodies; });
        if (it == targets.end()) it = targets.insert(it, {bodies, {}});
        it->points.push_back(p);
      }
      for (const Target& t : targets) {
        Contact next = c;
        next.a = t.bodies.first;
        next.b = t.bodies.second;
        next.arm_a = c.arm_a - moved_centre(c.a, next.a);
        next.arm_b = c.arm_b - moved_centre(c.b, next.b);
        moved.add(next, t.points, from.uncounted(n));
      }
    }
    to = std::move(moved);
  }
  /// From the centre of a body to that of its piece, when contacts were last updated.
  [[nodiscard]] Vec<dim> moved_centre(int old, int next) const {
    return old < old_ground_ && !is_unchanged(old) ? old_.arm(old, next_.body(next).centre)
                                                   : zeros<Vec<dim>>();
  }

  void open_linings() {
    touched_.assign(index(next_.body_count()), 0);
    if (old_.linings.empty()) return;
    BodyMarks had_rock(index(next_.body_count()), 0);
    for (const Contact& c : old_.interface.contacts()) {
      const int node = number(std::max(c.a, c.b));
      had_rock[index(node)] = 1;
      if (!is_unchanged(std::min(c.a, c.b))) touched_[index(node)] = 1;
    }
    LiningOpener<System> opener(next_, had_rock, opening_, 1e3 * tolerance_);
    opened_ = opener.run();
    for (std::size_t b = 0; b < touched_.size(); ++b) touched_[b] |= opener.touched()[b];
  }

  const System& old_;
  System& next_;
  double tolerance_;
  const Opening& opening_;
  int ground_, old_ground_ = 0;
  std::vector<int> origins_, first_piece_;
  BodyMarks touched_;  ///< rock and nodes where linings are opened
  std::vector<OpenedLining<dim>> opened_;
};

}  // namespace voussoir::detail
