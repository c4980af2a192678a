// SPDX-License-Identifier: MIT
// Registers beside plain numbers: the same bits.
#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <voussoir/core/random.hpp>
#include <voussoir/detection/detail/lanes.hpp>

namespace lanes_test {

namespace {

using Numbers = std::array<double, voussoir::lane_count>;

/// Everything that lanes do with three groups of numbers.
template <class Lanes>
std::array<Numbers, 9> results(const Numbers& a, const Numbers& b, const Numbers& c) {
  const Lanes x = Lanes::load(a.data()), y = Lanes::load(b.data()), z = Lanes::load(c.data());
  const std::array<Lanes, 9> lanes{x + y,
                                   x - y,
                                   x * y,
                                   x / y,
                                   min(x, y),
                                   max(x, y),
                                   where_positive(z, x, y),
                                   Lanes::all(x.sum()),
                                   Lanes::all(x.smallest() * y.largest())};
  std::array<Numbers, 9> found;
  for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k].store(found[k].data());
  return found;
}

}  // namespace

TEST_SUITE("detection/lanes") {
  TEST_CASE("vector registers give the bits of plain numbers") {
    voussoir::Random random(11, 0);
    const auto numbers = [&random] {
      Numbers group;
      for (double& number : group) number = 2 * random.uniform() - 1;
      return group;
    };
    for (int round = 0; round < 100; ++round) {
      const Numbers a = numbers(), b = numbers();
      Numbers c = numbers();
      c[static_cast<std::size_t>(round) % 4] = 0;  // not positive
      const auto plain = results<voussoir::detail::PlainLanes>(a, b, c);
      CHECK(results<voussoir::detail::VectorLanes>(a, b, c) == plain);
      for (std::size_t k = 0; k < a.size(); ++k) CHECK(plain[6][k] == (c[k] > 0 ? a[k] : b[k]));
      CHECK(plain[7][0] == (a[0] + a[2]) + (a[1] + a[3]));
    }
  }
}

}  // namespace lanes_test
