// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/block_size_curve.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// What a block at a free face does under its weight alone if no friction holds it.
enum class BlockMode {
  tapered,              ///< no direction is free: its neighbours hold it, whatever pulls
  rests,                ///< removable, but not downwards: a support would have to push it out
  slides_on_one_face,   ///< down one of its faces
  slides_on_two_faces,  ///< down the edge of two
  falls,                ///< its weight lifts it off all faces
};
/// "falls", "slides on one face", ...
[[nodiscard]] VOUSSOIR_INLINE const char* to_string(BlockMode mode);

/// The first motion of a block as a rigid body that does not turn.
template <int Dim>
struct BlockMotion {
  BlockMode mode = BlockMode::tapered;
  /// Of the motion under its weight, unit length; where it rests, the direction that lifts it
  /// least; zero where it is tapered.
  Vec<Dim> direction = zeros<Vec<Dim>>();
  /// Friction angle that just holds it on the faces it slides on [rad], 0 to pi/2: pi/2 where it
  /// falls, 0 where it rests or is tapered. No cohesion, and no stress but that of its weight.
  double needed_friction = 0;
  /// Of the faces it slides on, their indices; -1: none.
  std::array<int, 2> faces{-1, -1};

  [[nodiscard]] bool is_removable() const { return mode != BlockMode::tapered; }
  /// Whether its weight moves it where there is no friction.
  [[nodiscard]] bool is_driven() const { return mode > BlockMode::rests; }
};

/// Faces that open or close by less than this on the way are parallel to it [rad]: a micrometre a
/// metre. Normals of short faces are known to no more.
inline constexpr double parallel_motion = 1e-6;

/// Block theory of one block: whether it can be moved, and where it goes by itself.
///
/// The directions s that no neighbour blocks are a cone, C = {s : n_i . s <= 0 for all i}. If it
/// holds any direction it holds one along an edge or, where all faces are parallel, in a face: the
/// lines n_i x n_j (in 2-D the directions of the faces), both ways, and one tangent of each face
/// settle whether the block is removable. The direction w of its weight drives it along the s of C
/// that w leans to most, which is w itself, its projection on a face or one of these edges: of all
/// that lie in C the one with the largest w . s. Where that is not above zero, the block rests. On
/// the faces it slides on
///
///   tan(needed friction) = w.s / sum N_i,   w = (w.s) s + sum N_i n_i,  N_i >= 0
///
/// @param normals  of the faces in contact with rock, out of the block, unit length; none: it is
///                 free on all sides
/// @param weight   direction of the active force, unit length
/// @param taper    faces that close by less than this on the way do not hold the block
///                 [rad], 0 to 0.5; of more than `parallel_motion` it asks what is wedged in by
///                 little, along the directions above and no others
/// @throws InvalidInput  a vector is not of unit length; taper out of range
/// @cost   O(n^3) in 3-D, n different normals
///
/// Source: Goodman & Shi (1985), Block Theory and Its Application to Rock Engineering, chapters 4
/// and 9; modes as in Warburton (1981), Int. J. Rock Mech. Min. Sci. 18, 415-427. They cut a block
/// out of infinite planes; here the faces are those in contact, so the block may have any number of
/// neighbours, and one that would be stopped on its way is still called removable.
[[nodiscard]] VOUSSOIR_INLINE BlockMotion<2> block_motion(std::span<const Vec2> normals,
                                                          const Vec2& weight,
                                                          double taper = parallel_motion);
[[nodiscard]] VOUSSOIR_INLINE BlockMotion<3> block_motion(std::span<const Vec3> normals,
                                                          const Vec3& weight,
                                                          double taper = parallel_motion);

/// A block with a free face: at the wall of an opening, or behind a piece that was dropped there.
template <class Geometry>
struct WallBlock {
  static constexpr int dim = Geometry::dim;

  int body;                       ///< its number in the mass
  double size;                    ///< area [m^2] or volume [m^3]
  double free_measure;            ///< length or area of its free faces [m], [m^2]
  Vec<dim> place;                 ///< middle of them [m]
  double depth;                   ///< of its farthest corner from the opening [m]
  BlockMotion<dim> motion;        ///< its faces are indices of `normals`
  std::vector<Vec<dim>> normals;  ///< of its faces in contact with rock, out of the block
};

/// The blocks at the walls of all openings, in the order of the bodies.
template <class Geometry>
struct WallBlocks {
  std::vector<WallBlock<Geometry>> blocks;
  /// Blocks that a side of the domain has cut, left out: what they are like beyond is not known.
  std::size_t cut_count = 0;
};

/// Kinematics of every block that has a free face: which can be moved into the opening, alone and
/// as the first one, without turning.
///
/// Friction decides nothing here but the angle that would be needed, and neither does stress: a
/// block that falls may be clamped in place, and a tapered one is as safe as the rock behind it.
/// Groups of blocks that move together and what comes loose once a block has gone are not looked
/// for; contacts along a line or in a point do not hold.
///
/// @pre   the mass is as it was sliced and carved, nothing moved; weight acts down the last axis
/// @cost  contacts from the cuts, see `CutContacts`; then linear in the faces
/// @throws Stopped
template <class Geometry>
[[nodiscard]] WallBlocks<Geometry> wall_blocks(const RockMass<Geometry>& mass,
                                               const Progress& progress = {});

namespace detail {

/// How far a point lies outside an opening; 0 inside [m].
[[nodiscard]] VOUSSOIR_INLINE double distance_to(const SimplePolygon& opening, const Vec2& point);
[[nodiscard]] VOUSSOIR_INLINE double distance_to(const PrismaticOpening& opening,
                                                 const Vec3& point);

/// 0 where there is no opening [m].
template <class Opening, class Point>
[[nodiscard]] double distance_to_nearest(const std::vector<Opening>& openings, const Point& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Opening& opening : openings) nearest = std::min(nearest, distance_to(opening, point));
  return openings.empty() ? 0 : nearest;
}

/// Unit normal of a joint.
[[nodiscard]] inline Vec2 normal_of(const Segment& trace) {
  return -normalized(perpendicular(trace.end - trace.start));
}
[[nodiscard]] inline Vec3 normal_of(const JointPlane& trace) { return trace.plane.normal; }

/// Of a contact, on the side of its area vector: that of its joint, where there is one, since
/// corners are welded and the normal of a short face with them.
template <class Geometry>
[[nodiscard]] Vec<Geometry::dim> contact_normal(const RockMass<Geometry>& mass,
                                                const ContactFacet<Geometry>& contact) {
  const Vec<Geometry::dim> own = normalized(contact.facet.area_vector());
  const Cut& cut = mass.cuts[static_cast<std::size_t>(contact.cut)];
  if (cut.kind != Cut::Kind::joint) return own;
  const auto of_joint = normal_of(mass.joints[static_cast<std::size_t>(cut.source)].trace);
  const double cosine = dot_product(own, of_joint);
  if (!(std::abs(cosine) > 1 - 1e-6)) return own;  // traces of a map may bend where they are joined
  return cosine < 0 ? Vec<Geometry::dim>(-of_joint) : of_joint;
}

/// What of the faces of one body along one cut is free: faces less contacts.
template <int Dim>
struct FreeFace {
  int cut;
  Vec<Dim> area = zeros<Vec<Dim>>();    ///< out of the body
  Vec<Dim> normal = zeros<Vec<Dim>>();  ///< of the first face: what looks the other way counts < 0
  Vec<Dim> moment = zeros<Vec<Dim>>();  ///< of the area about the centroid of the body

  void add(const Vec<Dim>& by, const Vec<Dim>& arm, double sign) {
    if (is_zero(normal) && !is_zero(by)) normal = normalized(by);
    area += sign * by;
    moment += sign * dot_product(by, normal) * arm;
  }
};

template <int Dim>
[[nodiscard]] FreeFace<Dim>& of_cut(std::vector<FreeFace<Dim>>& faces, int cut) {
  const auto at = std::find_if(faces.begin(), faces.end(),
                               [&](const FreeFace<Dim>& face) { return face.cut == cut; });
  if (at != faces.end()) return *at;
  return faces.emplace_back(FreeFace<Dim>{cut});
}

}  // namespace detail

template <class Geometry>
WallBlocks<Geometry> wall_blocks(const RockMass<Geometry>& mass, const Progress& progress) {
  constexpr int dim = Geometry::dim;
  using Vector = Vec<dim>;
  struct Seen {
    std::vector<detail::FreeFace<dim>> faces;
    std::vector<Vector> normals;
    double surface = 0;
  };
  std::vector<Seen> seen(mass.bodies.size());
  const auto centre = [&](std::size_t b) -> const Vector& {
    return mass.bodies[b].properties.centroid;
  };
  // Faces between parts of one body cancel: their area vectors are opposite.
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const auto& part : mass.bodies[b].parts)
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto face = part.face(k);
        const Vector area = face.area_vector();
        seen[b].surface += length_of(area);
        detail::of_cut(seen[b].faces, part.cut(k)).add(area, face.centre_from(centre(b)), 1);
      }
  for (const ContactFacet<Geometry>& contact : CutContacts::find(mass, progress)) {
    const Vector area = contact.facet.area_vector(), normal = detail::contact_normal(mass, contact);
    for (const double side : {1.0, -1.0}) {
      const auto b = static_cast<std::size_t>(side > 0 ? contact.a : contact.b);
      detail::of_cut(seen[b].faces, contact.cut)
          .add(side * area, contact.facet.centre_from(centre(b)), -1);
      seen[b].normals.push_back(side * normal);
    }
  }
  WallBlocks<Geometry> found;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const Body<Geometry>& body = mass.bodies[b];
    WallBlock<Geometry> block{
        static_cast<int>(b), body.properties.measure, 0, zeros<Vector>(), 0, {}, {}};
    for (const auto& face : seen[b].faces) {
      if (face.cut >= 0 &&
          mass.cuts[static_cast<std::size_t>(face.cut)].kind == Cut::Kind::boundary)
        continue;
      // What is left of a face between two blocks is a strip as narrow as the tolerance.
      const double measure = dot_product(face.area, face.normal);
      if (!(std::abs(measure) > 1e-6 * seen[b].surface)) continue;
      block.free_measure += std::abs(measure);
      block.place += (measure > 0 ? 1.0 : -1.0) * face.moment;
    }
    if (!(block.free_measure > 0)) continue;
    if (detail::touches_boundary(body, mass.cuts)) {
      ++found.cut_count;
      continue;
    }
    block.place = centre(b) + block.place / block.free_measure;
    for (const auto& part : body.parts)
      for (const Vector& v : part.vertices())
        block.depth = std::max(block.depth, detail::distance_to_nearest(mass.openings, v));
    block.normals = std::move(seen[b].normals);
    block.motion =
        block_motion(std::span<const Vector>(block.normals), Vector(-axis_vector<dim>(dim - 1)));
    found.blocks.push_back(std::move(block));
  }
  return found;
}

#if VOUSSOIR_BODIES

namespace detail {

/// The search for the motion of a block, over the candidates for its direction.
template <int Dim>
class MotionSearch {
 public:
  using Vector = Vec<Dim>;

  MotionSearch(std::span<const Vector> normals, const Vector& weight, double taper)
      : weight_(weight) {
    require_angle(taper >= 0 && taper <= 0.5, "taper of a block", taper, "0 to 0.5 rad");
    closing_ = elementary::sine(taper);
    const auto is_unit = [](const Vector& v) {
      return std::abs(squared_length_of(v) - 1) < 1e-9;  // NaN is none
    };
    if (!is_unit(weight)) throw InvalidInput("block motion: the weight needs a unit vector");
    for (std::size_t k = 0; k < normals.size(); ++k) {
      if (!is_unit(normals[k])) throw InvalidInput("block motion: normals must be unit vectors");
      const bool is_new = std::none_of(normals_.begin(), normals_.end(), [&](const Vector& n) {
        return squared_length_of(n - normals[k]) < 1e-24;
      });
      if (!is_new) continue;  // several neighbours on one joint
      normals_.push_back(normals[k]);
      index_.push_back(static_cast<int>(k));
    }
  }

  [[nodiscard]] BlockMotion<Dim> run() {
    if (is_free(weight_)) return {BlockMode::falls, weight_, 0.5 * std::numbers::pi, {-1, -1}};
    for (std::size_t i = 0; i < normals_.size(); ++i) try_face(i);
    if constexpr (Dim == 3)
      for (std::size_t i = 0; i < normals_.size(); ++i)
        for (std::size_t j = i + 1; j < normals_.size(); ++j) try_edge(i, j);
    return best_;
  }

 private:
  [[nodiscard]] bool is_free(const Vector& s) const {
    return std::all_of(normals_.begin(), normals_.end(),
                       [&](const Vector& n) { return dot_product(n, s) <= closing_; });
  }

  /// Takes a direction that is free and leans to the weight more than the best so far; of two that
  /// are one, the pair of faces with less pressure on it, which is on the safe side.
  void offer(const Vector& s, BlockMode mode, double pressure, std::array<int, 2> faces) {
    if (!is_free(s)) return;
    const double drive = dot_product(weight_, s);
    const bool is_driven = drive > parallel_motion;
    const double needed = is_driven ? elementary::angle_of(drive, pressure) : 0;
    constexpr double same = 1e-9;
    if (best_.is_removable() &&
        (drive < drive_ - same || (drive <= drive_ + same && needed <= best_.needed_friction)))
      return;
    drive_ = drive;
    if (!is_driven) faces = {-1, -1};  // an edge that it could be lifted along
    best_ = {is_driven ? mode : BlockMode::rests, s, needed, faces};
  }

  void try_face(std::size_t i) {
    const Vector& n = normals_[i];
    const double pressure = dot_product(weight_, n);
    const Vector along = weight_ - pressure * n;
    // Pulled off the face it does not slide on it.
    if (pressure >= 0 && length_of(along) > parallel_motion)
      offer(normalized(along), BlockMode::slides_on_one_face, pressure, {index_[i], -1});
    for (const Vector& s : tangents(n))
      if (!(dot_product(weight_, s) > parallel_motion)) offer(s, BlockMode::rests, 0, {-1, -1});
  }

  [[nodiscard]] static std::array<Vector, 2> tangents(const Vector& n) {
    if constexpr (Dim == 2) {
      return {perpendicular(n), Vector(-perpendicular(n))};
    } else {
      const Vector t = column(tangent_basis(n), 0);
      return {t, Vector(-t)};
    }
  }

  void try_edge(std::size_t i, std::size_t j) {
    if constexpr (Dim == 3) {
      const Vector &n = normals_[i], &m = normals_[j];
      const Vector along = cross(n, m);
      const double sine = length_of(along);
      if (!(sine > 1e-9)) return;  // parallel: their tangents have been tried
      for (const double sign : {1.0, -1.0}) {
        const Vector s = sign / sine * along;
        const double drive = dot_product(weight_, s);
        // w - (w.s) s = N_i n_i + N_j n_j
        const double cosine = dot_product(n, m), on_n = dot_product(weight_, n),
                     on_m = dot_product(weight_, m);
        const double pressure_n = (on_n - cosine * on_m) / (sine * sine),
                     pressure_m = (on_m - cosine * on_n) / (sine * sine);
        const bool presses = pressure_n >= 0 && pressure_m >= 0;
        if (!presses && drive > parallel_motion) continue;  // it lifts off one of them
        offer(s, BlockMode::slides_on_two_faces, pressure_n + pressure_m, {index_[i], index_[j]});
      }
    }
  }

  Vector weight_;
  double closing_ = 0;  ///< into a face, of what is called free [-]
  std::vector<Vector> normals_;
  std::vector<int> index_;
  double drive_ = -std::numeric_limits<double>::infinity();
  BlockMotion<Dim> best_;
};

}  // namespace detail

VOUSSOIR_INLINE const char* to_string(BlockMode mode) {
  switch (mode) {
    case BlockMode::tapered:
      return "tapered";
    case BlockMode::rests:
      return "rests";
    case BlockMode::slides_on_one_face:
      return "slides on one face";
    case BlockMode::slides_on_two_faces:
      return "slides on two faces";
    case BlockMode::falls:
      return "falls";
  }
  return "";
}

VOUSSOIR_INLINE BlockMotion<2> block_motion(std::span<const Vec2> normals, const Vec2& weight,
                                            double taper) {
  return detail::MotionSearch<2>(normals, weight, taper).run();
}
VOUSSOIR_INLINE BlockMotion<3> block_motion(std::span<const Vec3> normals, const Vec3& weight,
                                            double taper) {
  return detail::MotionSearch<3>(normals, weight, taper).run();
}

namespace detail {

VOUSSOIR_INLINE double distance_to(const SimplePolygon& opening, const Vec2& point) {
  if (opening.contains(point)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < opening.size(); ++k) {
    const Segment edge = opening.edge(k);
    const Vec2 along = edge.end - edge.start, from = point - edge.start;
    const double t = std::clamp(dot_product(from, along) / squared_length_of(along), 0.0, 1.0);
    nearest = std::min(nearest, length_of(from - t * along));
  }
  return nearest;
}

VOUSSOIR_INLINE double distance_to(const PrismaticOpening& opening, const Vec3& point) {
  const double across = distance_to(opening.section(), opening.across(point));
  const double s = opening.along(point);
  return elementary::length(across, std::max({0.0, opening.from() - s, s - opening.to()}));
}

}  // namespace detail

#endif

}  // namespace voussoir
