// SPDX-License-Identifier: MIT
// Contacts say nothing about the order in which rock was cut: not in the mirror, where an opening
// is cut out along other lines, nor with the joints in another order.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/model/joined_contacts.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/transformed.hpp"

namespace mirrored_contacts_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

/// A contact by its moments.
template <int Dim>
struct Moments {
  Vec<Dim> area;   ///< vector, out of the body with the lower number
  Vec<Dim> place;  ///< of the centroid
  Eigen::Matrix<double, Dim, Dim> second;
  std::size_t facets = 1;
};

template <int Dim, class Area>
Moments<Dim> moments_of(const Area& area, double sign) {
  Moments<Dim> m{sign * area.area_vector(), area.centre(), {}};
  m.second.setZero();
  for (const auto& p : area.gauss_points()) m.second += p.weight * p.offset * p.offset.transpose();
  if constexpr (requires { area.facets(); }) m.facets = area.facets().size();
  return m;
}

/// All contacts of a mass by their two bodies, the lower number first; with the edges of the domain
/// by the body and -1 - side. There is but one of two blocks, for they were convex.
template <int Dim>
using Contacts = std::map<std::pair<int, int>, Moments<Dim>>;

template <class Detector, class Geometry>
Contacts<Geometry::dim> contacts_of(const RockMass<Geometry>& mass) {
  constexpr int dim = Geometry::dim;
  Contacts<dim> contacts;
  visit_joined(
      Detector::find(mass), mass.domain.tolerance(), [](int) { return 0; },
      [&](int a, int b, const auto& area, int) {
        const bool added =
            contacts.emplace(std::minmax(a, b), moments_of<dim>(area, a < b ? 1 : -1)).second;
        CHECK(added);
      });
  visit_joined(boundary_facets(mass), [&](int body, SideOf<dim> side, const auto& area) {
    const std::pair key(body, -1 - static_cast<int>(side));
    CHECK(contacts.emplace(key, moments_of<dim>(area, 1)).second);
  });
  return contacts;
}

/// True if the contacts of one mass are the images of those of the other.
/// @param bound  of area vectors, places and second moments [m], [m^2], [m^3], [m^4]
/// @return  contacts of several facets of which one has others than its image
template <int Dim, class Geometry>
std::size_t check_images(const RockMass<Geometry>& mass, const RockMass<Geometry>& image,
                         const Transform<Dim>& map, double bound) {
  const std::vector<int> twin = twins(mass, image, map);
  REQUIRE(image.bodies.size() == mass.bodies.size());
  REQUIRE(std::find(twin.begin(), twin.end(), -1) == twin.end());
  const auto these = contacts_of<CutContacts>(mass), those = contacts_of<CutContacts>(image);
  CHECK(these.size() == those.size());
  std::size_t divided_otherwise = 0;
  double worst = 0;
  for (const auto& [bodies, contact] : these) {
    const int a = twin[static_cast<std::size_t>(bodies.first)];
    if (bodies.second < 0) {
      // Which side it is of the image, its area tells.
      bool found = false;
      for (int side = 0; side < 2 * Dim; ++side) {
        const auto it = those.find({a, -1 - side});
        found = found ||
                (it != those.end() && (it->second.area - map.turn * contact.area).norm() < bound &&
                 (it->second.place - map(contact.place)).norm() < bound);
      }
      CHECK(found);
      continue;
    }
    const int b = twin[static_cast<std::size_t>(bodies.second)];
    const auto it = those.find(std::minmax(a, b));
    REQUIRE(it != those.end());
    const Moments<Dim>& other = it->second;
    worst = std::max(worst, (other.area - (a < b ? 1 : -1) * map.turn * contact.area).norm());
    worst = std::max(worst, (other.place - map(contact.place)).norm());
    worst =
        std::max(worst, (other.second - map.turn * contact.second * map.turn.transpose()).norm());
    if (other.facets != contact.facets) ++divided_otherwise;
  }
  CHECK(worst < bound);
  return divided_otherwise;
}

}  // namespace

TEST_SUITE("rockmass/mirrored_contacts") {
  TEST_CASE("2-D rock with openings, mirrored and moved: the mirrored contacts") {
    std::size_t divided_otherwise = 0;
    const auto circle = circular_opening(5, 36), horseshoe = horseshoe_opening(4, 2, 24);
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      for (const SimplePolygon& opening : {circle, horseshoe}) {
        CAPTURE(seed);
        const auto ground = domain_around(opening, 16, 5, 5);
        const auto joints = joint_network(paper_sets(), ground, seed);
        const auto carved = [&](const Transform<2>& map) {
          return carve(slice(map(ground), moved(joints, map), {0.25, 5}), moved(opening, map),
                       0.074);
        };
        const auto mass = carved({});
        // Coordinates of 10 m, and of 10 km, rounded; where an edge of the outline meets a joint at
        // a degree, a hundred times that.
        divided_otherwise += check_images(mass, carved(mirrored_2d()), mirrored_2d(), 1e-12);
        const Transform<2> far = mirrored_2d({12347.7, -9876.3});
        (void)check_images(mass, carved(far), far, 1e-9);
      }
    // What this is about: without joining, these would be other contacts.
    CHECK(divided_otherwise > 20);
  }

  TEST_CASE("3-D rock with a chamber, mirrored, and turned about the vertical") {
    const Domain<3> ground{{-5, -5, -5}, {5, 5, 5}};
    Transform<3> across{Eigen::Vector3d(-1, 1, 1).asDiagonal(), Vec3::Zero()},
        quarter{Eigen::Matrix3d::Zero(), {31.7, -8.3, 1.9}};
    quarter.turn(0, 1) = -1;
    quarter.turn(1, 0) = quarter.turn(2, 2) = 1;
    std::size_t divided_otherwise = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      const auto joints = joint_network(three_sets(1.6, DiscJoints{6}), ground, seed);
      const auto carved = [&](const Transform<3>& map) {
        const Domain<3> hollow = map(Domain<3>{{-1.7, -2.4, -1.5}, {1.6, 2.2, 1.4}});
        const Vec3 &a = hollow.low, &b = hollow.high;
        return carve(
            slice<Spatial>(map(ground), moved(joints, map), {0.1, 10}),
            PrismaticOpening(
                SimplePolygon({{a.x(), a.z()}, {b.x(), a.z()}, {b.x(), b.z()}, {a.x(), b.z()}}),
                a.y(), b.y()),
            0.001);
      };
      const auto mass = carved({});
      for (const Transform<3>& map : {across, quarter})
        divided_otherwise += check_images(mass, carved(map), map, 1e-11);
    }
    CHECK(divided_otherwise > 10);
  }

  TEST_CASE("joints cut in another order: the same contacts of the same blocks") {
    const auto opening = circular_opening(5, 36);
    const auto ground = domain_around(opening, 12, 4, 4);
    Random random(1);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      // Joints without ends and without limits on blocks make the same blocks in any order.
      auto joints = joint_network(paper_sets(2), ground, seed);
      joints.resize(60);
      for (Joint& j : joints) {
        const Vec2 along = 100 * (j.trace.end - j.trace.start).normalized();
        j.trace = {j.trace.centre() - along, j.trace.centre() + along};
      }
      const auto mass = carve(slice(ground, joints, {}), opening, 0);
      for (int trial = 0; trial < 3; ++trial) {
        random.shuffle(joints);
        const auto image = carve(slice(ground, joints, {}), opening, 0);
        // Corners of slivers between nearly parallel joints.
        (void)check_images(mass, image, Transform<2>{}, 1e-8);
      }
    }
  }

  TEST_CASE("contacts that a search finds are joined like those from the cuts") {
    const auto opening = circular_opening(5, 36);
    const auto ground = domain_around(opening, 16, 5, 5);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto mass = carve(jointed_rock(ground, seed), opening, 0.074);
      const auto known = contacts_of<CutContacts>(mass), found = contacts_of<FaceContacts>(mass);
      std::size_t joined = 0;
      for (const auto& [bodies, contact] : known) {
        const auto it = found.find(bodies);
        REQUIRE(it != found.end());
        // Facets differ by the tolerances of the two, 1e-8 m.
        CHECK((it->second.area - contact.area).norm() < 1e-7);
        CHECK((it->second.second - contact.second).norm() < 1e-7);
        joined += contact.facets > 1 ? 1 : 0;
      }
      CHECK(joined > 5);
    }
  }
}

}  // namespace mirrored_contacts_test
