// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/removable_blocks.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>

#include "support/degree.hpp"
#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/shapes.hpp"
#include "support/solids.hpp"

namespace removable_blocks_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::near;

namespace {

constexpr double pi = std::numbers::pi;
const Vec2 down2(0, -1);
const Vec3 down3(0, 0, -1);

template <int Dim>
Vec<Dim> down() {
  return -axis_vector<Dim>(Dim - 1);
}

template <int Dim>
BlockMotion<Dim> motion_of(const std::vector<Vec<Dim>>& normals) {
  return block_motion(std::span<const Vec<Dim>>(normals), down<Dim>());
}

/// Unit normal of a plane, downward: out of a block that lies on it.
Vec3 under(double dip, double dip_direction) {
  return -upward_normal({dip * degree, dip_direction * degree});
}

template <int Dim>
Vec<Dim> random_unit(Random& random) {
  for (;;) {
    Vec<Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = random.normal();
    if (v.norm() > 1e-3) return v.normalized();
  }
}

/// Outward normals of some faces of a random block, as many as are in contact.
std::vector<Vec2> random_contacts(Random& random, const ConvexPolygon*) {
  const ConvexPolygon block = voussoir_test::random_convex(random, 7, 2, 1);
  std::vector<Vec2> normals;
  for (std::size_t k = 0; k < block.size(); ++k)
    if (random.uniform() < 0.6) normals.push_back(block.half_space(k).normal);
  return normals;
}
std::vector<Vec3> random_contacts(Random& random, const ConvexPolyhedron*) {
  const ConvexPolyhedron block = voussoir_test::random_solid(random, 6);
  const auto turn = voussoir_test::random_rotation(random);
  std::vector<Vec3> normals;
  for (std::size_t k = 0; k < block.size(); ++k)
    if (random.uniform() < 0.6) normals.push_back(turn * block.half_space(k).normal);
  return normals;
}

/// What of a shape lies in another one [m^2], [m^3].
template <class Shape>
double common_measure(std::optional<Shape> shape, const Shape& other) {
  for (std::size_t k = 0; shape && k < other.size(); ++k) {
    const auto plane = other.half_space(k);
    double farthest = -1, nearest = 1;
    for (const auto& v : shape->vertices()) {
      farthest = std::max(farthest, plane.distance(v));
      nearest = std::min(nearest, plane.distance(v));
    }
    if (farthest <= 1e-12) continue;
    auto parts = nearest < -1e-12 ? shape->split(plane, 0, 1e-12) : std::nullopt;
    shape = parts ? std::optional(std::move(parts->first)) : std::nullopt;
  }
  return shape ? mass_properties(*shape).measure : 0.0;
}

/// By how much a body that is moved would overlap the others.
template <class Geometry>
double overlap_of(const RockMass<Geometry>& mass, int moved, const Vec<Geometry::dim>& by) {
  using Point = Vec<Geometry::dim>;
  const auto& body = mass.bodies[static_cast<std::size_t>(moved)];
  double sum = 0;
  for (auto part : body.parts) {
    part.move_vertices([&](const Point& v) { return Point(v + by); });
    if constexpr (Geometry::dim == 3) {  // its planes move too
      std::vector<std::vector<int>> faces;
      for (std::size_t k = 0; k < part.size(); ++k)
        faces.emplace_back(part.loop(k).begin(), part.loop(k).end());
      part = ConvexPolyhedron(part.vertices(), faces);
    }
    for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
      const auto& other = mass.bodies[b];
      if (static_cast<int>(b) == moved) continue;
      const double reach = std::sqrt(squared_reach(body.properties)) +
                           std::sqrt(squared_reach(other.properties)) + by.norm();
      if ((body.properties.centroid - other.properties.centroid).norm() > 1.1 * reach) continue;
      for (const auto& its : other.parts)
        sum += common_measure<typename Geometry::Shape>(part, its);
    }
  }
  return sum;
}

/// Each block of a carved mass moved a tenth of a millimetre and cut with its neighbours.
template <class Geometry>
void check_by_moving(const RockMass<Geometry>& mass, int directions, std::array<int, 5>& modes) {
  constexpr int dim = Geometry::dim;
  const double step = 1e-4;
  Random random(11);
  for (const auto& block : wall_blocks(mass).blocks) {
    const auto& body = mass.bodies[static_cast<std::size_t>(block.body)];
    ++modes[static_cast<std::size_t>(block.motion.mode)];
    double surface = 0;
    for (const auto& part : body.parts)
      for (std::size_t k = 0; k < part.size(); ++k) surface += part.face(k).measure();
    // A direction into a face of that area, by the angle that is called parallel.
    const double nothing = 2 * parallel_motion * step * surface;
    CAPTURE(block.body);
    CAPTURE(to_string(block.motion.mode));
    if (block.motion.is_removable())
      CHECK(overlap_of(mass, block.body, Vec<dim>(step * block.motion.direction)) < nothing);
    for (int k = 0; k < directions; ++k) {
      const Vec<dim> s = random_unit<dim>(random);
      const bool is_free = std::all_of(block.normals.begin(), block.normals.end(),
                                       [&](const Vec<dim>& n) { return n.dot(s) <= 0; });
      const double overlap = overlap_of(mass, block.body, Vec<dim>(step * s));
      if (is_free) {
        CHECK(block.motion.is_removable());
        CHECK(overlap < nothing);
        CHECK(s.dot(down<dim>()) < block.motion.direction.dot(down<dim>()) + 1e-9);
      } else {
        CHECK(overlap > 0);
      }
    }
  }
}

/// Blocks of a section around a square opening, -2 m to 2 m, by its joints.
RockMass<Planar> around_square(const std::vector<Joint>& joints) {
  const SimplePolygon opening({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}});
  return carve(slice<Planar>({{-10, -10}, {10, 10}}, joints, {}), opening, 1e-6);
}
Joint through(const Vec2& a, const Vec2& b, int set = 0) {
  const Vec2 along = (b - a).normalized();
  return {{a - 40 * along, b + 40 * along}, set};
}

/// The block with its place on the wall nearest to a point.
template <class Geometry>
const WallBlock<Geometry>& block_at(const WallBlocks<Geometry>& wall,
                                    const Vec<Geometry::dim>& place) {
  REQUIRE_FALSE(wall.blocks.empty());
  const auto distance = [&](const WallBlock<Geometry>& b) { return (b.place - place).norm(); };
  return *std::min_element(wall.blocks.begin(), wall.blocks.end(),
                           [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
}

}  // namespace

TEST_SUITE("rockmass/removable_blocks") {
  TEST_CASE("blocks of a section that a sketch decides") {
    const auto at = [](double angle) {
      return Vec2(std::cos(angle * degree), std::sin(angle * degree));
    };
    CHECK(motion_of<2>({}).mode == BlockMode::falls);
    // A wedge in the roof, apex up, its faces 60 degrees steep.
    const auto roof = motion_of<2>({at(30), at(150)});
    CHECK(roof.mode == BlockMode::falls);
    CHECK((roof.direction - down2).norm() < 1e-15);
    CHECK(roof.needed_friction == near(pi / 2).epsilon(1e-15));
    // Wider above than at the roof, under a level joint: a keystone the wrong way round.
    const auto keystone = motion_of<2>({at(-30), at(-150), at(90)});
    CHECK(keystone.mode == BlockMode::tapered);
    CHECK(keystone.direction.norm() == 0);
    CHECK_FALSE(keystone.is_removable());
    // Between walls that are parallel and upright it falls; without friction nothing holds it.
    CHECK(motion_of<2>({at(0), at(180), at(90)}).mode == BlockMode::falls);
    // On a plane that falls 35 degrees into the opening, off a back that is upright.
    const auto slide = motion_of<2>({at(-125), at(180)});
    CHECK(slide.mode == BlockMode::slides_on_one_face);
    CHECK(slide.faces == std::array{0, -1});
    CHECK((slide.direction - at(-35)).norm() < 1e-14);
    CHECK(slide.needed_friction == near(35 * degree).epsilon(1e-13));
    // In the floor it can only be lifted.
    const auto floor = motion_of<2>({at(0), at(180), at(-90)});
    CHECK(floor.mode == BlockMode::rests);
    CHECK((floor.direction + down2).norm() < 1e-15);
    CHECK(floor.needed_friction == 0);
    // On a level plane at the wall: out of it, sideways.
    const auto level = motion_of<2>({at(-90), at(90), at(180)});
    CHECK(level.mode == BlockMode::rests);
    CHECK((level.direction - at(0)).norm() < 1e-15);
  }

  TEST_CASE("a taper of a micrometre a metre is none, one of a hundredth of a degree is") {
    const auto between = [](double taper, double allowed = parallel_motion) {
      // Walls of a roof block that close downward.
      const std::vector<Vec2> normals{Vec2(std::cos(taper), -std::sin(taper)),
                                      Vec2(-std::cos(taper), -std::sin(taper)), Vec2(0, 1)};
      return block_motion(std::span<const Vec2>(normals), down2, allowed);
    };
    CHECK(between(1.9 * degree, 2 * degree).mode == BlockMode::falls);
    CHECK(between(2.1 * degree, 2 * degree).mode == BlockMode::tapered);
    CHECK_THROWS_AS((void)between(0, -0.1), InvalidInput);
    CHECK_THROWS_AS((void)between(0, std::nan("")), InvalidInput);
    CHECK(between(0.5e-6).mode == BlockMode::falls);
    CHECK(between(0.01 * degree).mode == BlockMode::tapered);
    CHECK(between(-0.01 * degree).mode == BlockMode::falls);
  }

  TEST_CASE("a wedge on two planes: Hoek & Bray's angle of friction") {
    // F = sin(beta) / sin(xi / 2) tan(phi) / tan(psi): psi plunge of the edge, xi angle between the
    // planes, beta of the bisector of their traces across the edge above the horizontal.
    struct Planes {
      double dip_a, towards_a, dip_b, towards_b;
    };
    for (const Planes& p :
         {Planes{60, 300, 60, 60}, {45, 105, 70, 235}, {70, 20, 50, 130}, {80, 340, 35, 70}}) {
      CAPTURE(p.dip_a);
      const Vec3 a = under(p.dip_a, p.towards_a), b = under(p.dip_b, p.towards_b);
      Vec3 edge = cross(a, b).normalized();
      if (edge.z() > 0) edge = -edge;
      const double plunge = std::asin(-edge.z());
      // Across the edge, seen along it: traces up the planes, from the edge.
      const Vec3 level = cross(edge, down3).normalized(), up = cross(level, edge);
      const auto up_trace = [&](const Vec3& n) {
        const Vec3 t = cross(edge, n);
        return t.dot(up) > 0 ? t : Vec3(-t);
      };
      const Vec3 ta = up_trace(a), tb = up_trace(b);
      const double xi = std::acos(ta.dot(tb));
      const Vec3 bisector = (ta + tb).normalized();
      const double beta = std::atan2(bisector.dot(up), std::abs(bisector.dot(level)));
      const double expected = std::atan(std::sin(xi / 2) / std::sin(beta) * std::tan(plunge));
      const auto motion = motion_of<3>({a, b});
      REQUIRE(motion.mode == BlockMode::slides_on_two_faces);
      CHECK(motion.faces == std::array{0, 1});
      CHECK((motion.direction - edge).norm() < 1e-13);
      CHECK(motion.needed_friction == near(expected).epsilon(1e-11));  // acos of a few digits less
    }
  }

  TEST_CASE("in a trough it needs the friction of the floor, more than that of the sides") {
    // Three planes that meet in lines along one direction, 30 degrees down: statics does not say
    // which of them carry, and the floor alone needs most.
    const Vec3 floor = under(30, 0), across(1, 0, 0);
    const Vec3 a = std::cos(50 * degree) * floor + std::sin(50 * degree) * across,
               b = std::cos(50 * degree) * floor - std::sin(50 * degree) * across;
    const double by_sides = std::atan(std::tan(30 * degree) * std::cos(50 * degree));
    CHECK(motion_of<3>({a, b}).needed_friction == near(by_sides).epsilon(1e-12));
    CHECK(motion_of<3>({a, b, floor}).needed_friction == near(30 * degree).epsilon(1e-12));
    CHECK(motion_of<3>({floor, b, a}).needed_friction == near(30 * degree).epsilon(1e-12));
  }

  TEST_CASE("a wedge in space slides on one plane where the other falls away from it") {
    // On 50/090 before 70/100: down the first, away from the second, on which it cannot go down.
    const Vec3 a = under(50, 90), b = under(70, 100);
    const auto motion = motion_of<3>({a, b});
    CHECK(motion.mode == BlockMode::slides_on_one_face);
    CHECK(motion.faces == std::array{0, -1});
    CHECK((motion.direction - dip_vector({50 * degree, 90 * degree})).norm() < 1e-14);
    CHECK(motion.needed_friction == near(50 * degree).epsilon(1e-13));
  }

  TEST_CASE("tetrahedra at a roof: three planes lean together, and one that undercuts the block") {
    // Outward of a block under a plane is up: the wedge hangs from an apex above.
    const Vec3 a = -under(60, 0), b = -under(60, 120), c = -under(60, 240);
    CHECK(motion_of<3>({a, b, c}).mode == BlockMode::falls);
    CHECK(motion_of<3>({a, b, under(70, 60)}).mode == BlockMode::slides_on_one_face);
    CHECK(motion_of<3>({a, b, under(70, 60)}).needed_friction == near(70 * degree).epsilon(1e-13));
    // At the floor the same three planes hold it from below.
    const auto floor = motion_of<3>({under(60, 0), under(60, 120), under(60, 240)});
    CHECK(floor.mode == BlockMode::rests);
    // With a plane on top of it nothing is left.
    CHECK(motion_of<3>({under(60, 0), under(60, 120), under(60, 240), Vec3(0, 0, 1)}).mode ==
          BlockMode::tapered);
  }

  TEST_CASE("a bar between parallel planes leaves along them, though no edge says where") {
    CHECK(motion_of<3>({Vec3(0, 0, 1), Vec3(0, 0, -1)}).mode == BlockMode::rests);
    const Vec3 n = under(30, 45);
    const auto layer = motion_of<3>({n, Vec3(-n)});
    CHECK(layer.mode == BlockMode::slides_on_one_face);
    CHECK(layer.needed_friction == near(30 * degree).epsilon(1e-13));
    // Level bar, closed on four sides: out along its axis alone.
    const auto bar = motion_of<3>({Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0)});
    CHECK(bar.mode == BlockMode::rests);
    CHECK(std::abs(bar.direction.y()) == near(1).epsilon(1e-15));
    CHECK(motion_of<3>({Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0),
                        Vec3(0, -1, 0)})
              .mode == BlockMode::tapered);
  }

  TEST_CASE_TEMPLATE("random blocks: what many random directions find, and no more", Geometry,
                     Planar, Spatial) {
    constexpr int dim = Geometry::dim;
    // No direction of the sphere is farther from one of them: checked below against the answer.
    const int count = dim == 2 ? 2000 : 20000;
    const double gap = dim == 2 ? 0.03 : 0.06;
    std::array<int, 5> modes{};
    Random random(3);
    std::vector<Vec<dim>> directions;
    for (int k = 0; k < count; ++k) directions.push_back(random_unit<dim>(random));
    for (int trial = 0; trial < 400; ++trial) {
      CAPTURE(trial);
      const auto normals =
          random_contacts(random, static_cast<const typename Geometry::Shape*>(nullptr));
      const auto motion = motion_of<dim>(normals);
      ++modes[static_cast<std::size_t>(motion.mode)];
      double best = -2, nearly = -2;
      for (const Vec<dim>& s : directions) {
        double most = -2;
        for (const Vec<dim>& n : normals) most = std::max(most, n.dot(s));
        const double drive = s.dot(down<dim>());
        if (most <= 0) best = std::max(best, drive);
        if (most <= gap) nearly = std::max(nearly, drive);
      }
      if (!motion.is_removable()) {
        CHECK(best == -2);
        continue;
      }
      CHECK(motion.direction.norm() == near(1).epsilon(1e-14));
      for (const Vec<dim>& n : normals) CHECK(n.dot(motion.direction) <= parallel_motion);
      const double drive = motion.direction.dot(down<dim>());
      CHECK(best <= drive + 1e-9);   // none is better
      CHECK(nearly >= drive - gap);  // and one is next to it
      CHECK(motion.is_driven() == (drive > parallel_motion));
      // Equilibrium on the faces it slides on: weight less friction is carried by their normals.
      if (motion.mode != BlockMode::slides_on_one_face &&
          motion.mode != BlockMode::slides_on_two_faces)
        continue;
      const double pressure = drive / std::tan(motion.needed_friction);
      Vec<dim> carried = down<dim>() - drive * motion.direction;
      double sum = 0;
      if (motion.faces[1] < 0) {
        const Vec<dim>& n = normals[static_cast<std::size_t>(motion.faces[0])];
        sum = carried.dot(n);
        carried -= sum * n;
      } else if constexpr (dim == 3) {
        const Vec<dim>&n = normals[static_cast<std::size_t>(motion.faces[0])],
              m = normals[static_cast<std::size_t>(motion.faces[1])];
        const double on_n = cross(carried, m).dot(motion.direction) /
                            cross(n, m).dot(motion.direction),
                     on_m = cross(n, carried).dot(motion.direction) /
                            cross(n, m).dot(motion.direction);
        CHECK(on_n >= -1e-12);
        CHECK(on_m >= -1e-12);
        sum = on_n + on_m;
        carried -= on_n * n + on_m * m;
      }
      CHECK(carried.norm() < 1e-10);
      CHECK(pressure == near(sum).epsilon(1e-9));
    }
    // All there are, and of each enough to have been tried.
    for (const BlockMode mode :
         {BlockMode::tapered, BlockMode::rests, BlockMode::slides_on_one_face, BlockMode::falls})
      CHECK(modes[static_cast<std::size_t>(mode)] > 10);
    if (dim == 3) CHECK(modes[static_cast<std::size_t>(BlockMode::slides_on_two_faces)] > 10);
  }

  TEST_CASE("a block turned about the vertical or mirrored moves as it did") {
    Random random(5);
    for (int trial = 0; trial < 200; ++trial) {
      auto normals = random_contacts(random, static_cast<const ConvexPolyhedron*>(nullptr));
      const auto motion = motion_of<3>(normals);
      const double angle = 2 * pi * random.uniform(), sign = trial % 2 == 0 ? 1 : -1;
      const auto moved = [&](const Vec3& v) {
        return Vec3(sign * (std::cos(angle) * v.x() - std::sin(angle) * v.y()),
                    std::sin(angle) * v.x() + std::cos(angle) * v.y(), v.z());
      };
      for (Vec3& n : normals) n = moved(n);
      std::reverse(normals.begin(), normals.end());
      const auto again = motion_of<3>(normals);
      CHECK(again.mode == motion.mode);
      CHECK(again.needed_friction == near(motion.needed_friction).scale(1).epsilon(1e-12));
      if (motion.is_driven()) CHECK((again.direction - moved(motion.direction)).norm() < 1e-12);
    }
  }

  TEST_CASE("normals that are none are refused") {
    CHECK_THROWS_AS((void)motion_of<2>({Vec2(0, 2)}), InvalidInput);
    CHECK_THROWS_AS((void)motion_of<3>({Vec3(0, 0, std::nan(""))}), InvalidInput);
    CHECK_THROWS_AS((void)block_motion(std::span<const Vec3>(), Vec3(0, 0, -2)), InvalidInput);
  }

  TEST_CASE("a wedge in the roof of a square opening: size, place, depth and its fall") {
    const auto mass = around_square({through({-1, 2}, {0, 3.5}), through({1, 2}, {0, 3.5}, 1)});
    const auto wall = wall_blocks(mass);
    const auto& wedge = block_at<Planar>(wall, {0, 2});
    CHECK(wedge.motion.mode == BlockMode::falls);
    CHECK(wedge.size == near(1.5).epsilon(1e-12));
    CHECK(wedge.free_measure == near(2).epsilon(1e-12));
    CHECK((wedge.place - Vec2(0, 2)).norm() < 1e-12);
    CHECK(wedge.depth == near(1.5).epsilon(1e-12));
    CHECK(wedge.normals.size() == 2);
    // The rest of the rock reaches the sides of the domain.
    CHECK(wall.blocks.size() == 1);
    CHECK(wall.cut_count == 3);
  }

  TEST_CASE("a block of the roof that is wider above is wedged shut; one at the wall slides") {
    const auto mass = around_square(
        {through({-0.5, 2}, {-1, 4}), through({0.5, 2}, {1, 4}), through({-5, 4}, {5, 4}, 1)});
    const auto roof = wall_blocks(mass);
    const auto& keystone = block_at<Planar>(roof, {0, 2});
    CHECK(keystone.motion.mode == BlockMode::tapered);
    CHECK(keystone.size == near(3).epsilon(1e-12));
    CHECK(keystone.depth == near(2).epsilon(1e-12));
    // Between planes that fall 40 degrees into the opening from the left, an upright joint behind.
    const double rise = 2 * std::tan(40 * degree);
    const auto side =
        around_square({through({-2, -1}, {-4, -1 + rise}), through({-2, 1.5}, {-4, 1.5 + rise}),
                       through({-4, -9}, {-4, 9}, 1)});
    const auto left = wall_blocks(side);
    const auto& block = block_at<Planar>(left, {-2, 0.25});
    CHECK(block.motion.mode == BlockMode::slides_on_one_face);
    CHECK(block.motion.needed_friction == near(40 * degree).epsilon(1e-12));
    CHECK(block.size == near(5).epsilon(1e-12));
    CHECK(block.free_measure == near(2.5).epsilon(1e-12));
    CHECK((block.place - Vec2(-2, 0.25)).norm() < 1e-12);
    CHECK(block.depth == near(std::hypot(2, rise - 0.5)).epsilon(1e-12));
  }

  TEST_CASE("rock and opening seen in a mirror: the blocks, modes and angles of the other side") {
    Random random(17);
    std::array<int, 5> modes{};
    for (int trial = 0; trial < 6; ++trial) {
      std::vector<Joint> joints, mirrored;
      for (int k = 0; k < 14; ++k) {
        const Vec2 a(6 * random.uniform() - 3, 6 * random.uniform() - 3),
            d = random_unit<2>(random);
        joints.push_back(through(a, a + d));
        mirrored.push_back(through({-a.x(), a.y()}, {-a.x() - d.x(), a.y() + d.y()}));
      }
      auto here = wall_blocks(around_square(joints)).blocks,
           there = wall_blocks(around_square(mirrored)).blocks;
      REQUIRE(here.size() == there.size());
      const auto by_size = [](const auto& a, const auto& b) { return a.size < b.size; };
      std::sort(here.begin(), here.end(), by_size);
      std::sort(there.begin(), there.end(), by_size);
      for (std::size_t k = 0; k < here.size(); ++k) {
        const auto &a = here[k], &b = there[k];
        ++modes[static_cast<std::size_t>(a.motion.mode)];
        // Roundings of coordinates of 10 m, over faces of a millimetre and more.
        CHECK(b.motion.mode == a.motion.mode);
        CHECK(b.size == near(a.size).epsilon(1e-9));
        CHECK(b.depth == near(a.depth).epsilon(1e-9));
        CHECK((b.place - Vec2(-a.place.x(), a.place.y())).norm() < 1e-9);
        CHECK(b.motion.needed_friction == near(a.motion.needed_friction).scale(1).epsilon(1e-9));
      }
    }
    CHECK(modes[0] + modes[1] + modes[2] + modes[4] > 60);
  }

  TEST_CASE_TEMPLATE("rock that fills its domain has no block with a free face", Geometry, Planar,
                     Spatial) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      if constexpr (Geometry::dim == 2)
        CHECK(
            wall_blocks(voussoir_test::jointed_rock({{-10, -10}, {10, 10}}, seed)).blocks.empty());
      else
        CHECK(wall_blocks(voussoir_test::jointed_mass({{0, 0, 0}, {8, 8, 8}}, seed, 1.2, {0.05, 10},
                                                      DiscJoints{3}))
                  .blocks.empty());
    }
  }

  TEST_CASE("free faces are the wall: as long, as large, of the same blocks") {
    const auto rock = voussoir_test::jointed_rock({{-12, -12}, {12, 12}}, 2);
    const SimplePolygon circle(voussoir_test::regular(36, 3));
    const auto mass = carve(rock, circle, 0.05);
    const auto pieces = wall_pieces(mass);
    const auto wall = wall_blocks(mass);
    CHECK(wall.cut_count == 0);
    CHECK(wall.blocks.size() > 20);
    double whole = 0;
    for (const auto& block : wall.blocks) {
      double measure = 0;
      for (const auto& piece : pieces)
        if (piece.body == block.body) measure += piece.facet.measure();
      whole += measure;
      CHECK(block.free_measure == near(measure).epsilon(1e-6));  // by definition of a free face
      CHECK(block.depth > 0);
      CHECK(block.place.norm() < 3 + block.depth);
    }
    CHECK(whole > 0.98 * circle.perimeter());
    // 3-D: a tunnel of 4 m with a face in the rock.
    const auto solid = voussoir_test::jointed_mass({{-8, 0, -8}, {8, 10, 8}}, 4, 1.5, {0.05, 10});
    const PrismaticOpening tunnel(SimplePolygon(voussoir_test::regular(12, 2)),
                                  -PrismaticOpening::endless, 6);
    const auto carved = carve(solid, tunnel, 0.01);
    const auto sides = wall_pieces(carved);
    std::size_t at_face = 0;
    for (const auto& block : wall_blocks(carved).blocks) {
      double measure = 0;
      for (const auto& piece : sides)
        if (piece.body == block.body) measure += piece.facet.measure();
      if (block.place.y() > 6 - 1e-9) {
        ++at_face;
        CHECK(block.free_measure > measure);
        double ahead = 0;  // of the face
        for (const auto& part : carved.bodies[static_cast<std::size_t>(block.body)].parts)
          for (const Vec3& v : part.vertices()) ahead = std::max(ahead, v.y() - 6);
        CHECK(block.depth >= ahead);
      } else if (block.place.y() < 4) {
        CHECK(block.free_measure == near(measure).epsilon(1e-6));
      }
    }
    CHECK(at_face > 0);
  }

  TEST_CASE("blocks of random rock, moved and cut with their neighbours: 2-D and 3-D") {
    std::array<int, 5> modes{};
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
      check_by_moving(carve(voussoir_test::jointed_rock({{-12, -12}, {12, 12}}, seed),
                            SimplePolygon(voussoir_test::regular(36, 3)), 0.05),
                      60, modes);
    // Of each kind enough that a wrong one would show.
    CHECK(*std::min_element(modes.begin(), modes.begin() + 3) >= 20);
    CHECK(modes[4] > 0);
    modes = {};
    check_by_moving(carve(voussoir_test::jointed_mass({{-6, 0, -6}, {6, 8, 6}}, 4, 1.0, {0.05, 10}),
                          PrismaticOpening(SimplePolygon(voussoir_test::regular(12, 2)),
                                           -PrismaticOpening::endless, 5),
                          0.01),
                    8, modes);
    // Flatter sets along and across the tunnel make wedges that slide.
    const Domain<3> ground{{-6, 0, -6}, {6, 8, 6}};
    const std::vector<SpatialJointSet> sets{voussoir_test::spaced_set(50, 80, 1.1),
                                            voussoir_test::spaced_set(55, 200, 1.1),
                                            voussoir_test::spaced_set(35, 300, 1.3)};
    check_by_moving(carve(slice<Spatial>(ground, joint_network(sets, ground, 6), {0.05, 10}),
                          PrismaticOpening(SimplePolygon(voussoir_test::regular(12, 2)),
                                           -PrismaticOpening::endless, 5),
                          0.01),
                    8, modes);
    for (const int count : modes) CHECK(count > 0);
  }
}

}  // namespace removable_blocks_test
