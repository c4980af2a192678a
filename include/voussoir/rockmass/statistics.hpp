// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/inscribed_ball.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/block_intersections.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// What a straight line meets in the rock.
struct Scanline {
  double length = 0;       ///< inside the rock [m]
  std::size_t joints = 0;  ///< crossed from one body to the next; openings do not count

  /// length / joints [m]; infinite when no joint is crossed
  [[nodiscard]] double spacing() const {
    return joints > 0 ? length / static_cast<double>(joints)
                      : std::numeric_limits<double>::infinity();
  }
};

/// Adds what the line meets to `found`.
template <class Geometry>
void scan(const RockMass<Geometry>& mass, const typename Geometry::Line& line, Scanline& found) {
  const std::vector<BlockIntersection> intersections = block_intersections(mass, line);
  for (std::size_t k = 0; k < intersections.size(); ++k) {
    found.length += intersections[k].to - intersections[k].from;
    const bool next_touches =
        k + 1 < intersections.size() &&
        intersections[k + 1].from - intersections[k].to < same_point * mass.domain.tolerance();
    if (next_touches) ++found.joints;
  }
}

/// Mean joint spacing along a scanline: length inside the rock / number of joints crossed [m].
/// Infinite when no joint is crossed.
template <class Geometry>
[[nodiscard]] double scanline_spacing(const RockMass<Geometry>& mass,
                                      const typename Geometry::Line& line) {
  Scanline found;
  scan(mass, line, found);
  return found.spacing();
}

/// Mean spacing over scanlines that radiate from `centre`, starting at `inner`, `length` long:
/// total length / total number of joints, over `directions` equally spaced directions [m].
[[nodiscard]] VOUSSOIR_INLINE double radial_spacing(const RockMass<Planar>& mass,
                                                    const Vec2& centre, double inner, double length,
                                                    int directions = 72);

/// Area of joints per volume of rock, P32 [m^2/m^3]; in a section their length per area, P21.
///
/// Counted are the faces that joints made, two to a joint: what slicing has made of the joints,
/// which it lengthens to the ends of the blocks they reach and leaves out where limits say so.
/// @param set  joints of this set only
/// @cost  linear in the faces
template <class Geometry>
[[nodiscard]] double joint_intensity(const RockMass<Geometry>& mass, std::optional<int> set = {}) {
  double faces = 0, rock = 0;
  for (const auto& body : mass.bodies) {
    rock += body.properties.measure;
    for (const auto& part : body.parts)
      for (std::size_t k = 0; k < part.size(); ++k) {
        const Cut& cut = mass.cuts[static_cast<std::size_t>(part.cut(k))];
        if (cut.kind == Cut::Kind::joint &&
            (!set || mass.joints[static_cast<std::size_t>(cut.source)].set == *set))
          faces += part.face(k).measure();
      }
  }
  return 0.5 * faces / rock;
}

/// Distribution of block sizes.
struct BlockSizes {
  std::size_t count = 0;
  double smallest = 0, median = 0, mean = 0, largest = 0;  ///< area [m^2] or volume [m^3]
  double smallest_inscribed_radius = 0;                    ///< over all convex parts [m]
};

/// @pre at least one body
template <class Geometry>
[[nodiscard]] BlockSizes block_sizes(const RockMass<Geometry>& mass) {
  std::vector<double> sizes;
  BlockSizes result;
  result.smallest_inscribed_radius = std::numeric_limits<double>::infinity();
  for (const auto& body : mass.bodies) {
    sizes.push_back(body.properties.measure);
    result.mean += sizes.back();
    for (const auto& part : body.parts)
      result.smallest_inscribed_radius =
          std::min(result.smallest_inscribed_radius, inscribed_ball(part).radius);
  }
  std::sort(sizes.begin(), sizes.end());
  result.count = sizes.size();
  result.smallest = sizes.front();
  result.median = sizes[sizes.size() / 2];
  result.largest = sizes.back();
  result.mean /= static_cast<double>(sizes.size());
  return result;
}

/// Which part of the rock lies in blocks up to which size: the grading curve of the rock mass.
/// Weighted by size, so that many small blocks do not hide the large ones.
class BlockSizeCurve {
 public:
  /// @throws InvalidInput  no body
  template <class Geometry>
  explicit BlockSizeCurve(const RockMass<Geometry>& mass) {
    if (mass.bodies.empty()) throw InvalidInput("block size curve: needs at least one block");
    for (const auto& body : mass.bodies) sizes_.push_back(body.properties.measure);
    std::sort(sizes_.begin(), sizes_.end());
    double sum = 0;
    for (const double size : sizes_) passing_.push_back(sum += size);
    for (double& part : passing_) part /= sum;
  }

  /// All block sizes, ascending [m^2] or [m^3].
  [[nodiscard]] const std::vector<double>& sizes() const { return sizes_; }
  /// Part of the rock in blocks up to and including each of them: from 0 to 1 [-].
  [[nodiscard]] const std::vector<double>& passing() const { return passing_; }

  /// The smallest block size up to which blocks make the given part of the rock: V50 is
  /// `size_at(0.5)` [m^2] or [m^3].
  /// @throws InvalidInput  a part outside 0 to 1
  [[nodiscard]] double size_at(double part) const {
    require(part >= 0 && part <= 1, "part of the rock", part, "0 to 1");
    const auto found = std::lower_bound(passing_.begin(), passing_.end(), part);
    const auto last = static_cast<std::ptrdiff_t>(sizes_.size()) - 1;
    return sizes_[static_cast<std::size_t>(std::min(found - passing_.begin(), last))];
  }

 private:
  std::vector<double> sizes_, passing_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE double radial_spacing(const RockMass<Planar>& mass, const Vec2& centre,
                                      double inner, double length, int directions) {
  Scanline found;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / directions;
    const Vec2 out(elementary::cosine(angle), elementary::sine(angle));
    scan(mass, {centre + inner * out, centre + (inner + length) * out}, found);
  }
  return found.spacing();
}

#endif

}  // namespace voussoir
