// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/io/vtu.hpp>
#include <voussoir/model/contact_outline.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>

namespace voussoir {

/// A contact of two blocks in 3-D with the area over which they touch.
struct JointArea {
  JointState<3> state;
  std::vector<std::vector<Vec3>> polygons;  ///< several where blocks have several parts [m]
  int set = -1;                             ///< index of the joint set; -1: none
};

namespace detail {

/// The polygons of an outline in its own coordinates: its edges, loop by loop.
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::vector<Vec2>> loops_of(
    const ContactOutline& outline);

/// Which joint set two blocks have between them.
class SetsBetween {
 public:
  explicit SetsBetween(const RockMass<Spatial>& mass) : mass_(&mass) {}

  /// @param joint  in the place where the blocks were sliced, or not far from it
  /// @return  -1: none of their faces there is of a joint of a set
  [[nodiscard]] VOUSSOIR_INLINE int operator()(const JointState<3>& joint) const;

 private:
  const RockMass<Spatial>* mass_;
};

}  // namespace detail

namespace detail {

/// How far two blocks have moved apart where they touch, at most [m]; 0: nowhere.
template <class Solver>
[[nodiscard]] double moved_apart(const Solver& solver, const JointArea& joint) {
  double apart = 0;
  for (const std::vector<Vec3>& polygon : joint.polygons)
    for (const Vec3& p : polygon) {
      const Vec3 jump =
          solver.displacement_of(joint.state.b, p) - solver.displacement_of(joint.state.a, p);
      apart = std::max(apart, dot_product(joint.state.normal, jump));
    }
  return apart;
}

}  // namespace detail

/// Whether a contact was found across a gap, where blocks that moved came near each other: it is
/// open by more than they have moved apart since the rock was in situ, and is no joint.
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] bool is_across_gap(const Solver& solver, const JointArea& joint) {
  constexpr double no_gap = 1e-6;  // of joints that carry nothing [m]
  // 2: of a part of the area alone.
  return joint.state.report.is_open &&
         joint.state.report.opening > no_gap + 2 * detail::moved_apart(solver, joint);
}

/// All joints of rock with rock, in the order of `joint_states`: its contacts but for those across
/// a gap. One without a width (edges or corners that touch) has no polygon.
template <class Solver>
requires(Solver::dim == 3) [[nodiscard]] std::vector<JointArea> joint_areas(const Solver& solver) {
  std::vector<JointArea> areas;
  for (JointState<3>& state : joint_states(solver)) areas.push_back({std::move(state), {}});
  const auto& joints = solver.system().joints;
  const detail::SetsBetween set_of(solver.mass());
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const auto& contact = joints.contacts()[k];
    areas[k].set = set_of(areas[k].state);
    if (contact.outline.edges == nullptr) continue;
    // The points lie at +-sqrt(2) on the axes of the outline, see `ContactOutline`.
    const auto arm = [&](int n) {
      const auto place = joints.points().place(static_cast<std::size_t>(contact.first + n));
      return Vec3(std::sqrt(0.5) * contact.offset_of(place));
    };
    const Vec3 along = arm(0), across = arm(2);
    for (const std::vector<Vec2>& loop : detail::loops_of(*contact.outline.edges)) {
      std::vector<Vec3>& polygon = areas[k].polygons.emplace_back();
      for (const Vec2& p : loop)
        polygon.push_back(areas[k].state.centre + p.x() * along + p.y() * across);
    }
  }
  std::erase_if(areas, [&](const JointArea& joint) { return is_across_gap(solver, joint); });
  return areas;
}

/// The areas as cells.
///
/// Values: `block_a`, `block_b`, numbered as in `blocks.vtu`; `set`, numbered from 1, 0: of none;
/// `normal_stress_kPa` (compression positive) and `shear_stress_kPa`, means over the area of the
/// whole contact; these forces, `normal_force_kN` and `shear_force_kN`, of the whole contact;
/// `area_m2` of it; `opening_mm` and `plastic_slip_mm`, the largest of its points; `damage`, `open`
/// and `slipping` as in `joint_table`.
[[nodiscard]] VOUSSOIR_INLINE VtuGrid joint_grid(const std::vector<JointArea>& joints);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::vector<std::vector<Vec2>> loops_of(const ContactOutline& outline) {
  const auto is_same = [](const double* p, const double* q) {
    return p[0] == q[0] && p[1] == q[1];
  };
  const std::vector<ContactOutline::Edge>& edges = outline.edges;
  std::vector<std::vector<Vec2>> loops;
  for (std::size_t begin = 0; begin + 2 < edges.size();) {
    // Each edge was turned round where the axes were the other way: it then leads to where the one
    // before it comes from.
    const bool is_turned = !is_same(edges[begin].to, edges[begin + 1].from);
    std::vector<Vec2> loop;
    std::size_t k = begin;
    for (bool is_closed = false; !is_closed && k < edges.size(); ++k) {
      const ContactOutline::Edge& edge = edges[k];
      loop.emplace_back(edge.from[0], edge.from[1]);
      is_closed = k > begin && (is_turned ? is_same(edge.from, edges[begin].to)
                                          : is_same(edge.to, edges[begin].from));
    }
    begin = k;
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

VOUSSOIR_INLINE int SetsBetween::operator()(const JointState<3>& joint) const {
  // Of the cuts that made a face of both blocks, the one whose plane is nearest.
  const auto each_face = [&](int block, double way, auto&& visit) {
    for (const ConvexPolyhedron& part : mass_->bodies[static_cast<std::size_t>(block)].parts)
      for (std::size_t k = 0; k < part.size(); ++k) {
        const int cut = part.cut(k);
        if (cut < 0 || mass_->cuts[static_cast<std::size_t>(cut)].kind != Cut::Kind::joint)
          continue;
        // 0.9: blocks turn by far less, and faces of one block meet at more.
        if (way * dot_product(part.half_space(k).normal, joint.normal) > 0.9)
          visit(cut, std::abs(part.half_space(k).distance(joint.centre)));
      }
  };
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  each_face(joint.a, 1, [&](int cut, double distance) {
    if (distance >= least) return;
    bool is_shared = false;
    each_face(joint.b, -1, [&](int other, double) { is_shared = is_shared || other == cut; });
    if (!is_shared) return;
    nearest = cut;
    least = distance;
  });
  if (nearest < 0) return -1;
  const int source = mass_->cuts[static_cast<std::size_t>(nearest)].source;
  return mass_->joints[static_cast<std::size_t>(source)].set;
}

}  // namespace detail

VOUSSOIR_INLINE VtuGrid joint_grid(const std::vector<JointArea>& joints) {
  VtuGrid grid;
  const std::vector<const char*> names{
      "block_a",         "block_b",        "set",     "normal_stress_kPa", "shear_stress_kPa",
      "normal_force_kN", "shear_force_kN", "area_m2", "opening_mm",        "plastic_slip_mm",
      "damage",          "open",           "slipping"};
  std::vector<std::vector<double>> columns(names.size());
  for (const JointArea& joint : joints) {
    const JointState<3>& s = joint.state;
    const ContactReport& r = s.report;
    const double per_area = s.measure > 0 ? 1e-3 / s.measure : 0;
    const std::vector<double> values{static_cast<double>(s.a),
                                     static_cast<double>(s.b),
                                     static_cast<double>(joint.set + 1),
                                     per_area * r.normal,
                                     per_area * r.shear,
                                     1e-3 * r.normal,
                                     1e-3 * r.shear,
                                     s.measure,
                                     1e3 * r.opening,
                                     1e3 * r.plastic_slip,
                                     r.damage,
                                     r.is_open ? 1.0 : 0.0,
                                     r.is_slipping ? 1.0 : 0.0};
    for (const std::vector<Vec3>& polygon : joint.polygons) {
      grid.add_polygon(polygon);
      for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(values[k]);
    }
  }
  for (std::size_t k = 0; k < columns.size(); ++k)
    grid.add_values(names[k], 1, std::move(columns[k]));
  return grid;
}

#endif

}  // namespace voussoir
