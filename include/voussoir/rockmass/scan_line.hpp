// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/block_intersections.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// Length of core from which on a piece counts for RQD [m]. Source: Deere (1963).
inline constexpr double sound_core_length = 0.1;

/// RQD where spacings are distributed exponentially, 0 to 100 [%]:
///
///   RQD = 100 exp(-0.1 lambda) (0.1 lambda + 1)
///
/// @param frequency  lambda, joints per metre [1/m], >= 0
/// @throws InvalidInput  below 0 or not finite
/// Source: Priest & Hudson (1976), Int. J. Rock Mech. Min. Sci. 13, 135-148.
[[nodiscard]] VOUSSOIR_INLINE double rqd_by_frequency(double frequency);

/// RQD estimated from the volumetric joint count, 0 to 100 [%]: 110 - 2.5 Jv within these limits.
///
/// @param volumetric_count  Jv [1/m], >= 0
/// @throws InvalidInput  below 0 or not finite
/// Source: Palmstrom (2005), Tunn. Undergr. Space Technol. 20, 362-377. It is a correlation, good
/// to some 15 % of RQD at best, and not for slabs and bars.
[[nodiscard]] VOUSSOIR_INLINE double rqd_by_volumetric_count(double volumetric_count);

/// What scan lines, or the core of boreholes along them, show of the joints: several lines are
/// taken together as one.
struct ScanLineLog {
  double length = 0;         ///< inside the rock [m]
  std::size_t joints = 0;    ///< crossed from one block to the next; openings do not count
  double sound = 0;          ///< of that, in pieces of 0.1 m or more [m]
  double between = 0;        ///< from the first joint to the last, of every line [m]
  std::size_t spacings = 0;  ///< between two joints of a line

  /// lambda, joints per metre [1/m]; not a number without rock.
  [[nodiscard]] double frequency() const {
    return length > 0 ? static_cast<double>(joints) / length
                      : std::numeric_limits<double>::quiet_NaN();
  }
  /// Mean of the spacings between two joints of a line: without what is between the last one and
  /// the end of the line. Infinite where there is none [m].
  [[nodiscard]] double mean_spacing() const {
    return spacings > 0 ? between / static_cast<double>(spacings)
                        : std::numeric_limits<double>::infinity();
  }
  /// As counted on the core: the share of pieces of 0.1 m or more, those at the ends of the lines
  /// as they are [%]; not a number without rock.
  [[nodiscard]] double rqd() const {
    return length > 0 ? 100 * sound / length : std::numeric_limits<double>::quiet_NaN();
  }
  /// Priest & Hudson's, from the frequency.
  [[nodiscard]] double theoretical_rqd() const { return rqd_by_frequency(frequency()); }
};

/// Adds what a line meets to `log`. The joints are those that bound blocks: slicing has lengthened
/// them to the ends of the blocks they reach and has left out what its limits refused.
template <class Geometry>
void add_scan_line(const RockMass<Geometry>& mass, const typename Geometry::Line& line,
                   ScanLineLog& log) {
  constexpr double rounding = 1e-9;  // a spacing of 0.1 m may come out as 0.0999999999999999
  const std::vector<BlockIntersection> pieces = block_intersections(mass, line);
  const double touching = same_point * mass.domain.tolerance();
  bool begins_with_joint = false;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const double length = pieces[k].to - pieces[k].from;
    const bool ends_with_joint =
        k + 1 < pieces.size() && pieces[k + 1].from - pieces[k].to < touching;
    log.length += length;
    log.joints += ends_with_joint;
    if (length >= sound_core_length * (1 - rounding)) log.sound += length;
    if (begins_with_joint && ends_with_joint) {
      log.between += length;
      ++log.spacings;
    }
    begins_with_joint = ends_with_joint;
  }
}

template <class Geometry>
[[nodiscard]] ScanLineLog scan_line_log(const RockMass<Geometry>& mass,
                                        std::span<const typename Geometry::Line> lines) {
  ScanLineLog log;
  for (const auto& line : lines) add_scan_line(mass, line, log);
  return log;
}

/// Lines along an axis of the domain, from side to side, evenly over the section they cross.
///
/// @param axis   0: x, ..., the last one: up
/// @param count  across the section and, in 3-D, in both directions: count or count^2 lines, >= 1
/// @throws InvalidInput  out of range
template <class Geometry>
[[nodiscard]] std::vector<typename Geometry::Line> lines_along(const Domain<Geometry::dim>& domain,
                                                               int axis, int count) {
  constexpr int dim = Geometry::dim;
  require(axis >= 0 && axis < dim, "axis of the scan lines", axis, "0 to the dimension less 1");
  require(count >= 1 && count <= 1000, "number of scan lines", count, "1 to 1000");
  std::vector<typename Geometry::Line> lines;
  const int across = dim == 3 ? count : 1;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < across; ++j) {
      Vec<dim> start = domain.low, end;
      int seen = 0;
      for (int k = 0; k < dim; ++k)
        if (k != axis)
          start[k] += ((seen++ == 0 ? i : j) + 0.5) / count * (domain.high[k] - domain.low[k]);
      end = start;
      end[axis] = domain.high[axis];
      lines.push_back({start, end});
    }
  return lines;
}

/// Joints that a line along `direction` crosses in the mean over all places, per metre [1/m]:
///
///   lambda = sum A |n . d| / V
///
/// over the joints between blocks, A area (length) and V volume (area) of the rock. Exact for the
/// rock as it is, where scan lines are a sample.
/// @param direction  unit vector
template <class Geometry>
[[nodiscard]] double mean_frequency(const RockMass<Geometry>& mass,
                                    const Vec<Geometry::dim>& direction);

/// How often joints of one set come across it.
template <int Dim>
struct SetFrequency {
  int set;              ///< -1: joints of no set
  Vec<Dim> normal;      ///< mean of the set by area, unit length
  double frequency;     ///< along that normal [1/m]
  double area_density;  ///< P32, or P21 in a section [1/m]
};

/// One for every set of which joints bound blocks, by their numbers.
/// @cost  linear in the faces
template <class Geometry>
[[nodiscard]] std::vector<SetFrequency<Geometry::dim>> set_frequencies(
    const RockMass<Geometry>& mass);

/// Jv, joints per cubic metre: the sum of the frequencies of all sets across themselves [1/m].
/// Source: Palmstrom (1982), 4th Congr. Int. Assoc. Eng. Geol., V.221-V.228.
[[nodiscard]] VOUSSOIR_INLINE double volumetric_joint_count(std::span<const SetFrequency<3>> sets);

namespace detail {

/// Joint faces of blocks as area vectors, the two sides of a joint each by itself.
template <class Geometry>
struct JointFaces {
  struct Face {
    int set;
    Vec<Geometry::dim> area;
  };
  std::vector<Face> faces;
  double rock = 0;  ///< [m^2], [m^3]

  explicit JointFaces(const RockMass<Geometry>& mass) {
    for (const auto& body : mass.bodies) {
      rock += body.properties.measure;
      for (const auto& part : body.parts)
        for (std::size_t k = 0; k < part.size(); ++k) {
          const int label = part.cut(k);
          if (label < 0) continue;
          const Cut& cut = mass.cuts[static_cast<std::size_t>(label)];
          if (cut.kind == Cut::Kind::joint)
            faces.push_back({mass.joints[static_cast<std::size_t>(cut.source)].set,
                             part.face(k).area_vector()});
        }
    }
  }
};

/// Mean direction of area vectors that have no sense, each turned to the side of the mean.
template <int Dim>
[[nodiscard]] Vec<Dim> mean_axis(const std::vector<Vec<Dim>>& areas) {
  Vec<Dim> side = zeros<Vec<Dim>>();
  for (const Vec<Dim>& area : areas)
    if (squared_length_of(area) > squared_length_of(side)) side = area;
  for (int round = 0; round < 100; ++round) {  // ends at the second or third
    Vec<Dim> sum = zeros<Vec<Dim>>();
    for (const Vec<Dim>& area : areas) sum += (dot_product(area, side) < 0 ? -1.0 : 1.0) * area;
    if (sum == side) break;
    side = sum;
  }
  // Upward, so that a mirrored or reversed list gives the axis its one name.
  const bool is_down = side[Dim - 1] < 0 || (!(side[Dim - 1] > 0) && side[0] < 0);
  return normalized(is_down ? Vec<Dim>(-side) : side);
}

}  // namespace detail

template <class Geometry>
double mean_frequency(const RockMass<Geometry>& mass, const Vec<Geometry::dim>& direction) {
  const detail::JointFaces<Geometry> joints(mass);
  double sum = 0;
  for (const auto& face : joints.faces) sum += std::abs(dot_product(face.area, direction));
  return 0.5 * sum / joints.rock;
}

template <class Geometry>
std::vector<SetFrequency<Geometry::dim>> set_frequencies(const RockMass<Geometry>& mass) {
  constexpr int dim = Geometry::dim;
  const detail::JointFaces<Geometry> joints(mass);
  std::vector<int> sets;
  for (const auto& face : joints.faces) sets.push_back(face.set);
  std::sort(sets.begin(), sets.end());
  sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  std::vector<SetFrequency<dim>> found;
  for (const int set : sets) {
    std::vector<Vec<dim>> areas;
    for (const auto& face : joints.faces)
      if (face.set == set) areas.push_back(face.area);
    SetFrequency<dim> of_set{set, detail::mean_axis<dim>(areas), 0, 0};
    for (const Vec<dim>& area : areas) {
      of_set.frequency += std::abs(dot_product(area, of_set.normal));
      of_set.area_density += length_of(area);
    }
    of_set.frequency *= 0.5 / joints.rock;
    of_set.area_density *= 0.5 / joints.rock;
    found.push_back(of_set);
  }
  return found;
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE double rqd_by_frequency(double frequency) {
  require(frequency >= 0 && std::isfinite(frequency), "joint frequency", frequency, ">= 0");
  const double x = sound_core_length * frequency;
  return 100 * elementary::exponential(-x) * (x + 1);
}

VOUSSOIR_INLINE double rqd_by_volumetric_count(double volumetric_count) {
  require(volumetric_count >= 0 && std::isfinite(volumetric_count), "volumetric joint count",
          volumetric_count, ">= 0");
  return std::clamp(110 - 2.5 * volumetric_count, 0.0, 100.0);
}

VOUSSOIR_INLINE double volumetric_joint_count(std::span<const SetFrequency<3>> sets) {
  double sum = 0;
  for (const SetFrequency<3>& set : sets) sum += set.frequency;
  return sum;
}

#endif

}  // namespace voussoir
