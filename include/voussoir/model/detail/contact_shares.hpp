// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/geometry/contact_area.hpp>
#include <voussoir/model/contact_tracker.hpp>

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
/// contact on the faces of one cut, as in the rock that has not moved (`visit_joined`).
template <int Dim>
class ContactShares {
 public:
  using Tracker = ContactTracker<Dim>;
  using Pair = typename Tracker::Pair;

  /// @param tracker  that finds the pairs; it outlives this
  explicit ContactShares(const Tracker& tracker) : tracker_(tracker) {}

  /// @param cut  label of the faces that touch; -1: not those of one cut, a contact by itself
  void add(const Pair& pair, const Contact<Dim>& found, int cut) {
    shares_.push_back({pair, found, {found.polygon.begin(), found.polygon.end()}, {}, cut});
    shares_.back().bodies = std::minmax(tracker_.body_of(pair.a), tracker_.body_of(pair.b));
  }

  /// Calls visit(pair, found, area) for every contact. Where several pairs share it, `area` is what
  /// all have of it, on the polygon's side, counted as it is from the grid point of the pair's
  /// first shape and with the measure of all, and else null.
  template <class Visit>
  void join(Visit&& visit) {
    // The largest of a contact tells its plane: it comes first.
    std::sort(shares_.begin(), shares_.end(), [](const Share& x, const Share& y) {
      return std::tuple(x.bodies, x.cut, -x.found.measure) <
             std::tuple(y.bodies, y.cut, -y.found.measure);
    });
    for (Share& share : shares_) share.found.polygon = share.polygon;
    for (std::size_t k = 0; k < shares_.size();) {
      std::size_t end = k + 1;
      while (end < shares_.size() && shares_[end].bodies == shares_[k].bodies &&
             shares_[end].cut == shares_[k].cut)
        ++end;
      Share& first = shares_[k];
      const Vec<Dim> normal = first.outward();
      ContactArea<Dim> area;
      for (std::size_t i = k; i < end; ++i) {
        const Share& share = shares_[i];
        const bool same_face = owner(share) == owner(first);
        const Vec<Dim> outward = same_face ? share.outward() : Vec<Dim>(-share.outward());
        std::vector<Vec<Dim>> corners = same_face ? share.polygon : on_face(share);
        const Vec<Dim> shift = origin(share) - origin(first);
        for (Vec<Dim>& p : corners) p += shift;
        auto facet = facet_of(std::move(corners), normal);
        // Less than what is seen of it along the normal: roundings are all there is of it.
        const bool is_sliver = !(facet.measure() > 0.999 * share.found.measure);
        if (share.cut >= 0 && normal.dot(outward) > 0.99 && !is_sliver &&
            (i == k || !area.facets().empty())) {
          area.add(std::move(facet));
          if (i != k) first.found.measure += share.found.measure;
        } else if (i != k) {
          visit(share.pair, share.found, static_cast<const ContactArea<Dim>*>(nullptr));
        }
      }
      visit(first.pair, first.found, area.facets().size() > 1 ? &area : nullptr);
      k = end;
    }
  }

 private:
  struct Share {
    Pair pair;
    Contact<Dim> found;
    std::vector<Vec<Dim>> polygon;
    std::pair<int, int> bodies;  ///< the lower first
    int cut;

    [[nodiscard]] std::size_t owner() const {
      return found.touch != Touch::face_b ? pair.a : pair.b;
    }
    /// Out of the face that is touched.
    [[nodiscard]] Vec<Dim> outward() const {
      return found.touch != Touch::face_b ? found.normal : Vec<Dim>(-found.normal);
    }
  };

  /// What the polygon is counted from.
  [[nodiscard]] const Vec<Dim>& origin(const Share& share) const {
    return tracker_.shapes().grid_point(share.pair.a);
  }

  /// The body whose face is touched.
  [[nodiscard]] int owner(const Share& share) const { return tracker_.body_of(share.owner()); }

  /// The polygon, which lies on what touches the face, moved along its normal onto the face.
  [[nodiscard]] std::vector<Vec<Dim>> on_face(const Share& share) const {
    const PlacedShape<Dim>& shape = tracker_.shapes()[share.owner()];
    const Vec<Dim> normal = share.outward();
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

}  // namespace voussoir::detail
