// SPDX-License-Identifier: MIT
// The same pairs at the origin and at coordinates of a national grid: the detectors work near the
// pair, so that where the site is changes nothing.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/detection/analytic_centre.hpp>
#include <voussoir/detection/contact_search.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/detection/placed_shapes.hpp>

#include "support/pairs.hpp"
#include "support/solids.hpp"

namespace site_coordinates_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

template <class Detector_, int Dim>
struct Case {
  using Detector = Detector_;
  static constexpr int dim = Dim;
};

/// What numbers of 4e6 to 8e6 are rounded to, 2^-30 m, and a multiple of it: whatever is a multiple
/// can be moved to the site and back without a rounding.
constexpr double unit = 0x1p-29;

template <int Dim>
Vec<Dim> on_units(const Vec<Dim>& x) {
  Vec<Dim> rounded;
  for (int k = 0; k < Dim; ++k) rounded[k] = unit * std::round(x[k] / unit);
  return rounded;
}

template <int Dim>
Vec<Dim> site(const std::array<double, 3>& x) {
  Vec<Dim> place;
  for (int k = 0; k < Dim; ++k) place[k] = x[static_cast<std::size_t>(k)];
  return place;
}

/// Compact blocks, two by two: angles between features are no needles, which magnify roundings.
template <int Dim>
PlainPair<Dim> compact_pair(Random& random) {
  const auto kind = [&] { return std::array<int, 4>{0, 1, 3, 7}[random.below(4)]; };
  const int first = kind(), second = kind();
  const auto order = [&] { return static_cast<int>(random.below(Dim)); };
  const int on_a = order(), on_b = order();
  PlainPair<Dim> pair = touching_pair<Dim>(random, first, second, on_a, on_b, random_gap(random));
  for (Pose<Dim>* pose : {&pair.pose_a, &pair.pose_b})
    pose->position = on_units<Dim>(pose->position);
  return pair;
}

/// A triangle or tetrahedron, not too far from the regular one: its faces stay plane wherever
/// corners are rounded to.
template <int Dim>
PlainShape<Dim> simplex(Random& random) {
  const auto off = [&] { return 0.3 * (random.uniform() - 0.5); };
  if constexpr (Dim == 2) {
    return plain({Vec2(off(), off()), Vec2(1 + off(), off()), Vec2(0.5 + off(), 0.9 + off())});
  } else {
    std::vector<Vec3> corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (Vec3& corner : corners) corner = 0.5 * corner + Vec3(off(), off(), off());
    return hull(corners);
  }
}

/// Two of them that are pushed into one another anyhow.
template <int Dim>
PlainPair<Dim> deep_pair(Random& random) {
  PlainPair<Dim> pair{simplex<Dim>(random), simplex<Dim>(random), {}, {}};
  for (int k = 0; k < Dim; ++k) pair.pose_a.position[k] = 120 * (random.uniform() - 0.5);
  pair.pose_b.position = pair.pose_a.position + 0.5 * random_vector<Dim>(random);
  for (Pose<Dim>* pose : {&pair.pose_a, &pair.pose_b})
    *pose = {on_units<Dim>(pose->position), random_rotation<Dim>(random)};
  return pair;
}

template <int Dim>
PlacedShapes<Dim> placed(const PlainPair<Dim>& pair, const Vec<Dim>& move) {
  PlacedShapes<Dim> shapes;
  shapes.add(convex(pair.a), Vec<Dim>::Zero());
  shapes.add(convex(pair.b), Vec<Dim>::Zero());
  shapes.place(0, {pair.pose_a.position + move, pair.pose_a.rotation});
  shapes.place(1, {pair.pose_b.position + move, pair.pose_b.rotation});
  return shapes;
}

template <int Dim>
struct Answer {
  Touch touch;
  Vec<Dim> normal;
  double separation, measure;
  std::vector<Vec<Dim>> polygon;
};

template <class Detector, int Dim>
Answer<Dim> ask(const PlacedShapes<Dim>& shapes, double reach) {
  typename Detector::template Pair<Dim> detector(shapes);
  typename Detector::template Pair<Dim>::Memory memory;
  const Contact<Dim> found = detector.contact(0, 1, memory, reach);
  return {found.touch,
          found.normal,
          found.separation,
          found.measure,
          {found.polygon.begin(), found.polygon.end()}};
}

}  // namespace

TEST_SUITE("detection/site_coordinates") {
  using Face2 = Case<FaceContacts, 2>;
  using Face3 = Case<FaceContacts, 3>;
  using Centre2 = Case<AnalyticCentre, 2>;
  using Centre3 = Case<AnalyticCentre, 3>;

  TEST_CASE_TEMPLATE("depth, area and points are those at the origin", C, Face2, Face3, Centre2,
                     Centre3) {
    constexpr int dim = C::dim;
    Random random(41);
    int touching = 0, across = 0, pointed = 0;
    for (int k = 0; k < 3000; ++k) {
      CAPTURE(k);
      const bool is_deep = k % 2 == 0;
      const PlainPair<dim> pair = is_deep ? deep_pair<dim>(random) : compact_pair<dim>(random);
      const auto here = placed<dim>(pair, Vec<dim>::Zero());
      const double reach = 1e-3;
      const Answer<dim> near = ask<typename C::Detector, dim>(here, reach);
      // The grid has points at multiples of 256 m: there, in between, and by a border.
      for (const auto& far : {std::array{409856.0, 5699840.0, 1280.0},
                              {4.1e5, 5.7e6, 1.2e3},
                              {409984.0, 5699968.0, 1152.0}}) {
        const Vec<dim> move = site<dim>(far);
        const auto there = placed<dim>(pair, move);
        across += there.grid_point(0) != there.grid_point(1);
        const Answer<dim> found = ask<typename C::Detector, dim>(there, reach);
        // Coordinates from the grid are below 190 m at the origin and the site, rounded to 2.8e-14
        // m at most; some of them add up.
        constexpr double tolerance = 1e-12;
        if (std::abs(near.separation) < tolerance || std::abs(near.separation - reach) < tolerance)
          continue;  // a rounding decides whether they touch
        CHECK((found.touch == Touch::none) == (near.touch == Touch::none));
        if (near.touch == Touch::none) continue;
        ++touching;
        CHECK(std::abs(found.separation - near.separation) < tolerance);
        // Of two axes that are as good either may be taken.
        if (found.touch != near.touch || (found.normal - near.normal).norm() > 1e-9) continue;
        CHECK(std::abs(found.measure - near.measure) < 10 * tolerance);
        // Where features are nearly parallel or hardly overlap, roundings say where they meet.
        if (!is_deep || found.polygon.size() != near.polygon.size()) continue;
        ++pointed;
        // Points are given at the site, where a coordinate is rounded to half of 2^-30 m.
        for (std::size_t p = 0; p < near.polygon.size(); ++p)
          CHECK((found.polygon[p] - move - near.polygon[p]).norm() < 1e-9);
      }
    }
    CHECK(touching > 3000);
    CHECK(across > 10);
    CHECK(pointed > 1000);
  }

  TEST_CASE_TEMPLATE("shapes given at the site are found as at the origin", C, Face2, Face3,
                     Centre2, Centre3) {
    constexpr int dim = C::dim;
    Random random(42);
    const Vec<dim> move = site<dim>({4.1e5, 5.7e6, 1.2e3});
    int touching = 0;
    for (int k = 0; k < 1000; ++k) {
      CAPTURE(k);
      PlainPair<dim> pair = deep_pair<dim>(random);
      // Own frames that lie around the place of each, as in rock that is sliced.
      PlacedShapes<dim> here, there;
      for (const auto& [shape, pose] :
           {std::pair{&pair.a, &pair.pose_a}, {&pair.b, &pair.pose_b}}) {
        for (auto& vertex : shape->vertices) vertex = on_units<dim>((*pose)(vertex));
        here.add(convex(*shape), pose->position);
        for (auto& vertex : shape->vertices) vertex += move;
        there.add(convex(*shape), pose->position + move);
      }
      const double reach = 1e-3, tolerance = 1e-12;  // as above
      const Answer<dim> near = ask<typename C::Detector, dim>(here, reach),
                        far = ask<typename C::Detector, dim>(there, reach);
      if (std::abs(near.separation) < tolerance || std::abs(near.separation - reach) < tolerance)
        continue;
      CHECK((far.touch == Touch::none) == (near.touch == Touch::none));
      if (near.touch == Touch::none) continue;
      ++touching;
      CHECK(std::abs(far.separation - near.separation) < tolerance);
    }
    CHECK(touching > 300);
  }

  TEST_CASE_TEMPLATE("a search finds at the site what it finds at the origin", C, Face2, Face3) {
    constexpr int dim = C::dim;
    // Rows of unit cubes that touch exactly, 300 m long: across several grid points.
    std::vector<Vec<dim>> places;
    for (int row = 0; row < 2; ++row)
      for (int k = 0; k < 300; ++k) {
        Vec<dim> place = Vec<dim>::Zero();
        place[0] = k + 0.25 * row;
        place[1] = row;
        places.push_back(place);
      }
    PlainShape<dim> block;
    if constexpr (dim == 2)
      block = plain(rectangle(1, 1));
    else
      block = prism(rectangle(1, 1), Vec3(0, 0, 1));
    const auto count = [&](const Vec<dim>& move) {
      PlacedShapes<dim> shapes;
      for (const Vec<dim>& place : places) {
        shapes.add(convex(block), Vec<dim>::Zero());
        shapes.place(shapes.size() - 1, {place + move, Rotation<dim>::Identity()});
      }
      ContactSearch<FaceContacts, dim> search(0, 0);
      double measure = 0;
      const auto& found = search.run(shapes);
      for (std::size_t k = 0; k < found.size(); ++k) measure += found[k].measure;
      return measure;
    };
    // In each row 299 whole sides, between the rows 299.75 m.
    CHECK(count(Vec<dim>::Zero()) == 2 * 299 + 299.75);
    CHECK(count(site<dim>({4.1e5, 5.7e6, 1.2e3})) == 2 * 299 + 299.75);
  }
}

}  // namespace site_coordinates_test
