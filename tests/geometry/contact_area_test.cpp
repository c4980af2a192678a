// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/contact_area.hpp>

#include "support/shapes.hpp"
#include "support/solids.hpp"

namespace contact_area_test {

using namespace voussoir;

namespace {

template <int Dim, class Facet>
ContactArea<Dim> joined(const std::vector<Facet>& facets) {
  ContactArea<Dim> area;
  for (const Facet& f : facets) area.add(f);
  return area;
}

/// The places of points, seen from the origin.
template <class Area>
auto places(const Area& area) {
  auto points = area.gauss_points();
  for (auto& p : points) p.offset += area.centre();
  return points;
}

/// Largest distance of a point of one set from the nearest of the other, or of their weights.
template <class Points>
double apart(const Points& these, const Points& those) {
  double worst = 0;
  for (const auto& p : these) {
    double nearest = 1e300;
    for (const auto& q : those)
      nearest =
          std::min(nearest, std::max((p.offset - q.offset).norm(), std::abs(p.weight - q.weight)));
    worst = std::max(worst, nearest);
  }
  return worst;
}

/// An outline in the plane z = 0, turned and moved.
SpatialFacet facet_of(const std::vector<Vec2>& outline, const Pose<3>& pose) {
  SpatialFacet facet;
  for (const Vec2& p : outline) facet.vertices.push_back(pose({p.x(), p.y(), 0}));
  return facet;
}

/// A convex outline cut into parts by lines in any direction.
std::vector<ConvexPolygon> parts_of(Random& random, const ConvexPolygon& whole, int cuts) {
  std::vector<ConvexPolygon> parts{whole};
  for (int k = 0; k < cuts; ++k) {
    const std::size_t n = random.below(parts.size());
    const double angle = 7 * random.uniform();
    const auto line = HalfSpace<2>::through(mass_properties(parts[n]).centroid,
                                            Vec2(std::cos(angle), std::sin(angle)));
    auto two = parts[n].split(line, 0, 1e-12);
    REQUIRE(two);
    parts[n] = std::move(two->first);
    parts.push_back(std::move(two->second));
  }
  return parts;
}

/// In the plane through the vertical, or turned by 90 degrees about it.
const Eigen::Matrix3d mirror_x = Eigen::Vector3d(-1, 1, 1).asDiagonal();
const Eigen::Matrix3d mirror_y = Eigen::Vector3d(1, -1, 1).asDiagonal();
Eigen::Matrix3d quarter_turn() {
  Eigen::Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return turn;
}

}  // namespace

TEST_SUITE("geometry/contact_area") {
  TEST_CASE("however a segment is divided, and added in whatever order, its points are its own") {
    Random random(1);
    for (const double far : {0.0, 1e6})
      for (int trial = 0; trial < 100; ++trial) {
        const Vec2 shift(far, -far);
        const Segment whole{shift + Vec2(random.uniform(), random.uniform()),
                            shift + Vec2(2 + random.uniform(), -random.uniform())};
        std::vector<double> ends{0, 1};
        for (std::size_t k = random.below(5); k > 0; --k) ends.push_back(random.uniform());
        std::sort(ends.begin(), ends.end());
        std::vector<Segment> pieces;
        for (std::size_t k = 0; k + 1 < ends.size(); ++k)
          pieces.push_back({whole.at(ends[k]), whole.at(ends[k + 1])});
        random.shuffle(pieces);
        const auto area = joined<2>(pieces);
        // A few roundings of coordinates up to 3 m, or up to 1e6 m.
        const double rounding = far > 0 ? 1e-9 : 4e-15;
        CHECK((area.area_vector() - whole.area_vector()).norm() < rounding);
        CHECK((area.centre_from(shift) - whole.centre_from(shift)).norm() < rounding);
        const auto ours = area.gauss_points(), one = whole.gauss_points();
        for (std::size_t k = 0; k < 2; ++k) {
          CHECK((ours[k].offset - one[k].offset).norm() < rounding);
          CHECK(std::abs(ours[k].weight - one[k].weight) < rounding);
        }
      }
  }

  TEST_CASE("segments with gaps: exact for force and moment, corners at the outermost ends") {
    Random random(2);
    for (int trial = 0; trial < 200; ++trial) {
      const double angle = 7 * random.uniform();
      const Vec2 along(std::cos(angle), std::sin(angle)), start(random.normal(), random.normal());
      std::vector<std::pair<double, double>> stretches;
      std::vector<Segment> pieces;
      double end = 0;
      for (std::size_t k = 1 + random.below(4); k > 0; --k) {
        const double from = end + 2 * random.uniform();
        end = from + std::pow(10.0, -3 * random.uniform());
        stretches.emplace_back(from, end);
        pieces.push_back({start + from * along, start + end * along});
      }
      const double first = stretches.front().first;
      random.shuffle(pieces);
      const auto area = joined<2>(pieces);
      const auto moment = [&](int power) {
        double sum = 0;
        for (const auto& [from, to] : stretches)
          sum += (std::pow(to, power + 1) - std::pow(from, power + 1)) / (power + 1);
        return sum;
      };
      const auto check = [&](const auto& points, int degree) {
        for (int power = 0; power <= degree; ++power) {
          double sum = 0;
          for (const auto& p : points)
            sum += p.weight * std::pow(along.dot(area.centre() + p.offset - start), power);
          // Roundings of places up to 12 m in their third power.
          CHECK(std::abs(sum - moment(power)) < 1e-11 * (1 + moment(power)));
        }
      };
      check(area.gauss_points(), 2);
      const auto corners = area.corner_points();
      check(corners, 3);
      CHECK(std::abs(along.dot(area.centre() + corners[0].offset - start) - first) < 1e-14);
      CHECK(std::abs(along.dot(area.centre() + corners[2].offset - start) - end) < 1e-14);
      for (const auto& p : corners) CHECK(p.weight > 0);
    }
  }

  TEST_CASE("the corners of one segment are Simpson's") {
    const Segment whole{{1, 2}, {4, 6}};
    const auto points = joined<2>(std::vector{whole}).corner_points();
    const std::array<double, 3> weights{5.0 / 6, 10.0 / 3, 5.0 / 6};
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(std::abs(points[k].weight - weights[k]) < 1e-15);
      CHECK((points[k].offset - (0.5 * static_cast<double>(k) - 0.5) * Vec2(3, 4)).norm() < 1e-15);
    }
  }

  TEST_CASE("however a polygon in space is divided, its four points are its own") {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
      CAPTURE(trial);
      Pose<3> pose;
      pose.rotation = voussoir_test::random_rotation(random);
      pose.position = voussoir_test::random_direction(random);
      // Squares as well, of which all axes are principal.
      const ConvexPolygon outline =
          trial % 4 == 0 ? ConvexPolygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}})
                         : voussoir_test::random_convex(random, 6, 1, trial % 4 == 1 ? 1e-2 : 1);
      const SpatialFacet whole = facet_of(outline.vertices(), pose);
      std::vector<SpatialFacet> pieces;
      for (const ConvexPolygon& part : parts_of(random, outline, static_cast<int>(random.below(5))))
        pieces.push_back(facet_of(part.vertices(), pose));
      random.shuffle(pieces);
      const auto area = joined<3>(pieces);
      const auto one = places(joined<3>(std::vector{whole}));
      // As well as the axes are known: see geometry/spatial_facet_test.cpp.
      const double contrast = std::abs((one[0].offset - one[1].offset).squaredNorm() -
                                       (one[2].offset - one[3].offset).squaredNorm()) /
                              4;
      const double bound = contrast > 1e-6 ? 1e-14 / contrast + 1e-14 : 1e-13;
      CHECK(apart(places(area), one) < bound);
      CHECK(apart(places(whole), one) < bound);
      CHECK((area.area_vector() - whole.area_vector()).norm() < 1e-14);
    }
  }

  TEST_CASE("mirrored or turned with the ground, the points are mirrored or turned") {
    // What has no principal axes of its own, in level, upright and inclined planes: the ground has
    // a vertical, and its mirror images are those in vertical planes.
    Random random(4);
    for (int corners : {3, 4, 5, 6, 8, 12})
      for (int trial = 0; trial < 30; ++trial) {
        CAPTURE(corners);
        Pose<3> pose;
        if (trial % 3 > 0) pose.rotation = voussoir_test::random_rotation(random);
        if (trial % 3 == 1) pose.rotation = rotation_by(Spin<3>(std::acos(0.0), 0, 0));
        const auto outline = voussoir_test::regular(corners, 1);
        const SpatialFacet facet = facet_of(outline, pose);
        for (const Eigen::Matrix3d& map : {mirror_x, mirror_y, quarter_turn()}) {
          SpatialFacet image;
          for (const Vec3& v : facet.vertices) image.vertices.push_back(map * v);
          if (cross(map.col(0), map.col(1)).dot(map.col(2)) < 0)
            std::reverse(image.vertices.begin(), image.vertices.end());
          // Numbered anew, as slicing does.
          std::rotate(image.vertices.begin(),
                      image.vertices.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                      image.vertices.end());
          auto expected = places(facet);
          for (auto& p : expected) p.offset = map * p.offset;
          CHECK(apart(places(image), expected) < 1e-14);
        }
      }
  }

  TEST_CASE("two squares apart in one plane: the points stand as their moments say") {
    // Unit squares centred at x = -2 and 2: the squared radii are 4 + 1/12 and 1/12.
    const auto square = [](double x) {
      return SpatialFacet{
          {{x - 0.5, -0.5, 1}, {x + 0.5, -0.5, 1}, {x + 0.5, 0.5, 1}, {x - 0.5, 0.5, 1}}};
    };
    const auto points = joined<3>(std::vector{square(-2), square(2)}).gauss_points();
    CHECK(std::abs(points[0].offset.norm() - std::sqrt(2 * (4 + 1.0 / 12))) < 1e-15);
    CHECK(std::abs(std::abs(points[0].offset.x()) - points[0].offset.norm()) < 1e-15);
    CHECK(std::abs(points[2].offset.norm() - std::sqrt(1.0 / 6)) < 1e-15);
    for (const auto& p : points) CHECK(p.weight == 0.5);
  }
}

}  // namespace contact_area_test
