// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/trace_coverage.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace trace_coverage_test {

using namespace voussoir;

namespace {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Joint trace(double x1, double y1, double x2, double y2) { return {{{x1, y1}, {x2, y2}}, -1}; }

/// Traces of a map of 60 x 40 m about a middle, in a unit, seen from the domain's site origin.
std::vector<Joint> map_of(const Vec2& middle, double unit, const Domain<2>& domain) {
  std::vector<Joint> joints;
  for (int k = 0; k < 50; ++k) {
    const Vec2 start = middle + Vec2(-30 + 1.1 * k, -20 + 0.7 * k), end = start + Vec2(3, 2);
    joints.push_back({{unit * start - domain.site_origin, unit * end - domain.site_origin}, -1});
  }
  return joints;
}

/// Every joint as a trace of its own.
std::vector<MappedTrace> traces(const std::vector<Joint>& joints) {
  std::vector<MappedTrace> all;
  for (const Joint& joint : joints)
    all.push_back({{joint.trace.start, joint.trace.end}, joint.set});
  return all;
}

const Domain<2> mapped_ground{{-35, -35}, {35, 25}};

}  // namespace

TEST_SUITE("rockmass/trace_coverage") {
  TEST_CASE("traces are counted that reach into the domain, touching it is not enough") {
    const std::vector<Joint> joints{trace(0, 0, 1, 1),      trace(-100, 0, 100, 0),
                                    trace(-50, 30, 50, 31), trace(35, -10, 35, 10),
                                    trace(40, 0, 50, 0),    trace(-36, 24, -30, 40)};
    const TraceCoverage found = trace_coverage(traces(joints), mapped_ground);
    CHECK(found.count == 6);
    CHECK(found.inside == 2);
    CHECK(found.low == Vec2(-100, -10));
    CHECK(found.high == Vec2(100, 40));
  }

  TEST_CASE("what is probably wrong: the unit, or where the model lies on the site grid") {
    Domain<2> there = mapped_ground;
    there.site_origin = {512300, 148};
    const auto text = [](const std::vector<Joint>& joints, const Domain<2>& domain) {
      return coverage_text(trace_coverage(traces(joints), domain), domain, "model.origin");
    };
    const std::string good = text(map_of({512300, 148}, 1, there), there);
    CHECK(says(good, "50 of 50 traces reach into the domain"));
    const std::string unit = text(map_of({512300, 148}, 1000, there), there);
    CHECK(says(unit, "0 of 50 traces reach"));
    CHECK(says(unit, "probable cause: coordinates in millimetres"));
    // About the origin itself some traces in millimetres may cross the domain; the size tells.
    CHECK(says(text(map_of({0, 0}, 1000, mapped_ground), mapped_ground),
               "coordinates in millimetres"));
    CHECK(says(text(map_of({512300, 148}, 1 / 0.3048, there), there), "coordinates in feet"));
    // y counted downwards, in metres and in millimetres.
    const auto upside_down = [](std::vector<Joint> joints) {
      for (Joint& joint : joints)
        for (Vec2* end : {&joint.trace.start, &joint.trace.end}) *end = Vec2(end->x(), -end->y());
      return joints;
    };
    const std::string down =
        text(upside_down(map_of({0, 100}, 1, {{-35, 70}, {35, 130}})), {{-35, 70}, {35, 130}});
    CHECK(says(down, "probable cause: y counted downwards"));
    CHECK(says(
        text(upside_down(map_of({0, 100}, 1000, {{-35, 70}, {35, 130}})), {{-35, 70}, {35, 130}}),
        "coordinates in millimetres, where metres are read, and y counted downwards"));
    // A single short trace far away: no unit makes it as large as the domain there.
    CHECK(says(text({trace(900, 900, 900.1, 900.1)}, mapped_ground), "none that fits"));
    const std::string origin = text(map_of({512300, 148}, 1, mapped_ground), mapped_ground);
    CHECK(says(origin, "0 of 50 traces reach"));
    CHECK(says(origin, "the domain within (-35, -35) and (35, 25) m"));
    CHECK(says(origin,
               "probable cause: model.origin, the place of the model on the site grid, which is "
               "(0, 0) m: the middle of the traces is (512298, 146.15) m"));
  }

  TEST_CASE("blocks are estimated from the crossings, whatever their number") {
    const auto count = [](const std::vector<Joint>& joints) {
      return static_cast<double>(slice(mapped_ground, joints, {}).bodies.size());
    };
    CHECK(estimated_blocks({}, mapped_ground, 0.1) == 1);
    CHECK(estimated_blocks({trace(40, 0, 50, 0)}, mapped_ground, 0.1) == 1);
    // A grid of 40 x 30 lines: 41 * 31 blocks; turned, as many where it covers the domain.
    std::vector<Joint> grid;
    for (int k = 0; k < 40; ++k) grid.push_back(trace(-34 + 1.7 * k, -40, -34 + 1.7 * k, 40));
    for (int k = 0; k < 30; ++k) grid.push_back(trace(-40, -34 + 1.9 * k, 40, -34 + 1.9 * k));
    CHECK(std::abs(estimated_blocks(grid, mapped_ground, 0.01) / (41 * 31) - 1) < 0.02);
    CHECK(std::abs(estimated_blocks(grid, mapped_ground, 0.01) / count(grid) - 1) < 0.02);
    // All of them in a tenth of the domain: the same number of crossings.
    std::vector<Joint> corner;
    for (const Joint& j : grid)
      corner.push_back({{0.1 * j.trace.start + Vec2(10, 5), 0.1 * j.trace.end + Vec2(10, 5)}, -1});
    CHECK(std::abs(estimated_blocks(corner, mapped_ground, 0.001) / (41 * 31) - 1) < 0.3);
    // Random joints of finite extent, which slicing lengthens to the blocks' ends.
    const auto random = joint_network(voussoir_test::paper_sets(6), mapped_ground, 1);
    CHECK(std::abs(std::log(estimated_blocks(random, mapped_ground, 0) / count(random))) <
          std::log(2.0));
    // 2750 x 2750 lines would make 7.5 million blocks; the smallest circle allows fewer.
    std::vector<Joint> dense;
    for (int k = 0; k < 2750; ++k) {
      dense.push_back(trace(-35 + 0.0254 * k, -40, -35 + 0.0254 * k, 40));
      dense.push_back(trace(-40, -35 + 0.0218 * k, 40, -35 + 0.0218 * k));
    }
    CHECK(std::abs(estimated_blocks(dense, mapped_ground, 1e-3) / 7.5e6 - 1) < 0.02);
    CHECK(estimated_blocks(dense, mapped_ground, 0.5) == voussoir_test::near(0.25 * 4200 / 0.25));
  }
}

}  // namespace trace_coverage_test
