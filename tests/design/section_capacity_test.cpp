// SPDX-License-Identifier: MIT
// Thrust and moment of concrete sections against the constants of textbooks, hand values and an
// integration by strips.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/design/section_capacity.hpp>

#include "support/concrete_sections.hpp"
#include "support/near.hpp"

namespace section_capacity_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;
using voussoir_test::near;
using voussoir_test::plain;
using voussoir_test::reinforced;

/// EN 1992-1-1, 3.1.7, as a function of the strain, for up to 50 MPa [-].
double parabola_rectangle(double strain) {
  if (strain <= 0) return 0;
  return strain >= 2e-3 ? 1 : 1 - (1 - strain / 2e-3) * (1 - strain / 2e-3);
}

/// The forces of one state of strain by strips.
/// @param inner, outer  strains of the faces
SectionForces by_strips(const ConcreteSection& s, double inner, double outer) {
  constexpr int strips = 200'000;
  const double h = s.thickness, f = s.long_term_factor * s.strength / s.partial_factor;
  SectionForces sum;
  const auto add = [&](double force, double depth) {
    sum.thrust += force;
    sum.moment += force * (h / 2 - depth);
  };
  const auto strain_at = [&](double depth) { return inner + (outer - inner) * depth / h; };
  for (int k = 0; k < strips; ++k) {
    const double depth = (k + 0.5) * h / strips, strain = strain_at(depth);
    const double stress =
        strain > 0 ? f * parabola_rectangle(strain) : -s.fibre_strength / s.fibre_partial_factor;
    add(stress * s.width * h / strips, depth);
  }
  for (const BarLayer& bars : s.bars) {
    const double strain = strain_at(bars.depth), yield = bars.yield_strength / bars.partial_factor;
    const double stress = std::min(std::max(bars.modulus * strain, -yield), yield);
    add(bars.area * (stress - f * parabola_rectangle(strain)), bars.depth);
  }
  return sum;
}

}  // namespace

TEST_SUITE("design/section_capacity") {
  TEST_CASE("plain concrete: area and centre of the parabola-rectangle, 17/21 and 99/238") {
    // Of the triangle of strains to 3.5 permille. f_cd = 0.85 x 25 / 1.5 MPa.
    const double h = 0.2, f = 0.85 * 25e6 / 1.5;
    const SectionCapacity capacity(plain(h, 25e6));
    CHECK(capacity.at(1, 0).thrust == near(f * h).epsilon(1e-12));
    CHECK(std::abs(capacity.at(1, 0).moment) < 1e-9 * f * h * h);
    for (int k = 0; k < 20; ++k) {
      const double axis = h * (1 - k / 20.0);
      const SectionForces found = capacity.at(1, 1 - axis / (2 * h)),
                          other = capacity.at(-1, 1 - axis / (2 * h));
      const double thrust = 17.0 / 21 * f * axis;
      CHECK(found.thrust == near(thrust).epsilon(1e-12));
      CHECK(found.moment == near(thrust * (h / 2 - 99.0 / 238 * axis)).epsilon(1e-12));
      CHECK(other.thrust == found.thrust);
      CHECK(other.moment == -found.moment);
    }
    const SectionForces last = capacity.at(1, 1);
    CHECK(std::abs(last.thrust) < 1e-9 * f * h);
    CHECK(std::abs(last.moment) < 1e-9 * f * h * h);
  }

  TEST_CASE("bars by hand: pure compression, yield of the tension layer, pure tension") {
    // f_cd = 17 MPa, f_yd = 434.78 MPa; bars at 2 permille: 400 MPa, less the concrete they
    // displace.
    const SectionCapacity capacity(reinforced());
    const double f = 17e6, fy = 500e6 / 1.15;
    const SectionForces pressed = capacity.at(1, 0);
    CHECK(pressed.thrust == near(f * 0.25 + (400e6 - f) * 15e-4).epsilon(1e-12));
    CHECK(pressed.moment == near((400e6 - f) * (6e-4 * 0.085 - 9e-4 * 0.075)).epsilon(1e-9));
    // Tension layer at 4 permille, inner face at 3.5: axis at 0.2 x 3.5 / 7.5 = 0.09333 m; the
    // inner layer at 3.5 x 0.05333 / 0.09333 = 2 permille.
    const double axis = 0.2 * 3.5 / 7.5;
    const SectionForces bent = capacity.at(1, 1 - axis / 0.5);
    const double concrete = 17.0 / 21 * f * axis, inner = 6e-4 * (400e6 - f), outer = 9e-4 * fy;
    CHECK(bent.thrust == near(concrete + inner - outer).epsilon(1e-12));
    CHECK(bent.moment ==
          near(concrete * (0.125 - 99.0 / 238 * axis) + inner * 0.085 + outer * 0.075)
              .epsilon(1e-12));
    const SectionForces pulled = capacity.at(1, 1);
    CHECK(pulled.thrust == near(-15e-4 * fy).epsilon(1e-12));
    CHECK(pulled.moment == near(fy * (-6e-4 * 0.085 + 9e-4 * 0.075)).epsilon(1e-12));
    CHECK(capacity.at(-1, 1).thrust == near(pulled.thrust).epsilon(1e-12));
    CHECK(capacity.at(-1, 1).moment == near(pulled.moment).epsilon(1e-9));
  }

  TEST_CASE("plain, with fibres and with bars against strips") {
    ConcreteSection fibres = plain(0.15, 35e6);
    fibres.fibre_strength = 1.2e6;
    fibres.width = 1.5;
    ConcreteSection both = reinforced();
    both.fibre_strength = 0.8e6;
    for (const ConcreteSection& s : {plain(0.1, 20e6), fibres, reinforced(), both}) {
      const SectionCapacity capacity(s);
      const double h = s.thickness, size = s.design_strength() * s.width * h;
      for (const int bending : {1, -1})
        for (int k = 0; k <= 20; ++k) {
          const double place = k / 20.5;
          CAPTURE(place);
          // Figure 6.1: about C, at 3/7 of the height, then about B.
          double most = 3.5e-3, other = 0;
          if (place <= 0.5) {
            other = 2e-3 * (1 - 2 * place);
            most = 2e-3 + (2e-3 - other) * (3.0 / 7) / (4.0 / 7);
          } else {
            other = 3.5e-3 * (1 - 1 / (2 * (1 - place)));
          }
          const SectionForces found = capacity.at(bending, place),
                              strips = bending > 0 ? by_strips(s, most, other)
                                                   : by_strips(s, other, most);
          // A strip that the neutral axis cuts counts to one side: 1 / 200 000 of the section.
          CHECK(std::abs(found.thrust - strips.thrust) < 1e-6 * size);
          CHECK(std::abs(found.moment - strips.moment) < 1e-6 * size * h);
        }
    }
  }

  TEST_CASE("printed values: a slab by another program, a column by IS 456") {
    // 268.71 kN m of eurocodeapplied.com (uls-design-rectangular-section), quoted by the
    // verification of XC, verif/tests/materials/ec2/test_ec2_interaction_diagram_03.py: 1 m x 60
    // cm, C25, alpha_cc = 1, six bars of 16 mm at 74 mm and six of 4 mm at 68 mm from the other
    // face, under a thrust of 0.64 kN.
    ConcreteSection slab = plain(0.6, 25e6);
    slab.long_term_factor = 1;
    const auto bars = [](double diameter) {
      return 6 * 3.14159265358979 / 4 * diameter * diameter;
    };
    slab.bars = {{.area = bars(0.016), .depth = 0.526}, {.area = bars(0.004), .depth = 0.068}};
    CHECK(SectionCapacity(slab).utilisation({639.09, 268.71e3}).value == near(1).epsilon(1e-4));
    // IS 456 has the same diagram with 0.446 f_ck and the same pivot at 3/7 of the height. Scilab's
    // textbook companion 3683, example 18.5: with the neutral axis 1.3 D deep 0.409 f_ck D acts
    // 0.468 D below the face; down to 1.0 D it is 0.36 f_ck x, 0.416 x below it.
    const double h = 0.5;
    const SectionCapacity column(plain(h, 20e6));
    const double f = column.section().design_strength() / 0.446;
    // The least strain is 0.3 / 1.3 of the largest.
    const double most = 2e-3 / (1 - 3.0 / 7 / 1.3), other = most * 0.3 / 1.3;
    const SectionForces deep = column.at(1, 0.5 * (1 - other / 2e-3)), full = column.at(1, 0.5);
    CHECK(deep.thrust / (f * h) == near(0.409).epsilon(0.002));  // three digits
    CHECK(0.5 - deep.moment / (deep.thrust * h) == near(0.468).epsilon(0.001));
    CHECK(full.thrust / (f * h) == near(0.361).epsilon(0.002));
    CHECK(0.5 - full.moment / (full.thrust * h) == near(0.416).epsilon(0.001));
  }

  TEST_CASE("high strengths have their own diagram, table 3.1") {
    // C70: 2.42 and 2.7 permille, n = 1.44 as printed; alike at all strengths up to 50 MPa.
    const auto mean_of = [](double strength) {
      const SectionCapacity capacity(plain(1, strength));
      return capacity.at(1, 0.5).thrust / capacity.at(1, 0).thrust;
    };
    CHECK(mean_of(20e6) == near(17.0 / 21).epsilon(1e-12));
    CHECK(mean_of(50e6) == near(17.0 / 21).epsilon(1e-12));
    // 1 - (2.42 / 2.66) / (n + 1), with the printed digits: to one in the last of 2.7.
    CHECK(mean_of(70e6) == near(1 - 2.42 / 2.66 / 2.44).epsilon(0.01));
    CHECK(mean_of(70e6) < 0.66);
  }

  TEST_CASE("utilisation: loads on the envelope, within and beyond") {
    ConcreteSection fibres = plain(0.2, 30e6);
    fibres.fibre_strength = 1e6;
    Random random(7, 1);
    for (const ConcreteSection& s : {plain(0.2, 30e6), fibres, reinforced()}) {
      const SectionCapacity capacity(s);
      for (int k = 0; k < 200; ++k) {
        const int bending = random.uniform() < 0.5 ? 1 : -1;
        const double place = 0.98 * random.uniform(), factor = 0.1 + 2 * random.uniform();
        const SectionForces limit = capacity.at(bending, place);
        CAPTURE(place);
        CAPTURE(bending);
        const SectionUtilisation found =
            capacity.utilisation({factor * limit.thrust, factor * limit.moment});
        CHECK(found.value == near(factor).epsilon(1e-6));
      }
    }
    const SectionCapacity capacity(plain(0.2, 30e6));
    CHECK(capacity.utilisation({0, 0}).value == 0);
    CHECK(capacity.utilisation({17e6 * 0.1, 0}).value ==
          near(0.5).epsilon(1e-6));  // as flat as it is
    CHECK(capacity.utilisation({17e6 * 0.1, 0}).mode == SectionMode::compression);
    // The thrust leaves the section, and plain concrete bears no tension.
    CHECK(std::isinf(capacity.utilisation({1e5, 0.1001e5}).value));
    CHECK(std::isinf(capacity.utilisation({-1, 0}).value));
    CHECK(std::isinf(capacity.utilisation({0, 1}).value));
    CHECK(std::isfinite(capacity.utilisation({1e5, 0.099e5}).value));
    CHECK(capacity.utilisation({1e5, 0.05e5}).mode == SectionMode::bending);
    const SectionCapacity with_bars(reinforced());
    CHECK(with_bars.utilisation({-15e-4 * 500e6 / 1.15, 0.0}).value > 1);
    ConcreteSection limited = plain(0.2, 30e6);
    limited.largest_eccentricity = 0.3;
    CHECK(std::isinf(SectionCapacity(limited).utilisation({1e5, 0.0601e5}).value));
    CHECK(std::isinf(SectionCapacity(limited).utilisation({1e5, -0.0601e5}).value));
    CHECK(std::isfinite(SectionCapacity(limited).utilisation({1e5, -0.0599e5}).value));
    // What it would fail of: a thrust that leaves the section bends it, a pull tears it.
    CHECK(capacity.utilisation({1e5, 0.1001e5}).mode == SectionMode::bending);
    ConcreteSection alike = plain(0.2, 30e6);
    alike.bars = {{.area = 5e-4, .depth = 0.04}, {.area = 5e-4, .depth = 0.16}};
    CHECK(SectionCapacity(alike).utilisation({-1e5, 0}).mode == SectionMode::tension);
    CHECK(SectionCapacity(alike).utilisation({-1e5, 0}).value ==
          near(1e5 / (10e-4 * 500e6 / 1.15)).epsilon(1e-6));
  }

  TEST_CASE("the envelope is closed, and turned over it is that of the section turned over") {
    const auto one = SectionCapacity(reinforced()).envelope(41);
    ConcreteSection turned = reinforced();
    for (BarLayer& bars : turned.bars) bars.depth = turned.thickness - bars.depth;
    const auto other = SectionCapacity(turned).envelope(41);
    CHECK(one.size() == 80);
    for (std::size_t k = 0; k < one.size(); ++k) {
      const SectionForces& mirrored = other[(one.size() - k) % one.size()];
      CHECK(std::abs(one[k].thrust - mirrored.thrust) < 1e-9 * one[0].thrust);
      CHECK(std::abs(one[k].moment + mirrored.moment) < 1e-9 * one[0].thrust);
    }
  }

  TEST_CASE("what is no section is refused by name") {
    const auto refused = [](const std::function<void(ConcreteSection&)>& spoil, const char* name) {
      ConcreteSection s = reinforced();
      spoil(s);
      CHECK_THROWS_WITH_AS(SectionCapacity{s}, doctest::Contains(name), InvalidInput);
    };
    refused([](auto& s) { s.thickness = 0; }, "thickness of a section");
    refused([](auto& s) { s.width = -1; }, "width of a section");
    refused([](auto& s) { s.strength = 0; }, "strength of concrete");
    refused([](auto& s) { s.strength = 25; }, "1e6 to 9e7 Pa");
    refused([](auto& s) { s.partial_factor = 0.9; }, "partial factor of concrete");
    refused([](auto& s) { s.long_term_factor = std::nan(""); }, "long-term factor");
    refused([](auto& s) { s.fibre_strength = -1; }, "residual strength of fibres");
    refused([](auto& s) { s.largest_eccentricity = 0.3; }, "largest eccentricity = 0.3");
    refused([](auto& s) { s.bars[0].area = 0; }, "area of bars");
    refused([](auto& s) { s.bars[1].depth = 0.25; }, "depth of bars");
    refused([](auto& s) { s.bars[1].yield_strength = 500; }, "yield strength of bars");
  }
}

}  // namespace section_capacity_test
