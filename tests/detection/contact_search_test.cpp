// SPDX-License-Identifier: MIT
// Many shapes at once: the neighbour list against all pairs of boxes, the search against all pairs
// of shapes, and the contacts of a sliced mass against those that the cuts know.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/detection/analytic_centre.hpp>
#include <voussoir/detection/contact_search.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace contact_search_test {

using namespace voussoir;

namespace {

constexpr double deg = std::numbers::pi / 180;

RockMass<Planar> plane_rock() {
  const Domain<2> ground{{-8, -8}, {8, 8}};
  const std::vector<JointSet> sets{{"J1", 75 * deg, DipDirection::east, 1 * deg, 1, 0, 3},
                                   {"J2", 25 * deg, DipDirection::east, 1 * deg, 1, 0, 3},
                                   {"J3", 25 * deg, DipDirection::west, 1 * deg, 1, 0, 3}};
  return slice(ground, joint_network(sets, ground, 1), {0.1, 8});
}

RockMass<Spatial> space_rock() {
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
}

/// The blocks of a mass, each its own shape; `order`: which body is shape 0, 1, ...
template <class Geometry>
PlacedShapes<Geometry::dim> shapes_of(const RockMass<Geometry>& mass,
                                      const std::vector<std::size_t>& order) {
  PlacedShapes<Geometry::dim> shapes;
  for (const std::size_t b : order)
    shapes.add(mass.bodies[b].parts.front(), mass.bodies[b].properties.centroid);
  return shapes;
}

/// Moves every body at random by about `shift`; body b gets the same motion whatever its number.
template <class Geometry>
void shake(PlacedShapes<Geometry::dim>& shapes, const RockMass<Geometry>& mass,
           const std::vector<std::size_t>& order, double shift, std::uint64_t seed) {
  constexpr int dim = Geometry::dim;
  for (std::size_t k = 0; k < order.size(); ++k) {
    Random random(seed, order[k]);
    Pose<dim> pose;
    pose.position = mass.bodies[order[k]].properties.centroid;
    for (int axis = 0; axis < dim; ++axis) pose.position[axis] += shift * random.normal();
    Spin<dim> spin;
    for (int axis = 0; axis < spin_count<dim>; ++axis) spin[axis] = shift * random.normal();
    pose.rotation = rotation_by(spin);
    shapes.place(k, pose);
  }
}

std::vector<std::size_t> numbers(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

/// A contact in full, with bodies by their numbers in the mass: comparable bit for bit.
using Line = std::tuple<std::size_t, std::size_t, int, std::vector<double>>;

template <int Dim>
std::vector<Line> lines(const ContactList<Dim>& contacts, const std::vector<std::size_t>& order) {
  std::vector<Line> all;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto& item = contacts[k];
    std::vector<double> values{item.separation, item.measure};
    values.insert(values.end(), item.normal.begin(), item.normal.end());
    for (const auto& point : contacts.polygon(k))
      values.insert(values.end(), point.begin(), point.end());
    all.emplace_back(order[item.a], order[item.b], static_cast<int>(item.touch), values);
  }
  return all;
}

template <class Geometry>
RockMass<Geometry> rock() {
  if constexpr (Geometry::dim == 2) {
    return plane_rock();
  } else {
    return space_rock();
  }
}

/// Total contact area of each pair of bodies.
template <class Geometry>
std::map<std::pair<int, int>, double> areas(const std::vector<ContactFacet<Geometry>>& contacts) {
  std::map<std::pair<int, int>, double> sums;
  for (const auto& contact : contacts)
    sums[std::minmax(contact.a, contact.b)] += contact.facet.measure();
  return sums;
}

template <int Dim>
Box<Dim> box_of(const PlacedShapes<Dim>& shapes, std::size_t k) {
  return bounding_box<Dim>(shapes, k, Vec<Dim>::Zero());
}

}  // namespace

TEST_SUITE("detection/contact_search") {
  TEST_CASE_TEMPLATE("the neighbour list is all pairs of boxes nearer than reach and margin",
                     Geometry, Planar, Spatial) {
    constexpr int dim = Geometry::dim;
    const auto mass = rock<Geometry>();
    const auto order = numbers(mass.bodies.size());
    auto shapes = shapes_of(mass, order);
    for (const double margin : {0.0, 0.05})
      for (const double reach : {0.0, 0.02}) {
        NeighbourList<dim> list(margin, reach);
        CHECK(list.update(shapes));
        CHECK_FALSE(list.update(shapes));
        std::set<std::pair<std::uint32_t, std::uint32_t>> expected, found;
        for (std::uint32_t i = 0; i < shapes.size(); ++i)
          for (std::uint32_t j = i + 1; j < shapes.size(); ++j) {
            const auto a = box_of(shapes, i), b = box_of(shapes, j);
            bool near = true;
            // A rounding more or less: boxes of neighbours on one joint touch exactly.
            for (int axis = 0; axis < dim; ++axis)
              near = near && a.low[axis] - 1e-12 <= b.high[axis] + margin + reach &&
                     b.low[axis] - 1e-12 <= a.high[axis] + margin + reach;
            if (near) expected.emplace(i, j);
          }
        for (const auto& pair : list.pairs())
          CHECK(found.emplace(std::min(pair.a, pair.b), std::max(pair.a, pair.b)).second);
        for (const auto& pair : found) CHECK(expected.count(pair) == 1);
        for (const auto& [i, j] : expected) {
          if (found.count({i, j}) == 1) continue;
          // Missing only where the rounding decides.
          const auto a = box_of(shapes, i), b = box_of(shapes, j);
          CHECK_FALSE(a.meets(b, margin + reach - 1e-12));
        }
      }
  }

  TEST_CASE("one box over all others, and boxes that are points, are found as well") {
    PlacedShapes<2> shapes;
    const std::vector<int> cuts(3, 0);
    shapes.add(ConvexPolygon({{-50, -50}, {50, -50}, {0, 80}}, cuts), Vec2(0, 0));
    for (int k = 0; k < 30; ++k) {
      const Vec2 p(k - 15.0, 0.1 * k);
      shapes.add(ConvexPolygon({p, p + Vec2(1e-9, 0), p + Vec2(0, 1e-9)}, cuts), p);
    }
    NeighbourList<2> list(0);
    list.update(shapes);
    CHECK(list.pairs().size() == 30);
  }

  TEST_CASE_TEMPLATE("the list holds until a shape leaves its box by half the margin", Geometry,
                     Planar, Spatial) {
    constexpr int dim = Geometry::dim;
    const auto mass = rock<Geometry>();
    const auto order = numbers(mass.bodies.size());
    auto shapes = shapes_of(mass, order);
    NeighbourList<dim> list(0.02);
    list.update(shapes);
    Pose<dim> pose;
    pose.position = mass.bodies[7].properties.centroid + Vec<dim>::Constant(0.0099);
    shapes.place(7, pose);
    CHECK_FALSE(list.update(shapes));
    pose.position = mass.bodies[7].properties.centroid + Vec<dim>::Constant(0.0101);
    shapes.place(7, pose);
    CHECK(list.update(shapes));
  }

  TEST_CASE_TEMPLATE("the search finds what all pairs one by one give", Geometry, Planar, Spatial) {
    constexpr int dim = Geometry::dim;
    const auto mass = rock<Geometry>();
    const auto order = numbers(mass.bodies.size());
    auto shapes = shapes_of(mass, order);
    shake(shapes, mass, order, 1e-3, 1);
    ContactSearch<FaceContacts, dim> search(1e-4, 0.01);
    const auto& found = search.run(shapes);
    CHECK(found.size() > mass.bodies.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> separations;
    for (std::size_t k = 0; k < found.size(); ++k)
      separations[std::minmax(found[k].a, found[k].b)] = found[k].separation;
    CHECK(separations.size() == found.size());
    FaceContacts::Pair<dim> pair(shapes);
    std::size_t touching = 0;
    for (std::uint32_t i = 0; i < shapes.size(); ++i)
      for (std::uint32_t j = i + 1; j < shapes.size(); ++j) {
        if (!box_of(shapes, i).meets(box_of(shapes, j), 1e-4)) continue;
        typename FaceContacts::Pair<dim>::Memory memory;
        const auto contact = pair.contact(i, j, memory, 1e-4);
        const auto known = separations.find({i, j});
        CHECK((contact.touch != Touch::none) == (known != separations.end()));
        if (contact.touch == Touch::none || known == separations.end()) continue;
        ++touching;
        // The roles of the two may be exchanged: roundings differ.
        CHECK(std::abs(contact.separation - known->second) < 1e-12);
      }
    CHECK(touching == found.size());
  }

  TEST_CASE_TEMPLATE("threads, numbers and what is remembered change no bit", Geometry, Planar,
                     Spatial) {
    constexpr int dim = Geometry::dim;
    const auto mass = rock<Geometry>();
    const auto order = numbers(mass.bodies.size());
    auto shapes = shapes_of(mass, order);
    shake(shapes, mass, order, 1e-3, 1);
    ContactSearch<FaceContacts, dim> first(1e-4, 0.01);
    first.run(shapes);
    shake(shapes, mass, order, 1e-3, 2);
    const auto expected = lines(first.run(shapes), order);  // with memories of another position
    for (const unsigned threads : {1U, 2U, 3U, 5U}) {
      ContactSearch<FaceContacts, dim> search(1e-4, 0.01);
      CHECK(lines(search.run(shapes, threads), order) == expected);
    }
    auto shuffled = order;
    Random(3).shuffle(shuffled);
    auto renumbered = shapes_of(mass, shuffled);
    shake(renumbered, mass, shuffled, 1e-3, 2);
    ContactSearch<FaceContacts, dim> search(1e-4, 0.01);
    auto found = lines(search.run(renumbered, 2), shuffled), sorted = expected;
    std::sort(found.begin(), found.end());
    std::sort(sorted.begin(), sorted.end());
    CHECK(found == sorted);
  }

  TEST_CASE_TEMPLATE("the contacts of a mass are those that its cuts know", Geometry, Planar,
                     Spatial) {
    const auto mass = rock<Geometry>();
    const auto expected = areas(CutContacts::find(mass));
    const auto found = areas(FaceContacts::find(mass));
    CHECK(expected.size() > mass.bodies.size());
    CHECK(found.size() == expected.size());
    for (const auto& entry : expected) {
      const std::pair<int, int> pair = entry.first;
      const double area = entry.second;
      CAPTURE(pair.first);
      CAPTURE(pair.second);
      // Faces of 1 m whose vertices are welded: a few roundings.
      CHECK(found.count(pair) == 1);
      if (found.count(pair) == 1) CHECK(std::abs(found.at(pair) - area) < 1e-12);
    }
  }

  TEST_CASE("round an opening too, where bodies have several parts") {
    const auto mass = carve(plane_rock(), circular_opening(6), 0.05);
    const auto expected = areas(CutContacts::find(mass)), found = areas(FaceContacts::find(mass));
    CHECK(std::any_of(mass.bodies.begin(), mass.bodies.end(),
                      [](const auto& body) { return body.parts.size() > 1; }));
    CHECK(found.size() == expected.size());
    for (const auto& [pair, length] : expected) {
      CHECK(found.count(pair) == 1);
      if (found.count(pair) == 1) CHECK(std::abs(found.at(pair) - length) < 1e-12);
    }
  }

  TEST_CASE_TEMPLATE("facets point from a to b", Geometry, Planar, Spatial) {
    const auto mass = rock<Geometry>();
    for (const auto& contact : FaceContacts::find(mass)) {
      const auto from = mass.bodies[static_cast<std::size_t>(contact.a)].properties.centroid;
      const auto to = mass.bodies[static_cast<std::size_t>(contact.b)].properties.centroid;
      // Convex blocks on the two sides of a plane.
      CHECK(contact.facet.area_vector().dot(to - contact.facet.centre()) > 0);
      CHECK(contact.facet.area_vector().dot(from - contact.facet.centre()) < 0);
    }
  }

  TEST_CASE("any pair detector serves: the analytic centre finds the same overlapping pairs") {
    const auto mass = plane_rock();
    const auto order = numbers(mass.bodies.size());
    auto shapes = shapes_of(mass, order);
    shake(shapes, mass, order, 1e-3, 1);
    ContactSearch<FaceContacts, 2> faces(0, 0);
    ContactSearch<AnalyticCentre, 2> centres(0, 0);
    const auto &a = faces.run(shapes), &b = centres.run(shapes);
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) CHECK((a[k].a == b[k].a && a[k].b == b[k].b));
  }

  TEST_CASE("a margin, a reach or a coordinate that is no length is refused") {
    CHECK_THROWS_AS(NeighbourList<2>(-1), InvalidInput);
    CHECK_THROWS_AS(NeighbourList<2>(0, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
    PlacedShapes<2> none;
    ContactSearch<FaceContacts, 2> search(0, 0);
    CHECK(search.run(none).size() == 0);
  }
}

}  // namespace contact_search_test
