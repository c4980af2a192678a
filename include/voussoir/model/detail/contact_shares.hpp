// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/geometry/contact_area.hpp>
#include <voussoir/model/contact_tracker.hpp>
#include <voussoir/model/detail/facing_normal.hpp>

namespace voussoir::detail {

/// A facet whose area vector looks along a normal.
[[nodiscard]] inline Segment facet_of(const std::vector<Vec2>& ends, const Vec2& normal) {
  const Segment facet{ends[0], ends[1]};
  return dot_product(facet.area_vector(), normal) < 0 ? Segment{ends[1], ends[0]} : facet;
}
[[nodiscard]] inline SpatialFacet facet_of(std::vector<Vec3> corners, const Vec3& normal) {
  SpatialFacet facet{std::move(corners)};
  if (dot_product(facet.area_vector(), normal) < 0)
    std::reverse(facet.vertices.begin(), facet.vertices.end());
  return facet;
}

/// What pairs of shapes have of the contacts between bodies of several parts: two bodies make one
/// contact on the faces of one cut, as in the rock that has not moved (`visit_joined`). An edge of
/// a part that lies in the plane of such faces is no edge of the body, and makes none.
template <int Dim, class Tracker>
class ContactShares {
 public:
  using Pair = typename Tracker::Pair;
  using Visit = std::function<void(Pair&, const Contact<Dim>&, const ContactArea<Dim>*)>;

  /// @param tracker  that finds the pairs; it outlives this
  explicit ContactShares(const Tracker& tracker) : tracker_(tracker) {}

  /// @param pair  keeps its place until `join`
  /// @param cut   label of the faces that touch; -1: not those of one cut, a contact by itself
  void add(Pair& pair, const Contact<Dim>& found, int cut) {
    const bool is_edge = found.touch == Touch::edge_edge;
    const bool of_a = found.touch != Touch::face_b;
    const Vec<Dim> outward = of_a ? found.normal : Vec<Dim>(-found.normal);
    shares_.push_back(
        {&pair,
         found,
         {found.polygon.begin(), found.polygon.end()},
         is_edge ? outward : facing_normal(tracker_.shapes()[of_a ? pair.a : pair.b], outward),
         std::minmax(tracker_.body_of(pair.a), tracker_.body_of(pair.b)),
         is_edge,
         is_edge ? -1 : cut});
  }

  /// Calls take(pair, found, area) for all contacts of two bodies, then visit(pair, found, area):
  /// the largest first, which so is the first to find what it was before; edges last. Where several
  /// pairs share it, `area` is what all have of it, on the polygon's side, counted as it is from
  /// the grid point of the pair's first shape and with the measure of all, and else null.
  void join(const Visit& take, const Visit& visit);

 private:
  struct Share {
    Pair* pair;
    Contact<Dim> found;
    std::vector<Vec<Dim>> polygon;
    Vec<Dim> outward;            ///< of the face that is touched
    std::pair<int, int> bodies;  ///< the lower first
    bool is_edge;
    int cut;

    [[nodiscard]] std::size_t owner() const {
      return found.touch != Touch::face_b ? pair->a : pair->b;
    }
  };

  struct Joined {
    const Share* share;
    ContactArea<Dim> area;
  };

  /// Whether an edge lies in the plane of a face over which the same bodies touch.
  [[nodiscard]] bool lies_in_a_face(std::size_t edge) const {
    const Share& it = shares_[edge];
    for (std::size_t k = edge; k-- > 0 && shares_[k].bodies == it.bodies;) {
      const Share& face = shares_[k];
      if (face.is_edge) continue;
      const Vec<Dim> apart =
          it.polygon.front() - face.polygon.front() + (origin(it) - origin(face));
      if (std::abs(face.outward.dot(apart)) <= tracker_.reach()) return true;
    }
    return false;
  }

  /// What the polygon is counted from.
  [[nodiscard]] const Vec<Dim>& origin(const Share& share) const {
    return tracker_.shapes().grid_point(share.pair->a);
  }

  /// The body whose face is touched.
  [[nodiscard]] int owner(const Share& share) const { return tracker_.body_of(share.owner()); }

  /// The polygon, which lies on what touches the face, moved along its normal onto the face.
  [[nodiscard]] std::vector<Vec<Dim>> on_face(const Share& share) const {
    const PlacedShape<Dim>& shape = tracker_.shapes()[share.owner()];
    const Vec<Dim> normal = share.outward;
    double reach = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < shape.vertex_count; ++k)
      reach = std::max(reach, normal.dot(shape.vertex(k)));
    reach += normal.dot(tracker_.shapes().grid_point(share.owner()) - origin(share));
    std::vector<Vec<Dim>> moved = share.polygon;
    for (Vec<Dim>& p : moved) p += (reach - normal.dot(p)) * normal;
    return moved;
  }

  const Tracker& tracker_;
  std::vector<Share> shares_;
};

template <int Dim, class Tracker>
void ContactShares<Dim, Tracker>::join(const Visit& take, const Visit& visit) {
  // The largest of a contact tells its plane: it comes first. Edges come last.
  std::sort(shares_.begin(), shares_.end(), [](const Share& x, const Share& y) {
    return std::tuple(x.bodies, x.is_edge, x.cut, -x.found.measure, x.pair->a, x.pair->b) <
           std::tuple(y.bodies, y.is_edge, y.cut, -y.found.measure, y.pair->a, y.pair->b);
  });
  for (Share& share : shares_) share.found.polygon = share.polygon;
  std::vector<Joined> of_bodies;
  const auto hand_over = [&] {
    std::stable_sort(of_bodies.begin(), of_bodies.end(), [](const Joined& x, const Joined& y) {
      return std::pair(x.share->is_edge, -x.share->found.measure) <
             std::pair(y.share->is_edge, -y.share->found.measure);
    });
    for (const Visit* visit_all : {&take, &visit})
      for (const Joined& it : of_bodies)
        (*visit_all)(*it.share->pair, it.share->found,
                     it.area.facets().size() > 1 ? &it.area : nullptr);
    of_bodies.clear();
  };
  for (std::size_t k = 0; k < shares_.size();) {
    std::size_t end = k + 1;
    if (k > 0 && shares_[k].bodies != shares_[k - 1].bodies) hand_over();
    if (shares_[k].is_edge) {
      if (!lies_in_a_face(k)) of_bodies.push_back({&shares_[k], {}});
      k = end;
      continue;
    }
    while (end < shares_.size() && shares_[end].bodies == shares_[k].bodies &&
           !shares_[end].is_edge && shares_[end].cut == shares_[k].cut)
      ++end;
    Share& first = shares_[k];
    const Vec<Dim> normal = first.outward;
    ContactArea<Dim> area;
    for (std::size_t i = k; i < end; ++i) {
      const Share& share = shares_[i];
      const bool same_face = owner(share) == owner(first);
      const Vec<Dim> outward = same_face ? share.outward : Vec<Dim>(-share.outward);
      std::vector<Vec<Dim>> corners = same_face ? share.polygon : on_face(share);
      const Vec<Dim> shift = origin(share) - origin(first);
      for (Vec<Dim>& p : corners) p += shift;
      auto facet = facet_of(std::move(corners), normal);
      // No area, or less than what is seen of it along the normal: roundings are all there is of
      // it.
      const double seen = share.found.measure;
      const bool is_sliver = !(seen > 0 && facet.measure() > 0.999 * seen);
      if (share.cut >= 0 && normal.dot(outward) > 0.99 && !is_sliver &&
          (i == k || !area.facets().empty())) {
        area.add(std::move(facet));
        if (i != k) first.found.measure += share.found.measure;
      } else if (i != k) {
        of_bodies.push_back({&share, {}});
      }
    }
    of_bodies.push_back({&first, std::move(area)});
    k = end;
  }
  hand_over();
}

/// The label of the faces that touch if they are of one cut, else -1.
/// @param is_block  is_block(body): else it is the edge of the domain
/// @param cut_of    cut_of(shape, outward): label of the face that looks there
template <int Dim, class Tracker, class IsBlock, class CutOf>
[[nodiscard]] int common_cut(const Tracker& tracker, const typename Tracker::Pair& pair,
                             const Contact<Dim>& found, IsBlock&& is_block, CutOf&& cut_of) {
  // Both sides of a cut have its label; the edge of the domain has that of the block at it. What
  // else is within reach are faces that lie one behind the other.
  const Vec<Dim> back = -found.normal;
  if (!is_block(tracker.body_of(pair.a))) return cut_of(pair.b, back);
  const int cut = cut_of(pair.a, found.normal);
  if (!is_block(tracker.body_of(pair.b))) return cut;
  return cut == cut_of(pair.b, back) ? cut : -1;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class ContactShares<2, ContactTracker<2>>;
VOUSSOIR_SPATIAL_TEMPLATE class ContactShares<3, ContactTracker<3>>;
#endif

}  // namespace voussoir::detail
