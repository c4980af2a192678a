// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <voussoir/drawing/colour_map.hpp>

#include "support/near.hpp"

namespace colour_map_test {

using namespace voussoir;

TEST_SUITE("drawing/colour_map") {
  TEST_CASE("every screen colour survives the way to OKLab and back") {
    for (int r = 0; r < 256; r += 15) {
      for (int g = 0; g < 256; g += 15) {
        for (int b = 0; b < 256; b += 15) {
          const Colour colour{static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                              static_cast<std::uint8_t>(b)};
          CHECK(screen_colour(perceptual(colour)) == colour);
        }
      }
    }
    // Published values: white is lightness 1 without hue.
    const PerceptualColour white = perceptual({255, 255, 255});
    CHECK(white.lightness == voussoir_test::near(1).epsilon(1e-6));
    CHECK(std::abs(white.a) < 1e-6);
    CHECK(std::abs(white.b) < 1e-6);
    CHECK(Colour{0, 171, 255}.hex() == "#00abff");
  }

  TEST_CASE("lightness runs one way, evenly, from the first anchor to the last") {
    for (const ColourMap& map : {ColourMap::straw_to_blue(), ColourMap::violet_to_yellow()}) {
      const double first = perceptual(map(0)).lightness, last = perceptual(map(1)).lightness;
      CHECK(std::abs(last - first) > 0.3);  // seen in grey too
      double before = first;
      for (int k = 1; k <= 40; ++k) {
        const double t = k / 40.0, lightness = perceptual(map(t)).lightness;
        CHECK((lightness - before) * (last - first) > 0);
        // Rounding to 8 bits and colours cut off at the edge of the screen's range.
        CHECK(std::abs(lightness - (first + t * (last - first))) < 0.02);
        before = lightness;
      }
    }
  }

  TEST_CASE("the ends are the anchors, values beyond are cut off, NaN is grey") {
    const ColourMap map = ColourMap::straw_to_blue();
    CHECK(map(0) == Colour{253, 250, 226});
    CHECK(map(1) == Colour{62, 118, 178});
    CHECK(map(-3) == map(0));
    CHECK(map(std::numeric_limits<double>::infinity()) == map(1));
    const Colour grey = map(std::numeric_limits<double>::quiet_NaN());
    CHECK(grey.red == grey.green);
    CHECK(grey.red == grey.blue);
  }
}

}  // namespace colour_map_test
