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
#include <voussoir/geometry/tangent_basis.hpp>
#include <voussoir/model/contact_points.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir::detail {

/// Makes the springs of a contact from what the detector has found, with the history of the contact
/// as it was before.
///
/// Carried over, point by point from the nearest old one: the in-situ stress, the slip and the
/// memory of the law. Where the normal has turned by more than 60 degrees since, it is another
/// contact and begins without history.
template <int Dim, class State>
class ContactRenewal {
 public:
  using Contact = MovingContact<Dim>;
  using Point = MovingContactPoint<Dim, State>;
  using Bodies = std::vector<MovingBody<Dim>>;

  /// @param old_points  of the contacts before
  ContactRenewal(const Bodies& bodies, const std::vector<Point>& old_points)
      : bodies_(bodies), old_points_(old_points) {}

  /// @param found   how the shapes touch; `owner`, whose face it is, belongs to body a
  /// @param old     the contact as it was, or null
  /// @param points  its springs are written there
  /// @param joined  where they stand, if the contact consists of more than the polygon found
  [[nodiscard]] Contact run(const voussoir::Contact<Dim>& found, const PlacedShape<Dim>& owner,
                            int a, int b, ContactPoints rule, const Contact* old,
                            std::vector<Point>& points,
                            std::span<const WeightedPoint<Dim>> joined = {}) {
    const bool of_a = found.touch != Touch::face_b;
    const Vec<Dim> normal = of_a ? found.normal : Vec<Dim>(-found.normal);
    const Pose<Dim>&pose_a = pose(a), &pose_b = pose(b);
    Contact contact;
    contact.a = a;
    contact.b = b;
    Rotation<Dim> frame;
    bool keeps = false;
    if (old != nullptr) {
      const double sign = old->a == a ? 1.0 : -1.0;
      const Rotation<Dim> was = sign * (pose(old->a).rotation * old->frame);
      keeps = normal.dot(column(was, 0)) > 0.5;
      if (keeps) frame = carried(was, normal);
    }
    if (!keeps) frame << normal, tangent_basis(normal);
    contact.frame = transposed(pose_a.rotation) * frame;
    const auto at = contact.place(pose_a, pose_b);
    const double face = normal_reach(owner, normal);
    if (!joined.empty())
      places_.assign(joined.begin(), joined.end());
    else if (found.touch == Touch::edge_edge)
      place_at_edges(found, a, b);
    else
      place_points(rule, found.polygon, found.measure, places_);
    points.clear();
    for (const WeightedPoint<Dim>& it : places_) {
      if (!(it.weight > 0)) continue;
      Point point{};
      point.place = transposed(pose_b.rotation) * (it.place - pose_b.position);
      point.weight = it.weight;
      point.zero = zeros<Vec<Dim>>();
      const PointMotion<Dim> now = point.motion(at);
      // Crossing edges touch at one depth, a face is touched at the height of each point over it.
      const double opening =
          found.touch == Touch::edge_edge ? found.separation : normal.dot(it.place) - face;
      point.zero[0] = now.opening - opening;
      write_at(point.zero.data() + 1, now.slip);
      if (keeps) inherit(*old, it.place, point);
      points.push_back(point);
    }
    return contact;
  }

 private:
  [[nodiscard]] const Pose<Dim>& pose(int b) const {
    return bodies_[static_cast<std::size_t>(b)].pose;
  }
  /// normal . x of the points of the face that has this normal [m].
  [[nodiscard]] static double normal_reach(const PlacedShape<Dim>& shape, const Vec<Dim>& normal) {
    double reach = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < shape.vertex_count; ++k)
      reach = std::max(reach, normal.dot(shape.vertex(k)));
    return reach;
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

  void inherit(const Contact& old, const Vec<Dim>& place, Point& point) const {
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
    const auto at = old.place(pose(old.a), pose(old.b));
    // Bodies a and b may have changed places, and with them all axes their sign: slip, opening and
    // the force on b along the axes of the contact are the same either way.
    add_at<Dim - 1>(point.zero.data() + 1, -nearest->motion(at).slip);
    const double share = point.weight / nearest->weight;
    point.initial.normal = share * nearest->initial.normal;
    point.initial.tangential = share * nearest->initial.tangential;
    point.state = nearest->state;
  }

  const Bodies& bodies_;
  const std::vector<Point>& old_points_;
  std::vector<WeightedPoint<Dim>> places_;
};

}  // namespace voussoir::detail
