// SPDX-License-Identifier: MIT
// What rock touches of a lining that moves: on rock a slab as thick as the lining, where rock is
// missing one of four fifths, a fifth further in.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <vector>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace lining_tiles_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

TEST_SUITE("dynamics/lining_tiles") {
  TEST_CASE("tiles fill the thickness on rock, and lie further in where pieces are missing") {
    const double thickness = 0.15;
    const auto opening = circular_opening(5, 36);
    const auto rock = carve(jointed_rock(domain_around(opening, 20, 7, 7), 4), opening, 0.3);
    REQUIRE(rock.carving.dropped_pieces > 0);
    const auto run = moving_rock(rock, CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700});
    const auto frame = lining_frame(rock, {.nodes = 36, .fill_depth = 0});
    const LiningSurface<Planar> tiles(
        frame, thickness, [&](int b) { return run.motion(b); },
        [&](int b) { return run.body(b).is_gone; });
    std::vector<double> on_rock(36, 0.0), whole(36, 0.0);
    for (const auto& c : frame.contacts)
      on_rock[static_cast<std::size_t>(c.node)] += c.facet.length();
    for (const auto& p : frame.panels) whole[static_cast<std::size_t>(p.node)] += p.facet.length();
    int bare = 0;
    for (std::size_t k = 0; k < 36; ++k) {
      CHECK(tiles.shift(k).norm() < 1e-12);  // nothing has moved yet
      const bool misses = on_rock[k] < 0.99 * whole[k];
      double area = 0;
      for (const auto& tile : tiles.tiles(k)) area += mass_properties(tile).measure;
      CHECK(area == voussoir_test::near(thickness * (on_rock[k] + (misses ? 0.8 * whole[k] : 0.0)))
                        .epsilon(1e-9));
      if (on_rock[k] > 0) continue;
      // Node k lies in the middle of its facet, which looks away from the centre of the tunnel.
      ++bare;
      const Vec2 out = frame.nodes[k].normalized();
      double farthest = 0;
      for (const auto& tile : tiles.tiles(k))
        for (const Vec2& v : tile.vertices()) farthest = std::max(farthest, out.dot(v));
      CHECK(frame.nodes[k].norm() - farthest == voussoir_test::near(0.2 * thickness).epsilon(1e-9));
    }
    CHECK(bare > 0);
  }
}

}  // namespace lining_tiles_test
