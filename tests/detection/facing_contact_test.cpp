// SPDX-License-Identifier: MIT
// What a model asks of its contact detector: the same faces and areas whichever detector answers,
// on rock as it was sliced; how often they differ where blocks have moved; and what the concept
// promises beyond what a compiler can check.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/detection/analytic_centre.hpp>
#include <voussoir/detection/contact_detector.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/detection/neighbour_list.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "support/pairs.hpp"

namespace facing_contact_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

constexpr double deg = std::numbers::pi / 180;

template <class Geometry>
const RockMass<Geometry>& rock() {
  if constexpr (Geometry::dim == 2) {
    static const RockMass<Planar> mass = [] {
      const Domain<2> ground{{-8, -8}, {8, 8}};
      const std::vector<JointSet> sets{{"J1", 75 * deg, DipDirection::east, 1 * deg, 1, 0, 3},
                                       {"J2", 25 * deg, DipDirection::east, 1 * deg, 1, 0, 3},
                                       {"J3", 25 * deg, DipDirection::west, 1 * deg, 1, 0, 3}};
      return slice(ground, joint_network(sets, ground, 1), {0.1, 8});
    }();
    return mass;
  } else {
    static const RockMass<Spatial> mass = [] {
      const Domain<3> ground{{-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5}};
      std::vector<SpatialJointSet> sets(3);
      const double dips[] = {75, 25, 60}, directions[] = {10, 130, 250};
      for (std::size_t k = 0; k < 3; ++k) {
        sets[k].name = "J" + std::to_string(k);
        sets[k].dip = dips[k] * deg;
        sets[k].dip_direction = directions[k] * deg;
        sets[k].dip_deviation = sets[k].dip_direction_deviation = 2 * deg;
        sets[k].area_per_volume = 1;
        sets[k].shape = DiscJoints{4};
      }
      return slice<Spatial>(ground, joint_network(sets, ground, 1), {0.05, 30});
    }();
    return mass;
  }
}

/// What a number is rounded to where it is moved to site coordinates and back.
constexpr double unit = 0x1p-29;

/// The blocks of a mass, moved at random by about `shift` and turned by about as many radians.
/// @param move  of all of them, in whole units [m]
template <class Geometry>
PlacedShapes<Geometry::dim> shaken(double shift, std::uint64_t seed,
                                   const Vec<Geometry::dim>& move) {
  constexpr int dim = Geometry::dim;
  PlacedShapes<dim> shapes;
  for (const auto& body : rock<Geometry>().bodies) {
    Vec<dim> origin = body.properties.centroid;
    for (int axis = 0; axis < dim; ++axis) origin[axis] = unit * std::round(origin[axis] / unit);
    shapes.add(body.parts.front(), origin);
    if (shift == 0 && move == zeros<Vec<dim>>()) continue;
    Random random(seed, shapes.size());
    Pose<dim> pose;
    pose.position = origin + move;
    Spin<dim> spin = zeros<Spin<dim>>();
    for (int axis = 0; axis < dim && shift > 0; ++axis)
      pose.position[axis] += unit * std::round(shift * random.normal() / unit);
    for (int axis = 0; axis < spin_count<dim>; ++axis) spin[axis] = shift * random.normal();
    pose.rotation = rotation_by(spin);
    shapes.place(shapes.size() - 1, pose);
  }
  return shapes;
}
template <class Geometry>
PlacedShapes<Geometry::dim> shaken(double shift, std::uint64_t seed = 1) {
  return shaken<Geometry>(shift, seed, zeros<Vec<Geometry::dim>>());
}

template <int Dim>
std::vector<typename NeighbourList<Dim>::Pair> near_pairs(const PlacedShapes<Dim>& shapes,
                                                          double reach) {
  NeighbourList<Dim> list(0, reach);
  list.update(shapes);
  return list.pairs();
}

/// A contact in numbers that outlive the detector.
template <int Dim>
struct Found {
  Touch touch;
  Vec<Dim> normal;
  double separation, measure;
  std::vector<Vec<Dim>> polygon;

  explicit Found(const Contact<Dim>& c)
      : touch(c.touch),
        normal(c.normal),
        separation(c.separation),
        measure(c.measure),
        polygon(c.polygon.begin(), c.polygon.end()) {}

  [[nodiscard]] bool touches() const { return touch != Touch::none; }
  friend bool operator==(const Found&, const Found&) = default;
};

template <class Detector, int Dim>
Found<Dim> facing(const PlacedShapes<Dim>& shapes, std::size_t a, std::size_t b, double reach) {
  typename Detector::template Pair<Dim> pair(shapes);
  typename Detector::template Pair<Dim>::Memory memory;
  return Found<Dim>(pair.facing_contact(a, b, memory, reach));
}

/// How far the points of a polygon are from the nearest of another at most [m].
template <int Dim>
double difference(const std::vector<Vec<Dim>>& from, const std::vector<Vec<Dim>>& to) {
  double worst = 0;
  for (const Vec<Dim>& x : from) {
    double least = 1e300;
    for (const Vec<Dim>& y : to) least = std::min(least, (x - y).norm());
    worst = std::max(worst, least);
  }
  return worst;
}

template <int Dim>
PlacedShapes<Dim> placed_pair(const PlainPair<Dim>& pair) {
  PlacedShapes<Dim> shapes;
  shapes.add(convex(pair.a), Vec<Dim>::Zero());
  shapes.add(convex(pair.b), Vec<Dim>::Zero());
  shapes.place(0, pair.pose_a);
  shapes.place(1, pair.pose_b);
  return shapes;
}

template <class Detector_, class Geometry_>
struct Case {
  using Detector = Detector_;
  using Geometry = Geometry_;
  static constexpr int dim = Geometry::dim;
};
#define EVERY_CASE                                                                       \
  Case<FaceContacts, Planar>, Case<FaceContacts, Spatial>, Case<AnalyticCentre, Planar>, \
      Case<AnalyticCentre, Spatial>

static_assert(PairDetector<FaceContacts, 2> && PairDetector<FaceContacts, 3>);
static_assert(PairDetector<AnalyticCentre, 2> && PairDetector<AnalyticCentre, 3>);

}  // namespace

TEST_SUITE("detection/facing_contact") {
  TEST_CASE_TEMPLATE("rock as sliced: the faces and areas of the cuts, here and far away", C,
                     EVERY_CASE) {
    constexpr int dim = C::dim;
    using Geometry = typename C::Geometry;
    // In multiples of the unit: the blocks are the same in both places.
    Vec<dim> site = zeros<Vec<dim>>();
    site[0] = 4.1e5;
    site[dim - 1] = 5.7e6;
    const double reach = 1e-3;
    std::map<std::pair<int, int>, ContactFacet<Geometry>> expected;
    for (const auto& contact : CutContacts::find(rock<Geometry>())) {
      REQUIRE(contact.facet.measure() > 0);
      // Two convex blocks have one facet in common.
      CHECK(expected.emplace(std::minmax(contact.a, contact.b), contact).second);
    }
    for (const Vec<dim>& move : {Vec<dim>(zeros<Vec<dim>>()), site}) {
      const auto shapes = shaken<Geometry>(0, 1, move);
      typename C::Detector::template Pair<dim> pair(shapes);
      std::size_t known = 0;
      for (const auto& both : near_pairs<dim>(shapes, reach)) {
        const auto a = both.a, b = both.b;  // clang 14 captures no bindings
        const auto entry = expected.find(std::minmax(static_cast<int>(a), static_cast<int>(b)));
        if (entry == expected.end()) continue;
        ++known;
        CAPTURE(a);
        CAPTURE(b);
        const auto& cut = entry->second;
        const double area = cut.facet.measure();
        typename C::Detector::template Pair<dim>::Memory memory;
        const auto found = pair.facing_contact(a, b, memory, reach);
        REQUIRE((found.touch == Touch::face_a || found.touch == Touch::face_b));
        // Faces of 1 m whose vertices are welded: a few roundings.
        CHECK(std::abs(found.measure - area) < 1e-12);
        CHECK(std::abs(found.measure - area) < 1e-9 * area);
        CHECK(std::abs(found.separation) < 1e-12);
        const Vec<dim> normal = cut.facet.area_vector() / area;
        CHECK((found.normal - (cut.a == static_cast<int>(a) ? 1.0 : -1.0) * normal).norm() < 1e-9);
        const Vec<dim> place = cut.facet.centre() - (shapes.grid_point(a) - move);
        for (const auto& point : found.polygon) CHECK(std::abs(normal.dot(point - place)) < 1e-12);
      }
      CHECK(known == expected.size());
    }
  }

  TEST_CASE_TEMPLATE("the initial contacts of AnalyticCentre are those of the cuts", Geometry,
                     Planar, Spatial) {
    std::map<std::pair<int, int>, double> expected, found;
    for (const auto& contact : CutContacts::find(rock<Geometry>()))
      expected[std::minmax(contact.a, contact.b)] += contact.facet.measure();
    for (const auto& contact : AnalyticCentre::find(rock<Geometry>())) {
      found[std::minmax(contact.a, contact.b)] += contact.facet.measure();
      const auto from = rock<Geometry>().bodies[static_cast<std::size_t>(contact.a)];
      CHECK(contact.facet.area_vector().dot(contact.facet.centre() - from.properties.centroid) > 0);
    }
    CHECK(expected.size() > rock<Geometry>().bodies.size());
    REQUIRE(found.size() == expected.size());
    for (const auto& [pair, area] : expected) {
      CHECK(found.count(pair) == 1);
      CHECK(std::abs(found[pair] - area) < 1e-12);
    }
  }

  TEST_CASE_TEMPLATE("blocks that have moved: where the two detectors name the same", Geometry,
                     Planar, Spatial) {
    constexpr int dim = Geometry::dim;
    for (const double shift : {1e-4, 2e-2}) {
      CAPTURE(shift);
      const double reach = 1e-3;
      const auto shapes = shaken<Geometry>(shift);
      int touching = 0, by_centre_alone = 0, overlapping = 0, same = 0;
      for (const auto& both : near_pairs<dim>(shapes, reach)) {
        const auto a = both.a, b = both.b;  // clang 14 captures no bindings
        CAPTURE(a);
        CAPTURE(b);
        const auto faces = facing<FaceContacts, dim>(shapes, a, b, reach);
        const auto centre = facing<AnalyticCentre, dim>(shapes, a, b, reach);
        // Within reach by all axes is within reach by faces and by swelling.
        if (faces.touches()) CHECK(centre.touches());
        // The other way round not all: of two edges that keep the shapes further apart than any
        // face does it has no part in the decision.
        touching += centre.touches() ? 1 : 0;
        by_centre_alone += centre.touches() && !faces.touches() ? 1 : 0;
        if (!(faces.separation < -1e-9)) continue;
        ++overlapping;
        REQUIRE(centre.separation < 0);
        CHECK(centre.measure > 0);
        // No axis has less depth than the least.
        CHECK(centre.separation <= faces.separation + 1e-12);
        if (centre.touch == faces.touch && (centre.normal - faces.normal).norm() < 0.1 &&
            std::abs(centre.measure - faces.measure) <= 1e-9 * faces.measure)
          ++same;
      }
      MESSAGE(dim << "-D, " << shift << " m: " << same << " of " << overlapping
                  << " overlapping pairs the same");
      CHECK(overlapping > 300);
      // What is left are corners between corners, in 3-D where many faces are nearly as deep.
      CHECK(same >= (dim == 2 ? 0.99 : 0.95) * overlapping);
      CHECK(by_centre_alone <= (dim == 2 ? 0 : 0.01) * touching);
    }
  }

  TEST_CASE_TEMPLATE("(b, a) is (a, b) seen from the other side", C, EVERY_CASE) {
    constexpr int dim = C::dim;
    using Geometry = typename C::Geometry;
    for (const double shift : {0.0, 1e-4, 2e-2}) {
      CAPTURE(shift);
      const auto shapes = shaken<Geometry>(shift);
      int touching = 0;
      for (const auto& both : near_pairs<dim>(shapes, 1e-3)) {
        const auto a = both.a, b = both.b;  // clang 14 captures no bindings
        CAPTURE(a);
        CAPTURE(b);
        const auto found = facing<typename C::Detector, dim>(shapes, a, b, 1e-3);
        const auto turned = facing<typename C::Detector, dim>(shapes, b, a, 1e-3);
        REQUIRE(found.touches() == turned.touches());
        if (!found.touches()) continue;
        ++touching;
        // Areas and normals are the same whichever of two welded faces is the reference.
        CHECK(std::abs(found.separation - turned.separation) < 1e-12);
        const bool corners = shift == 0 && found.measure < 1e-9;
        if (corners) continue;  // faces, edges and corners all touch at depth 0
        CHECK((found.normal + turned.normal).norm() < 1e-9);
        CHECK(std::abs(found.measure - turned.measure) < 1e-11);
        if (shift == 0) continue;
        const auto swapped = [](Touch t) {
          return t == Touch::face_a ? Touch::face_b : t == Touch::face_b ? Touch::face_a : t;
        };
        CHECK(swapped(found.touch) == turned.touch);
        for (auto* one : {&found, &turned}) {
          const auto& other = one == &found ? turned : found;
          CHECK(difference<dim>(one->polygon, other.polygon) < 1e-9);
        }
      }
      CHECK(touching > 500);
    }
  }

  TEST_CASE_TEMPLATE("memory changes the cost of an answer, not the answer", C, EVERY_CASE) {
    constexpr int dim = C::dim;
    using Geometry = typename C::Geometry;
    using Detector = typename C::Detector;
    const double reach = 1e-3;
    const auto first = shaken<Geometry>(1e-4);
    const auto pairs = near_pairs<dim>(first, 5e-3);
    std::vector<typename Detector::template Pair<dim>::Memory> memories(pairs.size());
    int touching = 0, apart = 0, changed = 0;
    std::vector<bool> touched(pairs.size());
    // Back and forth: what touches parts, and what is apart comes near again.
    for (const double shift : {1e-4, 1.1e-4, 2e-3, 1e-4, 0.0, 1e-3}) {
      CAPTURE(shift);
      const auto shapes = shaken<Geometry>(shift, shift == 1e-3 ? 2 : 1);
      typename Detector::template Pair<dim> pair(shapes);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto a = pairs[k].a, b = pairs[k].b;
        CAPTURE(a);
        CAPTURE(b);
        const Found<dim> warm(pair.facing_contact(a, b, memories[k], reach));
        const auto cold = facing<Detector, dim>(shapes, a, b, reach);
        REQUIRE(warm.touches() == cold.touches());
        changed += warm.touches() != touched[k] ? 1 : 0;
        touched[k] = warm.touches();
        ++(warm.touches() ? touching : apart);
        if constexpr (std::is_same_v<Detector, FaceContacts>) {
          if (warm.touches()) CHECK(warm == cold);
        } else if (warm.touches() && shift > 0) {
          CHECK(warm.touch == cold.touch);
          CHECK((warm.normal - cold.normal).norm() < 1e-9);
          CHECK(std::abs(warm.separation - cold.separation) < 1e-12);
          CHECK(std::abs(warm.measure - cold.measure) < 1e-11);
        }
      }
    }
    CHECK(touching > 3000);
    CHECK(apart > 500);
    CHECK(changed > 500);
  }

  TEST_CASE_TEMPLATE("FaceContacts: what separation and then contact_near give, bit for bit",
                     Geometry, Planar, Spatial) {
    constexpr int dim = Geometry::dim;
    const double reach = 1e-3;
    struct State {
      typename FaceContacts::Pair<dim>::Memory memory, before;
      bool known = false;
    };
    const auto pairs = near_pairs<dim>(shaken<Geometry>(1e-4), 5e-3);
    std::vector<State> states(pairs.size());
    for (const double shift : {1e-4, 1.1e-4, 2e-3, 1e-4, 0.0, 1e-3}) {
      const auto shapes = shaken<Geometry>(shift, shift == 1e-3 ? 2 : 1);
      FaceContacts::Pair<dim> pair(shapes);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto a = pairs[k].a, b = pairs[k].b;
        State& state = states[k];
        const bool near = state.known || pair.separation(a, b, state.before, reach) <= reach;
        Found<dim> expected{Contact<dim>{}};
        if (near) expected = Found<dim>(pair.contact_near(a, b, state.before, 1e6));
        state.known = expected.touches() && expected.separation <= reach;
        const Found<dim> found(pair.facing_contact(a, b, state.memory, reach));
        REQUIRE(found.touches() == state.known);
        if (state.known) CHECK(found == expected);
      }
    }
  }

  TEST_CASE_TEMPLATE("hard pairs: near by an independent measure, and over the face named", C,
                     EVERY_CASE) {
    constexpr int dim = C::dim;
    constexpr bool by_centre = std::is_same_v<typename C::Detector, AnalyticCentre>;
    Random random(11);
    int touching = 0, apart = 0;
    for (int trial = 0; trial < (dim == 2 ? 4000 : 600); ++trial) {
      CAPTURE(trial);
      const auto pair = random_pair<dim>(random);
      const auto shapes = placed_pair(pair);
      const double exact = static_cast<double>(
          separating_axes(long_shape(pair.a, pair.pose_a), long_shape(pair.b, pair.pose_b)).value);
      const double reach = random.below(2) == 0 ? 1e-3 : 1e-6;
      // Planes are rounded by 1e-14 m at 100 m, and corners of 1e-4 rad are among the shapes.
      if (std::abs(exact) < 5e-10 || std::abs(exact - reach) < 5e-10) continue;
      CAPTURE(exact);
      const auto found = facing<typename C::Detector, dim>(shapes, 0, 1, reach);
      // Apart, the axes beyond doubt count: edges that are nearly parallel have one that is not.
      const double sure =
          exact < 0 ? exact
                    : static_cast<double>(separating_axes(long_shape(pair.a, pair.pose_a),
                                                          long_shape(pair.b, pair.pose_b), 1e-6L)
                                              .value);
      if (exact <= reach) CHECK(found.touches());
      if (!by_centre && sure > reach) CHECK_FALSE(found.touches());
      ++(found.touches() ? touching : apart);
      if (!found.touches()) continue;
      REQUIRE(found.touch != Touch::interior);
      CHECK(std::abs(found.normal.norm() - 1) < 1e-14);
      CHECK(found.separation <= exact + 1e-9);
      if (!by_centre) CHECK(found.separation >= sure - 1e-9);
      const bool of_a = found.touch == Touch::face_a;
      REQUIRE(shapes.grid_point(0) == shapes.grid_point(1));
      const PlacedShape<dim> reference = shapes[of_a ? 0 : 1], other = shapes[of_a ? 1 : 0];
      // The polygon lies on the other shape.
      for (const Vec<dim>& point : found.polygon)
        for (std::size_t k = 0; found.touch != Touch::edge_edge && k < other.face_count; ++k)
          CHECK(other.normal(k).dot(point) - other.offset(k) < 1e-9);
      if (found.touch == Touch::edge_edge || !by_centre) continue;
      const Vec<dim> outward = of_a ? found.normal : Vec<dim>(-found.normal);
      std::size_t face = 0;
      while (face < reference.face_count && reference.normal(face) != outward) ++face;
      REQUIRE(face < reference.face_count);
      double lowest = 1e300;
      for (std::size_t k = 0; k < other.vertex_count; ++k)
        lowest = std::min(lowest, outward.dot(other.vertex(k)) - reference.offset(face));
      CHECK(std::abs(found.separation - lowest) < 1e-12);
    }
    CHECK(touching > (dim == 2 ? 1500 : 200));
    CHECK(apart > (dim == 2 ? 500 : 50));
  }

  TEST_CASE_TEMPLATE("faces side by side: the length over both, as near as the reach", C,
                     EVERY_CASE) {
    constexpr int dim = C::dim;
    using V = Vec<dim>;
    const auto box = [](double height) {
      if constexpr (dim == 2)
        return plain(rectangle(1, height));
      else
        return prism(rectangle(1, height), Vec3(0, 0, 1));
    };
    // b is 0.5 m high beside a of 1 m, 0.4 m up: 0.35 m of its side lies over that of a.
    for (const double gap : {-1e-3, -1e-9, 0.0, 1e-9, 1e-4, 1e-2}) {
      CAPTURE(gap);
      PlainPair<dim> pair;
      pair.a = box(1);
      pair.b = box(0.5);
      pair.pose_b.position = (1 + gap) * V::UnitX() + 0.4 * V::UnitY();
      const auto shapes = placed_pair(pair);
      if (gap > 0)
        CHECK_FALSE(facing<typename C::Detector, dim>(shapes, 0, 1, 0.99 * gap).touches());
      const auto found = facing<typename C::Detector, dim>(shapes, 0, 1, 1.01 * std::abs(gap));
      REQUIRE(found.touches());
      CHECK(std::abs(found.separation - gap) < 1e-15);
      CHECK((found.normal - V::UnitX()).norm() < 1e-15);
      CHECK(std::abs(found.measure - 0.35) < 1e-15);
    }
  }

  TEST_CASE_TEMPLATE("a tip as far off as a face says, however blunt it is", Detector, FaceContacts,
                     AnalyticCentre) {
    // Every plane of both moved out by 0.586 of half the gap, the right-angled tip meets the face.
    for (const double gap : {1e-4, 0.1}) {
      const PlainShape<2> face = plain(rectangle(4, 1));
      const PlainShape<2> tip = plain({{0, 0.5 + gap}, {1, 1.5 + gap}, {-1, 1.5 + gap}});
      const auto shapes = placed_pair<2>({face, tip, {}, {}});
      CHECK_FALSE(facing<Detector, 2>(shapes, 0, 1, 0.9 * gap).touches());
      const auto found = facing<Detector, 2>(shapes, 0, 1, 1.1 * gap);
      REQUIRE(found.touch == Touch::face_a);
      CHECK(std::abs(found.separation - gap) < 1e-15);
      CHECK(found.normal == Vec2(0, 1));
      CHECK(std::abs(found.measure - 1) < 1e-12);  // one of its sides, however high
    }
  }

  TEST_CASE_TEMPLATE("a ridge across a ridge: edges that cross, with their own depth", Detector,
                     FaceContacts, AnalyticCentre) {
    // Cubes turned by 45 degrees about x and about y have ridges sqrt(1/2) above and below.
    const auto cube = prism(rectangle(1, 1), Vec3(0, 0, 1));
    for (const double depth : {1e-2, 1e-5, 1e-8}) {
      CAPTURE(depth);
      PlainPair<3> pair{cube, cube, {}, {}};
      pair.pose_a.rotation = rotation_by(Spin<3>(std::numbers::pi / 4, 0, 0));
      pair.pose_b.rotation = rotation_by(Spin<3>(0, std::numbers::pi / 4, 0));
      pair.pose_b.position = Vec3(0.1, -0.2, std::sqrt(2.0) - depth);
      const auto found = facing<Detector, 3>(placed_pair(pair), 0, 1, 1e-3);
      REQUIRE(found.touch == Touch::edge_edge);
      CHECK((found.normal - Vec3(0, 0, 1)).norm() < 1e-14);
      CHECK(std::abs(found.separation + depth) < 1e-14);
      // Half way down each ridge is as wide as the depth.
      CHECK(std::abs(found.measure - depth * depth) < 1e-14 * (1 + depth));
    }
  }
}

}  // namespace facing_contact_test
