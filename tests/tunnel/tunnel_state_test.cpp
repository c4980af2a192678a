// SPDX-License-Identifier: MIT
// What is read of a tunnel at rest and of one that moves is the same where both are the same.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/io/tunnel_picture.hpp>
#include <voussoir/io/tunnel_tables.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>

#include "support/blocks.hpp"
#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace tunnel_state_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

const CoulombJoint joint({5e9, 5e8, 50 * degree});
const InSitu in_situ{.density = 2700, .k0 = 0.7, .surcharge = 2e5};

/// What all contacts of two bodies are together; the middle is weighted by their measures.
template <int Dim>
struct Together {
  double measure = 0, normal = 0;
  Vec<Dim> middle = zeros<Vec<Dim>>();
};
template <int Dim>
std::map<std::pair<int, int>, Together<Dim>> by_pair(const std::vector<JointState<Dim>>& joints) {
  std::map<std::pair<int, int>, Together<Dim>> pairs;
  for (const JointState<Dim>& j : joints) {
    // A run also lists corners that touch, and faces that lie so near that they might.
    if (j.measure < 1e-6 || j.report.is_open) continue;
    Together<Dim>& t = pairs[std::minmax(j.a, j.b)];
    t.measure += j.measure;
    t.normal += j.report.normal;
    t.middle += j.measure * j.centre;
  }
  return pairs;
}

/// The in-situ stress is linear: the points of a contact integrate it exactly at rest (Gauss) and
/// in motion (corners), and the contacts come from the cuts or from a search.
template <class Geometry>
void compare(const RockMass<Geometry>& rock) {
  constexpr int dim = Geometry::dim;
  const Solver<Geometry> still(rock, joint, in_situ);
  const auto run = moving_rock(rock, joint, in_situ);
  const auto one = by_pair<dim>(joint_states(still)), other = by_pair<dim>(joint_states(run));
  CHECK(one.size() > 100);
  CHECK(one.size() == other.size());
  for (const auto& [pair, a] : one) {
    const auto found = other.find(pair);
    REQUIRE(found != other.end());
    const Together<dim>& b = found->second;
    // Faces meet to a few roundings of coordinates of 10 m; narrow ones have them in one side.
    CHECK(std::abs(a.measure - b.measure) <= 1e-9);
    CHECK(std::abs(a.normal - b.normal) <= 1e-9 * 1e6);  // the largest stress, 0.5 MPa, times that
    CHECK((a.middle - b.middle).norm() <= 1e-8);
  }
}

}  // namespace

TEST_SUITE("tunnel/tunnel_state") {
  TEST_CASE("contacts in the in-situ state are the same at rest and in motion") {
    compare<Planar>(voussoir_test::jointed_rock({{-6, -6}, {6, 6}}, 1));
    compare<Spatial>(voussoir_test::jointed_mass({{-3, 0, -3}, {3, 3, 3}}, 1, 1.2));
  }

  TEST_CASE("a block on a slope: what holds it, what has slipped, where") {
    for (const double friction : {55.0, 20.0}) {
      CAPTURE(friction);
      Dynamics<2, CoulombJoint> run(CoulombJoint({5e9, 5e8, friction * degree}),
                                    {.local_damping = friction > 30 ? 0.7 : 0.0});
      const double slope = 30 * degree;
      const Vec2 along(std::cos(slope), std::sin(slope)), up = perpendicular(along);
      const auto box = [&](double from, double to, double low, double high) {
        std::vector<Vec2> corners;
        for (const auto& [x, y] : {std::pair{from, low}, {to, low}, {to, high}, {from, high}})
          corners.push_back(x * along + y * up);
        return ConvexPolygon(corners);
      };
      // Flat: one that tips slips on its lighter edge.
      run.add_fixed_block(box(-6, 3, -1, 0));
      const int block = run.add_block(box(-0.5, 0.5, 0, 0.2), 2700);
      run.advance(0.3);
      const auto joints = joint_states(run);
      REQUIRE(joints.size() == 1);
      const JointState<2>& j = joints.front();
      const double weight = 2700 * 9.81 * 0.2;
      CHECK(std::min(j.a, j.b) == 0);
      CHECK(std::max(j.a, j.b) == block);
      CHECK(j.measure == voussoir_test::near(1).epsilon(1e-6));
      CHECK(std::abs(j.normal.dot(up)) == voussoir_test::near(1).epsilon(1e-3));
      CHECK(!j.report.is_open);
      const double slid = (run.home(block).position - run.position(block)).dot(along);
      if (friction >
          30) {  // held, W coming suddenly: T = W sin, N = W cos within a per cent by then
        CHECK(j.report.normal == voussoir_test::near(weight * std::cos(slope)).epsilon(0.01));
        CHECK(j.report.shear == voussoir_test::near(weight * std::sin(slope)).epsilon(0.01));
        CHECK(!j.report.is_slipping);
        CHECK(j.report.plastic_slip < visible_slip);
      } else {  // T = N tan phi; the contact has followed the block and its slip is what it slid
        CHECK(j.report.is_slipping);
        CHECK(j.report.shear ==
              voussoir_test::near(j.report.normal * std::tan(friction * degree)).epsilon(1e-9));
        CHECK(slid > 0.05);
        CHECK(j.report.plastic_slip == voussoir_test::near(slid).epsilon(0.01));
      }
      // The middle of the contact is under the block.
      CHECK((j.centre - (run.position(block) - 0.1 * up)).norm() < 0.01);
    }
  }

  TEST_CASE("a table needs the bar of every bolt") {
    const std::vector<CrossingForce> crossings{{1, 0.5, 1e-3, {.axial = 2e5, .is_yielding = true}}};
    CHECK_THROWS_WITH_AS((void)bolt_table(crossings, std::vector<Segment>{{{0, 1}, {0, 2}}}),
                         "table of bolts: no bar was given for bolt 1", InvalidInput);
    const std::string table =
        bolt_table(crossings, std::vector<Segment>{{{0, 1}, {0, 2}}, {{1, 0}, {3, 0}}});
    CHECK(table.ends_with("\r\n2,0,1,0.5,1.5,0,200,1,yielded,-,-,-\r\n"));  // no strength was given
    CHECK(bolt_table(crossings, std::vector<Segment>{{{0, 1}, {0, 2}}, {{1, 0}, {3, 0}}}, 250e3)
              .ends_with(",200,1,yielded,0.8,250,-\r\n"));
    const std::string space = bolt_table(
        crossings, std::vector<SpatialLine>{{{0, 0, 1}, {0, 0, 2}}, {{1, 7, 0}, {3, 7, 0}}});
    CHECK(space.ends_with("\r\n2,1,0.5,1.5,7,0,200,0,1,yielded,-,-,-\r\n"));
  }
}

}  // namespace tunnel_state_test
