// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/detail/surface.hpp>

namespace voussoir::detail {

/// Refuses what is not the surface of a convex polyhedron, and computes planes and twins of what
/// is.
///
/// The tests follow one another so that each may trust the ones before; the first rule broken is
/// named, with the face or vertex and the value.
class SurfaceCheck {
 public:
  explicit SurfaceCheck(Surface& surface) : surface_(surface) {}

  /// @throws InvalidInput
  void run() {
    check_vertices();
    for (std::size_t f = 0; f < surface_.faces.size(); ++f) check_loop(f);
    check_use();
    for (std::size_t f = 0; f < surface_.faces.size(); ++f) check_outline(f);
    for (std::size_t f = 0; f < surface_.faces.size(); ++f) check_side(f);
    pair_edges();
  }

 private:
  [[noreturn]] static void refuse(const std::string& text) {
    throw InvalidInput("convex polyhedron: " + text);
  }
  [[nodiscard]] static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }
  [[nodiscard]] static std::string face_name(std::size_t f) { return "face " + std::to_string(f); }
  [[nodiscard]] std::string vertex_name(std::size_t v) const {
    return "vertex " + std::to_string(v) + " at " + text_of<3>(surface_.vertices[v]);
  }
  [[nodiscard]] const Vec3& corner(const Surface::Face& face, std::size_t k) const {
    const auto loop = surface_.loop(face);
    return surface_.vertices[static_cast<std::size_t>(loop[k % loop.size()])];
  }

  void check_vertices();

  void check_loop(std::size_t f) const;

  void check_use() const {
    std::vector<bool> used(surface_.vertices.size(), false);
    for (const int v : surface_.loops) used[static_cast<std::size_t>(v)] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (!used[v]) refuse(vertex_name(v) + " belongs to no face, must belong to 3");
  }

  /// The face by itself: planar and convex. Sets its plane.
  void check_outline(std::size_t f);

  /// The face against all vertices: the polyhedron lies below it.
  void check_side(std::size_t f);

  /// Every edge must be run along once by each of two faces.
  void pair_edges();

  Surface& surface_;
  double tolerance_ = 0;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void SurfaceCheck::check_vertices() {
  const auto& vertices = surface_.vertices;
  if (vertices.size() < 4)
    refuse("has " + std::to_string(vertices.size()) + " vertices, needs at least 4");
  if (surface_.faces.size() < 4)
    refuse("has " + std::to_string(surface_.faces.size()) + " faces, needs at least 4");
  Vec3 low = vertices.front(), high = low;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!voussoir::is_finite(vertices[v])) refuse(vertex_name(v) + ": coordinates must be finite");
    low = smaller_of(low, vertices[v]);
    high = larger_of(high, vertices[v]);
  }
  // A billionth of the size: coordinates written with ten digits pass, and no joint is so thin.
  // Far from the origin the coordinates themselves are rounded to more than that.
  const double farthest = largest_entry(larger_of(magnitudes(low), magnitudes(high)));
  tolerance_ = 1e-9 * length_of(high - low) + 8 * std::numeric_limits<double>::epsilon() * farthest;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    for (std::size_t w = 0; w < v; ++w)
      if (const double gap = length_of(vertices[v] - vertices[w]); !(gap > tolerance_))
        refuse(vertex_name(v) + " repeats vertex " + std::to_string(w) + ": they are " +
               number(gap) + " m apart, must be more than " + number(tolerance_) + " m");
}

VOUSSOIR_INLINE void SurfaceCheck::check_loop(std::size_t f) const {
  const auto loop = surface_.loop(surface_.faces[f]);
  if (loop.size() < 3)
    refuse(face_name(f) + " has " + std::to_string(loop.size()) + " vertices, needs at least 3");
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (loop[k] < 0 || static_cast<std::size_t>(loop[k]) >= surface_.vertices.size())
      refuse(face_name(f) + " names vertex " + std::to_string(loop[k]) + ", must be 0 to " +
             std::to_string(surface_.vertices.size() - 1));
    for (std::size_t j = 0; j < k; ++j)
      if (loop[j] == loop[k])
        refuse(face_name(f) + " names vertex " + std::to_string(loop[k]) +
               " twice, must name each once");
  }
}

VOUSSOIR_INLINE void SurfaceCheck::check_outline(std::size_t f) {
  Surface::Face& face = surface_.faces[f];
  const std::size_t count = surface_.loop(face).size();
  const Vec3 area = doubled_area(count, [&](std::size_t k) { return corner(face, k); });
  double longest = 0;
  for (std::size_t k = 0; k < count; ++k)
    longest = std::max(longest, length_of(corner(face, k + 1) - corner(face, k)));
  if (!(length_of(area) > tolerance_ * longest))
    refuse(face_name(f) + " has the area " + number(0.5 * length_of(area)) +
           " m^2: its vertices lie on one line or its outline crosses itself");
  const Vec3 normal = normalized(area), origin = corner(face, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto v = static_cast<std::size_t>(surface_.loop(face)[k]);
    const Vec3 arm = corner(face, k) - origin;
    if (const double d = std::abs(dot_product(normal, arm)); !(d <= tolerance_))
      refuse(face_name(f) + " is not planar: " + vertex_name(v) + " lies " + number(d) +
             " m off its plane, may lie " + number(tolerance_) + " m off");
    // Left turns everywhere; and seen from the first vertex the others pass by once, which a
    // star does not do.
    const Vec3 in = corner(face, k) - corner(face, k + count - 1);
    const Vec3 out = corner(face, k + 1) - corner(face, k);
    const double turn = dot_product(normal, cross(in, out)),
                 swept = dot_product(normal, cross(arm, out));
    if (!(turn >= -tolerance_ * std::max(length_of(in), length_of(out))) ||
        !(swept >= -tolerance_ * std::max(length_of(arm), length_of(out))))
      refuse(face_name(f) + " is not convex or crosses itself: at " + vertex_name(v) +
             " its outline turns the wrong way");
  }
  face.plane = HalfSpace<3>::through(origin, normal);
}

VOUSSOIR_INLINE void SurfaceCheck::check_side(std::size_t f) {
  Surface::Face& face = surface_.faces[f];
  const Vec3 origin = corner(face, 0);
  double lowest = 0, highest = 0;
  std::size_t top = 0;
  for (std::size_t v = 0; v < surface_.vertices.size(); ++v) {
    const double d = dot_product(face.plane.normal, surface_.vertices[v] - origin);
    lowest = std::min(lowest, d);
    if (d > highest) {
      highest = d;
      top = v;
    }
  }
  if (lowest >= -tolerance_ && highest <= tolerance_)
    refuse("has no volume: all vertices lie within " + number(std::max(-lowest, highest)) +
           " m of the plane of " + face_name(f) + ", must reach more than " + number(tolerance_) +
           " m below it");
  if (lowest >= -tolerance_)
    refuse(face_name(f) + " is clockwise seen from outside: " + vertex_name(top) + " lies " +
           number(highest) + " m above it, must lie below");
  if (highest > tolerance_)
    refuse("is not convex: " + vertex_name(top) + " lies " + number(highest) +
           " m above the plane of " + face_name(f) + ", must lie below");
  // The supporting plane: no vertex is above it but for one rounding.
  face.plane.offset += highest;
}

VOUSSOIR_INLINE void SurfaceCheck::pair_edges() {
  std::vector<std::size_t> face_of(surface_.loops.size());
  for (std::size_t f = 0; f < surface_.faces.size(); ++f)
    for (int h = surface_.faces[f].begin; h < surface_.faces[f].end; ++h)
      face_of[static_cast<std::size_t>(h)] = f;
  if (const auto fault = find_twins(surface_)) {
    const auto half = static_cast<std::size_t>(fault->half);
    const Surface::Face& face = surface_.faces[face_of[half]];
    const int next = fault->half + 1 == face.end ? face.begin : fault->half + 1;
    const std::string edge = "from vertex " + std::to_string(surface_.loops[half]) + " to " +
                             std::to_string(surface_.loops[static_cast<std::size_t>(next)]);
    if (fault->other < 0)
      refuse("is open: the edge of " + face_name(face_of[half]) + " " + edge +
             " has no second face");
    refuse("faces " + std::to_string(face_of[half]) + " and " +
           std::to_string(face_of[static_cast<std::size_t>(fault->other)]) + " both run " + edge +
           ": an edge has two faces, which run along it in opposite directions");
  }
  // Euler: one closed surface without holes, and no vertex in which two of them touch.
  const auto euler = static_cast<long>(surface_.vertices.size() + surface_.faces.size()) -
                     static_cast<long>(surface_.loops.size() / 2);
  if (euler != 2) refuse("vertices - edges + faces = " + std::to_string(euler) + ", must be 2");
}

#endif

}  // namespace voussoir::detail
