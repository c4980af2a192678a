// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/contact_detector.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/detection/neighbour_list.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/model/moving_body.hpp>

namespace voussoir {

/// Watches which shapes touch as their bodies move, and asks the detector only about pairs that
/// have moved since it was last asked.
///
/// How far a body has moved is a bound on the path of its fastest vertex, summed up. A pair that
/// touches (or is within `reach`) is asked again when its two bodies have moved `refresh` together;
/// one that is further apart when it could have come within reach.
/// @tparam Detector  the narrow phase, a PairDetector
template <int Dim, class Detector = FaceContacts>
class ContactTracker {
  static_assert(explain_pair_detector<Detector, Dim>());

 public:
  using Shape = typename PlacedShapes<Dim>::Shape;
  struct Pair {
    std::uint32_t a, b;         ///< shapes
    std::int32_t contact = -1;  ///< what the caller knows it by; -1: they do not touch
    double moved = -1;          ///< of both bodies, when it was last asked; -1: never
    typename Detector::template Pair<Dim>::Memory memory{};
  };
  using Bodies = std::vector<MovingBody<Dim>>;
  // Who asks is called by a function known at run time: an update is compiled once for all of them.
  using Touches = std::function<void(Pair&, const Contact<Dim>&)>;
  using Parts = std::function<void(Pair&)>;

  /// @param reach    contacts may be so far open [m]
  /// @param refresh  how far the bodies of a contact move before it is updated [m]
  /// @param margin   see NeighbourList [m]
  ContactTracker(double reach, double refresh, double margin)
      : reach_(reach),
        refresh_(refresh),
        margin_(margin),
        // The list is looked at only now and then: bodies may be so far out of their boxes.
        neighbours_(margin, reach + 2 * unseen * margin) {}

  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] const PlacedShapes<Dim>& shapes() const { return shapes_; }
  [[nodiscard]] int body_of(std::size_t shape) const { return body_of_[shape]; }
  /// Whether one of the bodies has several parts: the pair may have but a share of a contact, and
  /// all pairs of the two bodies are asked together.
  [[nodiscard]] bool is_shared(const Pair& pair) const {
    return part_count_[index(body_of_[pair.a])] > 1 || part_count_[index(body_of_[pair.b])] > 1;
  }
  [[nodiscard]] std::vector<Pair>& pairs() { return pairs_; }
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }

  /// Adds a shape to a body.
  /// @param centre    of the body, in the coordinates in which the shape is given [m]
  /// @param rotation  from the body's frame to these
  /// @param family    shapes of one family never touch: the parts of a body, or of a lining
  /// @param touches   the only family that it touches; none: all others
  void add(const Shape& shape, const Vec<Dim>& centre, int body, const Rotation<Dim>& rotation,
           int family, std::optional<int> touches = {}) {
    shapes_.add(shape, centre);
    body_of_.push_back(body);
    if (part_count_.size() <= index(body)) part_count_.resize(index(body) + 1, 0);
    ++part_count_[index(body)];
    family_of_.push_back(family);
    touches_.push_back(touches);
    home_.push_back(transposed(rotation));
  }

  /// Follows the bodies to where they are now; points of contacts are counted from the grid point
  /// of shape a. Calls `touches(pair, contact)` for every pair asked
  /// that is within reach, `parts(pair)` for every pair with a contact that no longer is.
  /// @param moved  no other body has moved since the last update; null: any may have
  /// @cost  of the bodies that may have moved, and of all pairs where the neighbour list is renewed
  void update(const Bodies& bodies, const std::vector<std::uint32_t>* moved, const Touches& touches,
              const Parts& parts);

 private:
  [[nodiscard]] static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] bool is_gone(const Bodies& bodies, const Pair& pair) const {
    return bodies[index(body_of_[pair.a])].is_gone || bodies[index(body_of_[pair.b])].is_gone;
  }

  /// Of both bodies, summed up [m].
  [[nodiscard]] double way_of(const Pair& pair) const {
    return path_[index(body_of_[pair.a])] + path_[index(body_of_[pair.b])];
  }
  [[nodiscard]] bool is_due(const Bodies& bodies, const Pair& pair) const {
    const double allowed = pair.contact >= 0 ? refresh_ : 0.5 * reach_;
    return pair.moved < 0 || way_of(pair) - pair.moved > allowed || is_gone(bodies, pair);
  }
  [[nodiscard]] std::pair<int, int> bodies_of(std::size_t pair) const {
    return std::minmax(body_of_[pairs_[pair].a], body_of_[pairs_[pair].b]);
  }

  /// All pairs of some bodies, each once, in their order.
  [[nodiscard]] std::vector<std::uint32_t> pairs_of(const std::vector<std::uint32_t>& bodies);
  void list_pairs();

  /// Adds what bodies have moved to their paths.
  void follow(const Bodies& bodies, const std::vector<std::uint32_t>* moved);
  /// What is known of a pair goes with it from the old list to the new one.
  void carry_over(const Bodies& bodies, const Parts& parts);

  static constexpr double unseen = 0.1;  ///< of the margin

  double reach_, refresh_, margin_;
  double since_looked_ = 0;  ///< path of the fastest body since the list was looked at [m]
  PlacedShapes<Dim> shapes_;
  [[nodiscard]] bool may_touch(std::uint32_t a, std::uint32_t b) const {
    const int of_a = family_of_[a], of_b = family_of_[b];
    return of_a != of_b && touches_[a].value_or(of_b) == of_b && touches_[b].value_or(of_a) == of_a;
  }

  std::vector<int> body_of_, family_of_;
  std::vector<std::optional<int>> touches_;
  std::vector<int> part_count_;      ///< of every body
  std::vector<std::size_t> shared_;  ///< pairs of bodies of several parts, by their bodies
  std::vector<Rotation<Dim>> home_;  ///< from the shape's own frame to that of its body
  NeighbourList<Dim> neighbours_;
  std::vector<Pair> pairs_;
  std::vector<std::ptrdiff_t> first_pair_;    ///< of every body in the next; empty: not listed
  std::vector<std::uint32_t> pairs_of_body_;  ///< body by body
  std::vector<double> path_;                  ///< of each body, summed [m]
  std::vector<Pose<Dim>> seen_;               ///< poses at the last update
  std::vector<double> placed_;  ///< for every shape, the path of its body when it was placed [m]
};

template <int Dim, class Detector>
void ContactTracker<Dim, Detector>::update(const Bodies& bodies,
                                           const std::vector<std::uint32_t>* moved,
                                           const Touches& touches, const Parts& parts) {
  if (seen_.size() < bodies.size()) moved = nullptr;
  follow(bodies, moved);
  const auto place = [&](std::size_t shape) {
    const std::size_t b = index(body_of_[shape]);
    if (placed_[shape] == path_[b]) return;
    placed_[shape] = path_[b];
    const Pose<Dim>& pose = bodies[b].pose;
    shapes_.place(shape, {pose.position, pose.rotation * home_[shape]});
  };
  if (since_looked_ > unseen * margin_) {
    for (std::size_t s = 0; s < shapes_.size(); ++s) place(s);
    if (neighbours_.update(shapes_)) carry_over(bodies, parts);
    since_looked_ = 0;
  }
  typename Detector::template Pair<Dim> detector(shapes_);
  const auto ask = [&](Pair& pair) {
    if (is_gone(bodies, pair)) {
      if (pair.contact >= 0) parts(pair);
      return;
    }
    pair.moved = way_of(pair);
    place(pair.a);
    place(pair.b);
    const Contact<Dim> contact = detector.facing_contact(pair.a, pair.b, pair.memory, reach_);
    if (contact.touch != Touch::none)
      touches(pair, contact);
    else if (pair.contact >= 0)
      parts(pair);
  };
  const auto ask_if_due = [&](Pair& pair) {
    if (!is_shared(pair) && is_due(bodies, pair)) ask(pair);
  };
  if (moved == nullptr)
    for (Pair& pair : pairs_) ask_if_due(pair);
  else
    for (const std::uint32_t k : pairs_of(*moved)) ask_if_due(pairs_[k]);
  for (std::size_t k = 0; k < shared_.size();) {
    std::size_t end = k;
    bool due = false;
    for (; end < shared_.size() && bodies_of(shared_[end]) == bodies_of(shared_[k]); ++end)
      due = due || is_due(bodies, pairs_[shared_[end]]);
    for (; k < end; ++k)
      if (due) ask(pairs_[shared_[k]]);
  }
}

template <int Dim, class Detector>
std::vector<std::uint32_t> ContactTracker<Dim, Detector>::pairs_of(
    const std::vector<std::uint32_t>& bodies) {
  if (first_pair_.size() != path_.size() + 1) list_pairs();
  std::vector<std::uint32_t> found;
  for (const std::uint32_t b : bodies)
    found.insert(found.end(), pairs_of_body_.begin() + first_pair_[b],
                 pairs_of_body_.begin() + first_pair_[b + 1]);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

template <int Dim, class Detector>
void ContactTracker<Dim, Detector>::list_pairs() {
  first_pair_.assign(path_.size() + 1, 0);
  for (const Pair& pair : pairs_)
    for (const std::uint32_t shape : {pair.a, pair.b}) ++first_pair_[index(body_of_[shape]) + 1];
  for (std::size_t b = 0; b < path_.size(); ++b) first_pair_[b + 1] += first_pair_[b];
  std::vector<std::ptrdiff_t> next(first_pair_.begin(), first_pair_.end() - 1);
  pairs_of_body_.resize(2 * pairs_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    for (const std::uint32_t shape : {pairs_[k].a, pairs_[k].b})
      pairs_of_body_[static_cast<std::size_t>(next[index(body_of_[shape])]++)] =
          static_cast<std::uint32_t>(k);
}

template <int Dim, class Detector>
void ContactTracker<Dim, Detector>::follow(const Bodies& bodies,
                                           const std::vector<std::uint32_t>* moved) {
  if (seen_.size() < bodies.size()) since_looked_ = std::numeric_limits<double>::infinity();
  for (std::size_t b = seen_.size(); b < bodies.size(); ++b) seen_.push_back(bodies[b].pose);
  path_.resize(bodies.size(), 0);
  placed_.resize(shapes_.size(), -1);
  double farthest = 0;
  const auto follow_one = [&](std::size_t b) {
    const auto& body = bodies[b];
    const double shift = (body.pose.position - seen_[b].position).norm();
    const double turn = (body.pose.rotation - seen_[b].rotation).norm();  // > the angle
    const double path = shift + turn * body.radius;
    if (path == 0) return;
    path_[b] += path;
    farthest = std::max(farthest, path);
    seen_[b] = body.pose;
  };
  if (moved == nullptr)
    for (std::size_t b = 0; b < bodies.size(); ++b) follow_one(b);
  else
    for (const std::uint32_t b : *moved) follow_one(b);
  since_looked_ += farthest;
}

template <int Dim, class Detector>
void ContactTracker<Dim, Detector>::carry_over(const Bodies& bodies, const Parts& parts) {
  const auto before = [](const auto& x, const auto& y) {
    return std::minmax(x.a, x.b) < std::minmax(y.a, y.b);
  };
  std::vector<Pair> kept;
  kept.reserve(neighbours_.pairs().size());
  auto old = pairs_.begin();
  const auto leave_behind = [&] {
    if (old->contact >= 0) parts(*old);
    ++old;
  };
  for (const auto& pair : neighbours_.pairs()) {
    const auto a = index(body_of_[pair.a]), b = index(body_of_[pair.b]);
    if (!may_touch(pair.a, pair.b)) continue;
    if (!(bodies[a].movable() || bodies[b].movable())) continue;
    while (old != pairs_.end() && before(*old, pair)) leave_behind();
    if (old != pairs_.end() && old->a == pair.a && old->b == pair.b)
      kept.push_back(*old++);
    else
      kept.push_back({pair.a, pair.b});
  }
  while (old != pairs_.end()) leave_behind();
  pairs_.swap(kept);
  first_pair_.clear();
  shared_.clear();
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (is_shared(pairs_[k])) shared_.push_back(k);
  std::stable_sort(shared_.begin(), shared_.end(),
                   [this](std::size_t x, std::size_t y) { return bodies_of(x) < bodies_of(y); });
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class ContactTracker<2>;
VOUSSOIR_SPATIAL_TEMPLATE class ContactTracker<3>;
#endif

}  // namespace voussoir
