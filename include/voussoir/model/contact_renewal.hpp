// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/geometry/contact_area.hpp>
#include <voussoir/geometry/tangent_basis.hpp>
#include <voussoir/model/detail/facing_normal.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir::detail {

/// Makes the springs of a contact from what the detector has found, with the history of the contact
/// as it was before.
///
/// Where an old point was within its share of the area the new one carries it on; elsewhere the
/// contact is new, but for what is closed inside the old area. Carried over, point by
/// point from the nearest old one: the slip, the memory of the law and the in-situ stress. The
/// stress changes from there by the gradient that it has over the old points, so that its force and
/// moment are kept, however many the points are, as long as their area is. Where the normal has
/// turned by more than 60 degrees since, it is another contact and begins without history.
///
/// The weights of its points are their shares of the whole of the faces that lie over one another,
/// whatever the depth: which part of them is pressed follows from the motion (`PressedPart`). Faces
/// that are all open by more than the reach make no contact: what closes between two updates is
/// within reach at the first of them. Nor does an area that is none but for rounding.
template <int Dim>
class ContactRenewal {
 public:
  using Contact = MovingContact<Dim>;
  using Point = MovingContactPoint<Dim, FormerPoint>;
  using Bodies = std::vector<MovingBody<Dim>>;

  /// @param old_points  of the contacts before
  /// @param has_fibres  points are spread over all of the contact; 2-D
  ContactRenewal(const Bodies& bodies, const std::vector<Point>& old_points,
                 bool has_fibres = false)
      : bodies_(bodies), old_points_(old_points), has_fibres_(has_fibres) {}

  /// @param found   how the shapes touch, points counted from `from`; `owner`, whose face it is,
  /// belongs to body a
  /// @param reach   points may be so far open [m]
  /// @param old     the contact as it was, or null
  /// @param slips   of its points now, as the law has them [m]
  /// @param points  its springs are written there
  /// @param is_centred  it has one point in the middle and resists no turning: see `MovingContact`
  /// @param joined  all that several pairs of shapes have of the contact, counted from `from`, with
  /// their measure in `found`; null: the polygon found
  [[nodiscard]] Contact run(const voussoir::Contact<Dim>& found, const Vec<Dim>& from,
                            const PlacedShapes<Dim>& shapes, std::size_t owner, int a, int b,
                            bool is_centred, double reach, const Contact* old,
                            const std::vector<Vec<Dim - 1>>& slips, std::vector<Point>& points,
                            const ContactArea<Dim>* joined = nullptr) {
    const bool of_a = found.touch != Touch::face_b;
    Vec<Dim> normal = of_a ? found.normal : Vec<Dim>(-found.normal);
    // Between faces that are hardly tilted two edges may decide the depth: their normal is off that
    // of the face, over which the heights of points are measured, by about the tilt.
    if (found.touch != Touch::edge_edge) normal = facing_normal(shapes[owner], normal);
    from_ = from;
    const Pose<Dim> pose_a = pose(a), pose_b = pose(b);
    Contact contact;
    contact.a = a;
    contact.b = b;
    Rotation<Dim> frame;
    bool& keeps = keeps_history_ = false;
    if (old != nullptr) {
      const double sign = old->a == a ? 1.0 : -1.0;
      const Rotation<Dim> was = sign * (pose(old->a).rotation * old->frame);
      keeps = normal.dot(column(was, 0)) > 0.5;
      if (keeps) frame = carried(was, normal);
    }
    if (!keeps) frame << normal, tangent_basis(normal);
    contact.frame = transposed(pose_a.rotation) * frame;
    const auto at = contact.place(pose_a, pose_b);
    const double face =
        normal_reach(shapes[owner], normal) + normal.dot(shapes.grid_point(owner) - from);
    if (joined != nullptr) {
      place_on(*joined, is_centred, found.measure);
      set_outline(*joined, contact);
    } else if (found.touch == Touch::edge_edge) {
      place_at_edges(found, a, b);
    } else {
      const auto facet = facet_of(found.polygon);
      place_on(facet, is_centred, found.measure);
      set_outline(facet, contact);
    }
    if (keeps) find_gradient(*old, frame);
    meet_at(found, joined, normal, reach, pose_b.position);
    points.clear();
    if (found.touch != Touch::edge_edge &&
        (is_rounding(found.measure, a, b) ||
         lowest_of(found.polygon, joined, normal) - face > reach))
      return contact;
    for (const WeightedPoint& it : places_) {
      if (!(it.weight > 0)) continue;
      Point point{};
      point.place = transposed(pose_b.rotation) * (it.place - pose_b.position);
      point.weight = it.weight;
      point.zero = zeros<Vec<Dim>>();
      const PointMotion<Dim> now = point.motion(at);
      // Crossing edges touch at one depth, a face is touched at the height of each point over it.
      const double opening =
          found.touch == Touch::edge_edge ? found.separation : normal.dot(it.place) - face;
      const bool is_old = keeps && carries_on(*old, it.place, normal);
      point.zero[0] = now.opening - opening;
      write_at(point.zero.data() + 1, now.slip);
      if (is_old || (keeps && is_in_old_area(it.place)))
        inherit(*old, frame, it.place, slips, point);
      points.push_back(point);
    }
    return contact;
  }

  /// Where the bodies of the last contact meet, from the centre of body b, world axes: in the
  /// middle of faces that come down flat, else at the corner or edge that is lowest [m].
  [[nodiscard]] const Vec<Dim>& meeting_place() const { return meeting_place_; }
  /// Whether the last contact has taken over what the old one remembered.
  [[nodiscard]] bool keeps_history() const { return keeps_history_; }

 private:
  using InPlane = Vec<Dim - 1>;

  /// A place on a contact and the length or area that it stands for.
  struct WeightedPoint {
    Vec<Dim> place;  ///< [m]
    double weight;   ///< [m], [m^2]
  };

  /// Of a body, counted from where the points of the contact are.
  [[nodiscard]] Pose<Dim> pose(int b) const {
    Pose<Dim> near = bodies_[static_cast<std::size_t>(b)].pose;
    near.position -= from_;
    return near;
  }
  /// Whether a length or area is none: all that there is of it is rounding, as where faces meet
  /// along an edge. Stresses are forces over it, and may then be anything.
  [[nodiscard]] bool is_rounding(double measure, int a, int b) const {
    constexpr double rounding = 1e-12;  // of the smaller body
    const double radius = std::min(bodies_[static_cast<std::size_t>(a)].radius,
                                   bodies_[static_cast<std::size_t>(b)].radius);
    return !(measure > rounding * (Dim == 2 ? radius : radius * radius));
  }
  /// normal . x of the points of the face that has this normal [m].
  [[nodiscard]] static double normal_reach(const PlacedShape<Dim>& shape, const Vec<Dim>& normal) {
    double reach = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < shape.vertex_count; ++k)
      reach = std::max(reach, normal.dot(shape.vertex(k)));
    return reach;
  }

  /// Calls visit(corner) for those of what is common to two faces.
  template <class Visit>
  static void each_corner(std::span<const Vec<Dim>> polygon, const ContactArea<Dim>* joined,
                          Visit&& visit) {
    if (joined == nullptr) {
      for (const Vec<Dim>& p : polygon) visit(p);
      return;
    }
    for (const auto& facet : joined->facets())
      if constexpr (Dim == 2) {
        visit(facet.start);
        visit(facet.end);
      } else {
        for (const Vec3& p : facet.vertices) visit(p);
      }
  }
  [[nodiscard]] static double lowest_of(std::span<const Vec<Dim>> polygon,
                                        const ContactArea<Dim>* joined, const Vec<Dim>& normal) {
    double low = std::numeric_limits<double>::infinity();
    each_corner(polygon, joined, [&](const Vec<Dim>& p) { low = std::min(low, normal.dot(p)); });
    return low;
  }
  /// Corners count the less the higher they are over the lowest, up to the reach.
  void meet_at(const voussoir::Contact<Dim>& found, const ContactArea<Dim>* joined,
               const Vec<Dim>& normal, double reach, const Vec<Dim>& centre_b) {
    const double low = lowest_of(found.polygon, joined, normal);
    const bool is_edge = found.touch == Touch::edge_edge;
    meeting_place_ = zeros<Vec<Dim>>();
    double sum = 0;
    each_corner(found.polygon, joined, [&](const Vec<Dim>& p) {
      const double height = normal.dot(p) - low;
      const double share =
          is_edge || !std::isfinite(reach) ? 1.0 : std::max(0.0, 1 - height / reach);
      meeting_place_ += share * p;
      sum += share;
    });
    meeting_place_ = meeting_place_ / sum - centre_b;
  }

  /// Whether a point stands where an old one did: seen along the normal, as near to it as its share
  /// of the area is long.
  [[nodiscard]] bool carries_on(const Contact& old, const Vec<Dim>& place,
                                const Vec<Dim>& normal) const {
    for (auto i = static_cast<std::size_t>(old.first); i < static_cast<std::size_t>(old.last);
         ++i) {
      Vec<Dim> way = pose(old.b)(old_points_[i].place) - place;
      way -= normal.dot(way) * normal;
      const double weight = old_points_[i].weight;
      if (way.squaredNorm() <= (Dim == 2 ? weight * weight : weight)) return true;
    }
    return false;
  }

  /// Whether a point lies in the old area, which in 3-D may be slender: inside the ellipse of the
  /// same moments that goes through the corners if the area is a triangle, and around them if it is
  /// a parallelogram.
  [[nodiscard]] bool is_in_old_area(const Vec<Dim>& place) const {
    const InPlane arm = part<Dim - 1>(transposed_product(frame_, place), 1) - middle_;
    const double distance = arm.dot(inverse_spread_ * arm);
    return distance > 0 && distance <= 8 * (1 + 1e-6);
  }

  [[nodiscard]] static auto facet_of(std::span<const Vec<Dim>> polygon) {
    if constexpr (Dim == 2)
      return Segment{polygon[0], polygon[1]};
    else
      return SpatialFacet{{polygon.begin(), polygon.end()}};
  }

  /// @param measure  of the area as it is seen along the normal
  template <class Area>
  void place_on(const Area& area, bool is_centred, double measure) {
    places_.clear();
    const Vec<Dim> centre = area.centre();
    // At most 1, unless rounding is all there is of the area.
    const double scale = measure / area.measure();
    if (is_centred || !(scale < 1.001)) {
      places_.push_back({centre, measure});
      return;
    }
    if constexpr (Dim == 2)
      if (has_fibres_) {
        place_fibres(area, scale);
        return;
      }
    for (const FacetPoint<Dim>& p : area.gauss_points())
      places_.push_back({centre + p.offset, scale * p.weight});
  }
  void place_fibres(const Segment& facet, double scale) requires(Dim == 2) {
    for (const FacetPoint<2>& p : facet.lobatto_points())
      places_.push_back({facet.centre() + p.offset, scale * p.weight});
  }
  void place_fibres(const ContactArea<2>& area, double scale) requires(Dim == 2) {
    for (const Segment& facet : area.facets()) place_fibres(facet, scale);
  }

  template <class Area>
  void set_outline([[maybe_unused]] const Area& area, [[maybe_unused]] Contact& contact) const {
    if constexpr (Dim == 3) {
      const Vec<3> centre = area.centre();
      std::vector<FacetPoint<3>> points;
      for (const WeightedPoint& p : places_) points.push_back({p.place - centre, p.weight});
      contact.outline = kept_outline(area, centre, points.data(), points.size());
    }
  }

  void place_at_edges(const voussoir::Contact<Dim>& found, int a, int b) {
    // The section of the overlap would be a spring that grows with the depth. A corner's share of a
    // face as large as the blocks is taken instead.
    Vec<Dim> middle = zeros<Vec<Dim>>();
    for (const Vec<Dim>& p : found.polygon) middle += p;
    places_ = {{middle / static_cast<double>(found.polygon.size()),
                bodies_[static_cast<std::size_t>(a)].radius *
                    bodies_[static_cast<std::size_t>(b)].radius / 16}};
  }

  /// The old frame turned the shortest way so that its first column is the new normal.
  [[nodiscard]] static Rotation<Dim> carried(const Rotation<Dim>& old, const Vec<Dim>& normal) {
    Rotation<Dim> frame;
    set_column(frame, 0, normal);
    for (int k = 1; k < Dim; ++k) {
      Vec<Dim> t = column(old, k);
      for (int l = 0; l < k; ++l) t -= t.dot(column(frame, l)) * column(frame, l);
      set_column(frame, k, t.normalized());
    }
    return frame;
  }

  /// The initial stress of an old point: normal and shears [Pa].
  [[nodiscard]] static Vec<Dim> stress_of(const Point& p) {
    return stacked(p.initial.normal, p.initial.tangential) / p.weight;
  }

  /// The gradient of the initial stress in the plane of the contact: least squares over the old
  /// points by their weights. None along a direction in which they do not spread.
  void find_gradient(const Contact& old, const Rotation<Dim>& frame) {
    gradient_ = zeros<Fixed<Dim, Dim - 1>>();
    inverse_spread_ = zeros<Fixed<Dim - 1, Dim - 1>>();
    frame_ = frame;
    const auto first = static_cast<std::size_t>(old.first),
               last = static_cast<std::size_t>(old.last);
    const auto in_plane = [&](const Point& p) {
      return part<Dim - 1>(transposed_product(frame, pose(old.b)(p.place)), 1);
    };
    double weight = 0;
    Vec<Dim> stress = zeros<Vec<Dim>>();
    InPlane middle = zeros<InPlane>();
    for (auto i = first; i < last; ++i) {
      const Point& p = old_points_[i];
      weight += p.weight;
      stress += p.weight * stress_of(p);
      middle += p.weight * in_plane(p);
    }
    squared_extent_ = Dim == 2 ? weight * weight : weight;
    if (!(weight > 0)) return;
    stress /= weight;
    middle /= weight;
    middle_ = middle;
    Fixed<Dim, Dim - 1> mixed = zeros<Fixed<Dim, Dim - 1>>();
    Fixed<Dim - 1, Dim - 1> spread = zeros<Fixed<Dim - 1, Dim - 1>>();
    for (auto i = first; i < last; ++i) {
      const Point& p = old_points_[i];
      const InPlane arm = in_plane(p) - middle;
      mixed += p.weight * (stress_of(p) - stress) * transposed(arm);
      spread += p.weight * arm * transposed(arm);
    }
    if constexpr (Dim == 2) {
      if (spread(0, 0) > 1e-12 * weight * weight * weight) gradient_ = mixed / spread(0, 0);
    } else {
      const double determinant = spread(0, 0) * spread(1, 1) - spread(0, 1) * spread(1, 0),
                   trace = spread(0, 0) + spread(1, 1);
      if (!(determinant > 1e-8 * trace * trace)) return;
      Fixed<2, 2> inverse;
      inverse(0, 0) = spread(1, 1) / determinant;
      inverse(1, 1) = spread(0, 0) / determinant;
      inverse(0, 1) = -spread(0, 1) / determinant;
      inverse(1, 0) = -spread(1, 0) / determinant;
      gradient_ = mixed * inverse;
      inverse_spread_ = weight * inverse;
      squared_extent_ = std::max(weight, 8 * trace / weight);
    }
  }

  void inherit(const Contact& old, const Rotation<Dim>& frame, const Vec<Dim>& place,
               const std::vector<Vec<Dim - 1>>& slips, Point& point) const {
    const Point* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (auto i = static_cast<std::size_t>(old.first); i < static_cast<std::size_t>(old.last);
         ++i) {
      const double distance = (pose(old.b)(old_points_[i].place) - place).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = &old_points_[i];
      }
    }
    if (nearest == nullptr) return;
    // Bodies a and b may have changed places, and with them all axes their sign: slip, opening and
    // the force on b along the axes of the contact are the same either way.
    const Vec<Dim - 1>& slip =
        slips[static_cast<std::size_t>(nearest - old_points_.data() - old.first)];
    add_at<Dim - 1>(point.zero.data() + 1, -slip);
    point.committed.commit(slip);
    Vec<Dim> stress = stress_of(*nearest);
    // No farther than the old contact was long: far outside, a gradient makes any stress.
    const Vec<Dim> way = place - pose(old.b)(nearest->place);
    const InPlane step = part<Dim - 1>(transposed_product(frame, way), 1);
    if (step.squaredNorm() <= squared_extent_) stress += gradient_ * step;
    point.initial.normal = point.weight * stress[0];
    point.initial.tangential = point.weight * part<Dim - 1>(stress, 1);
    point.state = nearest->state;
  }

  const Bodies& bodies_;
  const std::vector<Point>& old_points_;
  bool has_fibres_;
  std::vector<WeightedPoint> places_;
  Vec<Dim> from_ = zeros<Vec<Dim>>();
  Fixed<Dim, Dim - 1> gradient_ = zeros<Fixed<Dim, Dim - 1>>();  ///< of the initial stress [Pa/m]
  double squared_extent_ = 0;                                    ///< of the old contact [m^2]
  Rotation<Dim> frame_ = diagonal_of<Dim>(1);                    ///< of the contact
  InPlane middle_ = zeros<InPlane>();                            ///< of the old points, there [m]
  Vec<Dim> meeting_place_ = zeros<Vec<Dim>>();
  /// Of the area's second moments over the area [1/m^2]; zero where they are not known: in 2-D.
  Fixed<Dim - 1, Dim - 1> inverse_spread_ = zeros<Fixed<Dim - 1, Dim - 1>>();
  bool keeps_history_ = false;
};

}  // namespace voussoir::detail
