// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/line_clip.hpp>
#include <voussoir/io/mass_picture.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "io/xml_check.hpp"
#include "support/jointed_mass.hpp"

namespace mass_picture_test {

using namespace voussoir;
using voussoir_test::jointed_mass;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Domain<3> ground{{-4, -3, -3}, {3, 4, 2}};

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// A block on a line of sight.
struct Sight {
  double distance;  ///< from the viewer
  int body;
};

/// The line of sight through a point of the picture, from the viewer.
SpatialLine sight_line(const AxonometricView& view, const Vec2& p) {
  const Vec3 at = p.x() * view.right() + p.y() * view.up();
  return {at + 100 * view.towards(), at - 100 * view.towards()};
}

/// Blocks along a line of sight, moved apart as in the picture, the nearest first.
std::vector<Sight> sights(const RockMass<Spatial>& mass, const detail::MassScene& scene,
                          const SpatialLine& line) {
  const Vec3 centre = 0.5 * (mass.domain.low + mass.domain.high);
  std::vector<Sight> found;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    if (!scene.is_drawn[b]) continue;
    const Vec3 shift = scene.explosion * (mass.bodies[b].properties.centroid - centre);
    const SpatialLine moved{line.start - shift, line.end - shift};
    double from = 0, to = 0;
    if (clip(moved, mass.bodies[b].parts[0], 1e-9, from, to))
      found.push_back({from, static_cast<int>(b)});
  }
  std::sort(found.begin(), found.end(),
            [](const Sight& x, const Sight& y) { return x.distance < y.distance; });
  return found;
}

bool holds(const std::vector<Vec2>& polygon, const Vec2& p) {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (cross(Vec2(polygon[(k + 1) % polygon.size()] - polygon[k]), Vec2(p - polygon[k])) < 0)
      return false;
  return true;
}

MassPicture plain() {
  MassPicture picture;
  picture.header.title = "Rock";
  return picture;
}

}  // namespace

TEST_SUITE("io/mass_picture") {
  TEST_CASE("a viewer in the South has East on the right, one in the West North on the left") {
    const AxonometricView south(180 * degree, 0), west(270 * degree, 30 * degree);
    CHECK((south(Vec3::UnitX()) - Vec2(1, 0)).norm() < 1e-15);
    CHECK((south(Vec3::UnitZ()) - Vec2(0, 1)).norm() < 1e-15);
    CHECK((south.towards() + Vec3::UnitY()).norm() < 1e-15);
    CHECK((west(Vec3::UnitY()) - Vec2(-1, 0)).norm() < 1e-15);
    CHECK((west(Vec3::UnitX()) - Vec2(0, 0.5)).norm() < 1e-15);  // away from the viewer: up
    CHECK((west(Vec3::UnitZ()) - Vec2(0, std::sqrt(0.75))).norm() < 1e-15);
    // From straight above as on a map that has North at the top.
    const AxonometricView above(180 * degree, 90 * degree);
    CHECK((above(Vec3::UnitX()) - Vec2(1, 0)).norm() < 1e-15);
    CHECK((above(Vec3::UnitY()) - Vec2(0, 1)).norm() < 1e-15);
    CHECK_THROWS_AS(AxonometricView(0, 2), InvalidInput);
    CHECK_THROWS_AS(AxonometricView(std::nan(""), 0), InvalidInput);
  }

  TEST_CASE("no block hides one that is painted later, in its place or moved apart") {
    for (const JointShape& shape : {JointShape{PersistentJoints{}}, JointShape{DiscJoints{3}}}) {
      const auto mass = jointed_mass(ground, 1, 1.2, {0.05, 20}, shape);
      Random random(1);
      for (const double explosion : {0.0, 0.4, 3.0})
        for (const double azimuth : {10.0, 130.0, 180.0, 290.0})
          for (const double elevation : {-40.0, 0.0, 35.0, 90.0}) {
            const AxonometricView view(azimuth * degree, elevation * degree);
            const detail::MassScene scene{std::vector<bool>(mass.bodies.size(), true), explosion};
            const auto order = detail::painting_order(mass, view.towards());
            REQUIRE(order.size() == mass.bodies.size());
            std::vector<std::size_t> place(order.size(), order.size());
            for (std::size_t k = 0; k < order.size(); ++k) place[index(order[k])] = k;
            CHECK(*std::max_element(place.begin(), place.end()) == order.size() - 1);
            for (int trial = 0; trial < 8; ++trial) {
              const double reach = 4 * (1 + explosion);
              const double x = random.uniform() - 0.5, y = random.uniform() - 0.5;
              const auto seen = sights(mass, scene, sight_line(view, 2 * reach * Vec2(x, y)));
              for (std::size_t k = 1; k < seen.size(); ++k)
                CHECK(place[index(seen[k].body)] < place[index(seen[k - 1].body)]);
            }
          }
    }
  }

  TEST_CASE("what is painted last at a place is the face that the viewer sees there") {
    const auto mass = jointed_mass(ground, 2, 1.1, {0.05, 20}, DiscJoints{4});
    for (const auto& [explosion, corner] :
         {std::pair{0.0, 0.0}, {0.0, 0.55}, {0.6, 0.0}, {0.3, 0.6}}) {
      MassPicture picture = plain();
      picture.explosion = explosion;
      picture.corner_left_out = corner;
      const AxonometricView view(picture.azimuth, picture.elevation);
      const detail::MassScene scene = detail::mass_scene(mass, picture, view);
      const auto faces = detail::visible_faces(mass, scene, view);
      const auto left_out = std::count(scene.is_drawn.begin(), scene.is_drawn.end(), false);
      CHECK((left_out > 0) == (corner > 0));
      const Vec3 centre = 0.5 * (ground.low + ground.high);
      Random random(2);
      int hits = 0, wrong = 0, joints = 0;
      for (int trial = 0; trial < 250; ++trial) {
        const double x = random.uniform() - 0.5, y = random.uniform() - 0.5;
        const Vec2 p = 14 * Vec2(x, y);
        const SpatialLine line = sight_line(view, p);
        const auto seen = sights(mass, scene, line);
        const auto last = std::find_if(faces.rbegin(), faces.rend(),
                                       [&](const auto& face) { return holds(face.corners, p); });
        if (seen.empty()) {
          wrong += last == faces.rend() ? 0 : 1;
          continue;
        }
        ++hits;
        // The face by which the line enters the first block.
        const Body<Spatial>& body = mass.bodies[index(seen[0].body)];
        const ConvexPolyhedron& block = body.parts[0];
        const Vec3 shift = explosion * (body.properties.centroid - centre);
        const Vec3 entry = line.at(seen[0].distance / line.length()) - shift;
        std::size_t face = 0;
        for (std::size_t k = 1; k < block.size(); ++k)
          if (block.half_space(k).normal.dot(view.towards()) > 0 &&
              (std::abs(block.distance(k, entry)) < std::abs(block.distance(face, entry)) ||
               block.half_space(face).normal.dot(view.towards()) <= 0))
            face = k;
        const Cut& cut = mass.cuts[index(block.cut(face))];
        const bool is_joint = cut.kind == Cut::Kind::joint;
        joints += is_joint ? 1 : 0;
        const Colour expected = detail::shaded(
            is_joint ? detail::set_colour(mass.joints[index(cut.source)].set) : detail::side_colour,
            block.half_space(face).normal, view);
        wrong += last != faces.rend() && last->fill == expected ? 0 : 1;
      }
      CHECK(wrong == 0);
      CHECK(hits > 60);
      CHECK((joints > 0) == (explosion > 0 || corner > 0));
    }
  }

  TEST_CASE("rock in one piece shows its sides and nothing from inside") {
    const auto mass = jointed_mass(ground, 3, 1);
    const AxonometricView view(200 * degree, 20 * degree);
    const detail::MassScene scene{std::vector<bool>(mass.bodies.size(), true), 0};
    double area = 0;
    for (const auto& face : detail::visible_faces(mass, scene, view)) {
      double doubled = 0;
      for (std::size_t k = 0; k < face.corners.size(); ++k)
        doubled += cross(face.corners[k], face.corners[(k + 1) % face.corners.size()]);
      area += 0.5 * doubled;
    }
    // The shadow of a box: sum over axes of its side's area times the slope to the view.
    const Vec3 size = ground.size(), t = view.towards().cwiseAbs();
    const double shadow =
        size.y() * size.z() * t.x() + size.x() * size.z() * t.y() + size.x() * size.y() * t.z();
    CHECK(std::abs(area / shadow - 1) < 1e-12);
  }

  TEST_CASE("rock around an opening shows the edges of its blocks, not of the parts they are of") {
    const AxonometricView view(180 * degree, 0);  // along the axis: at true size
    const SimplePolygon outline = circular_opening(3, 24);
    double wall = 0;
    for (std::size_t k = 0; k < outline.vertices().size(); ++k)
      wall +=
          (outline.vertices()[(k + 1) % outline.vertices().size()] - outline.vertices()[k]).norm();
    const auto rim_of = [&](const RockMass<Spatial>& mass) {
      const detail::MassScene scene{std::vector<bool>(mass.bodies.size(), true), 0};
      double length = 0;
      for (const auto& face : detail::visible_faces(mass, scene, view))
        for (const auto& [a, b] : face.rim) length += (b - a).norm();
      return length;
    };
    const Domain<3> box{{-4, -3, -3}, {3, 4, 3}};
    const RockMass<Spatial> whole =
        carve(slice<Spatial>(box, std::vector<JointOf<3>>{}, {}), PrismaticOpening(outline), 0);
    REQUIRE(whole.bodies.size() == 1);
    REQUIRE(whole.bodies[0].parts.size() > 20);
    CHECK(std::abs(rim_of(whole) - (26 + wall)) < 1e-6);
    // A level joint: both blocks show the two stretches of it that are in rock.
    const double height = 0.3;
    double low = 0, high = 0;
    for (std::size_t k = 0; k < outline.vertices().size(); ++k) {
      const Vec2 &a = outline.vertices()[k],
                 &b = outline.vertices()[(k + 1) % outline.vertices().size()];
      if ((a.y() < height) == (b.y() < height)) continue;
      const double x = a.x() + (b.x() - a.x()) * (height - a.y()) / (b.y() - a.y());
      low = std::min(low, x);
      high = std::max(high, x);
    }
    const std::vector<JointOf<3>> joint{
        SpatialJoint{joint_disc(Vec3(0, 0, height), Vec3::UnitZ(), 50), 0}};
    const RockMass<Spatial> halves =
        carve(slice<Spatial>(box, joint, {}), PrismaticOpening(outline), 0);
    REQUIRE(halves.bodies.size() == 2);
    CHECK(std::abs(rim_of(halves) - (26 + wall + 2 * (7 - (high - low)))) < 1e-6);
  }

  TEST_CASE("the page is well-formed and names every set with its dip and dip direction") {
    auto sets = voussoir_test::three_sets(1.5);
    for (auto& set : sets) set.dip_deviation = set.dip_direction_deviation = 0;
    auto mass = slice<Spatial>(ground, joint_network(sets, ground, 4), {});
    MassPicture picture = plain();
    picture.set_names = {"J1 <bedding>", "J2"};
    picture.corner_left_out = 0.5;
    const std::string page = draw_mass_picture(mass, picture);
    CHECK(xml_fault(page) == "");
    for (const char* text : {"J1 &lt;bedding&gt;, 75/010", "J2, 25/130", "set 3, 60/250",
                             "side of the model", ">up<", ">E<", ">N<", "7 m"})
      CHECK(page.find(text) != std::string::npos);
    CHECK(page.find("other joints") == std::string::npos);
    mass.joints[0].set = -1;
    picture.explosion = 0.2;
    const std::string exploded = draw_mass_picture(mass, picture);
    CHECK(exploded.find("other joints") != std::string::npos);
    CHECK(exploded.find(">7 m<") == std::string::npos);  // no lengths where blocks have moved
    CHECK(xml_fault(exploded) == "");
    CHECK(xml_fault(draw_mass_picture(slice<Spatial>(ground, {}, {}), plain())) == "");
  }

  TEST_CASE("planes are written as geologists do") {
    CHECK(orientation_text({75 * degree, 10 * degree}) == "75/010");
    CHECK(orientation_text({5.4 * degree, 359.7 * degree}) == "05/000");
    CHECK(orientation_text({0, 0}) == "00/000");
    CHECK(orientation_text({90 * degree, 180 * degree}) == "90/180");
  }

  TEST_CASE("a picture that cannot be drawn is refused, and the value named") {
    const auto mass = jointed_mass(ground, 5, 3);
    const auto refused = [&](auto change) {
      MassPicture picture = plain();
      change(picture);
      try {
        (void)draw_mass_picture(mass, picture);
      } catch (const InvalidInput& error) {
        return std::string(error.what());
      }
      return std::string("accepted");
    };
    const double nan = std::nan("");
    CHECK(refused([](MassPicture&) {}) == "accepted");
    CHECK(refused([](MassPicture& p) { p.explosion = -1; }).starts_with("explosion = -1"));
    CHECK(refused([=](MassPicture& p) { p.explosion = nan; }).starts_with("explosion = "));
    CHECK(refused([](MassPicture& p) { p.corner_left_out = 1.5; }).starts_with("corner_left_out"));
    CHECK(refused([=](MassPicture& p) { p.elevation = nan; }).starts_with("elevation of the view"));
    CHECK_THROWS_AS((void)draw_mass_picture(RockMass<Spatial>{}, plain()), InvalidInput);
    // All blocks left out: an empty page, not a fault.
    CHECK(refused([](MassPicture& p) { p.corner_left_out = 1; }) == "accepted");
  }
}

}  // namespace mass_picture_test
