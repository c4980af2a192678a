// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/contact_facet.hpp>
#include <voussoir/geometry/detail/remove_dents.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/detail/faces_by_cut.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// The faces on the two sides of one cut, laid over each other in its plane.
///
/// Both sides tile the cut with convex polygons. A sweep along one axis of the plane finds the
/// pairs whose bounding boxes overlap, each pair is clipped; for n faces of similar size that is
/// about n^1.5 box tests and n clips. Keeps its working memory.
class CutOverlay {
 public:
  /// @param first, last  all faces of the cut
  /// @param tolerance    a contact narrower than this is none [m]
  void match(const RockMass<Spatial>& mass, const FaceRef* first, const FaceRef* last,
             double tolerance, std::vector<ContactFacet<Spatial>>& contacts) {
    collect(mass, first, last);
    const auto by_start = [](const FlatFace& x, const FlatFace& y) {
      return x.low.x() < y.low.x();
    };
    std::sort(below_.begin(), below_.end(), by_start);
    std::sort(above_.begin(), above_.end(), by_start);
    open_below_.clear();
    open_above_.clear();
    for (std::size_t i = 0, j = 0; i < below_.size() || j < above_.size();) {
      const bool next_is_below =
          j == above_.size() || (i < below_.size() && below_[i].low.x() <= above_[j].low.x());
      const FlatFace& next = next_is_below ? below_[i++] : above_[j++];
      std::vector<const FlatFace*>& others = next_is_below ? open_above_ : open_below_;
      std::erase_if(others, [&](const FlatFace* f) { return f->high.x() <= next.low.x(); });
      for (const FlatFace* other : others) {
        if (other->body == next.body || other->high.y() <= next.low.y() ||
            other->low.y() >= next.high.y())
          continue;
        const FlatFace& under = next_is_below ? next : *other;
        const FlatFace& over = next_is_below ? *other : next;
        SpatialFacet facet = common_part(under, over, tolerance);
        if (!facet.vertices.empty()) contacts.push_back({under.body, over.body, std::move(facet)});
      }
      (next_is_below ? open_below_ : open_above_).push_back(&next);
    }
  }

 private:
  struct Corner {
    Vec2 flat;   ///< in the plane of the cut, relative to one of its corners [m]
    Vec3 point;  ///< [m]
  };
  /// A face with its corners anticlockwise seen from above the cut.
  struct FlatFace {
    Vec2 low, high;  ///< bounding box
    int body;
    std::size_t begin, end;  ///< in `corners_`
  };

  void collect(const RockMass<Spatial>& mass, const FaceRef* first, const FaceRef* last) {
    const auto shape_of = [&mass](const FaceRef& f) -> const ConvexPolyhedron& {
      return mass.bodies[static_cast<std::size_t>(f.body)].parts[static_cast<std::size_t>(f.part)];
    };
    const auto face_of = [](const FaceRef& f) { return static_cast<std::size_t>(f.face); };
    corners_.clear();
    below_.clear();
    above_.clear();
    // Upwards is out of the blocks below. Every face of a cut keeps its plane, to the sign.
    const Vec3 up = shape_of(*first).half_space(face_of(*first)).normal;
    const Vec3 origin = shape_of(*first).vertex(0);
    const Fixed<3, 2> axes = tangent_basis(up);
    for (const FaceRef* f = first; f != last; ++f) {
      const ConvexPolyhedron& shape = shape_of(*f);
      const bool is_below = dot_product(shape.half_space(face_of(*f)).normal, up) > 0;
      FlatFace face{zeros<Vec2>(), zeros<Vec2>(), f->body, corners_.size(), 0};
      for (const int v : shape.loop(face_of(*f))) {
        const Vec3& point = shape.vertex(static_cast<std::size_t>(v));
        const Vec2 flat = transposed_product(axes, point - origin);
        const bool is_first = corners_.size() == face.begin;
        face.low = is_first ? flat : smaller_of(face.low, flat);
        face.high = is_first ? flat : larger_of(face.high, flat);
        corners_.push_back({flat, point});
      }
      if (!is_below)
        std::reverse(corners_.begin() + static_cast<std::ptrdiff_t>(face.begin), corners_.end());
      remove_dents(corners_, face.begin, [](const Corner& a, const Corner& b, const Corner& c) {
        return cross(b.flat - a.flat, c.flat - b.flat) < 0;
      });
      face.end = corners_.size();
      (is_below ? below_ : above_).push_back(face);
    }
  }

  [[nodiscard]] std::span<const Corner> corners(const FlatFace& face) const {
    return {corners_.data() + face.begin, face.end - face.begin};
  }

  /// The part of one face that lies over another, empty if narrower than the tolerance.
  ///
  /// Clipping knows no tolerance: what roundings leave of faces that only share an edge is far
  /// narrower than one. Corners that are those of either face are taken as they are, bit for bit.
  ///
  /// Source: Sutherland & Hodgman (1974), Reentrant polygon clipping.
  [[nodiscard]] SpatialFacet common_part(const FlatFace& under, const FlatFace& over,
                                         double tolerance) {
    const std::span<const Corner> clip = corners(over);
    inside_.assign(corners(under).begin(), corners(under).end());
    for (std::size_t k = 0; k < clip.size(); ++k) {
      const Vec2& start = clip[k].flat;
      const Vec2 along = clip[k + 1 == clip.size() ? 0 : k + 1].flat - start;
      kept_.clear();
      const Corner* from = &inside_.back();
      double here = cross(along, from->flat - start);
      for (const Corner& to : inside_) {
        const double there = cross(along, to.flat - start);
        if ((here < 0) != (there < 0)) {
          const double t = here / (here - there);
          kept_.push_back({from->flat + t * (to.flat - from->flat),
                           from->point + t * (to.point - from->point)});
        }
        if (there >= 0) kept_.push_back(to);
        from = &to;
        here = there;
      }
      inside_.swap(kept_);
      if (inside_.size() < 3) return {};
    }
    double doubled = 0, outline = 0;
    for (std::size_t k = 0; k < inside_.size(); ++k) {
      const Vec2 here = inside_[k].flat - inside_[0].flat;
      const Vec2 next = inside_[k + 1 == inside_.size() ? 0 : k + 1].flat - inside_[0].flat;
      doubled += cross(here, next);
      outline += length_of(next - here);
    }
    // A strip of width w and length l has the area w l and the outline 2 l.
    if (!(doubled > tolerance * outline)) return {};
    SpatialFacet facet;
    facet.vertices.reserve(inside_.size());
    for (Corner& corner : inside_) {
      for (const FlatFace* face : {&under, &over})
        for (const Corner& given : corners(*face))
          if (squared_length_of(corner.flat - given.flat) <= tolerance * tolerance)
            corner.point = given.point;
      if (facet.vertices.empty() || !(facet.vertices.back() == corner.point))
        facet.vertices.push_back(corner.point);
    }
    if (facet.vertices.front() == facet.vertices.back()) facet.vertices.pop_back();
    return facet;
  }

  std::vector<Corner> corners_, inside_, kept_;
  std::vector<FlatFace> below_, above_;
  std::vector<const FlatFace*> open_below_, open_above_;
};

inline void match_cut(const RockMass<Spatial>& mass, const FaceRef* first, const FaceRef* last,
                      double tolerance, std::vector<ContactFacet<Spatial>>& contacts) {
  thread_local CutOverlay overlay;
  overlay.match(mass, first, last, tolerance, contacts);
}

}  // namespace voussoir::detail
