// SPDX-License-Identifier: MIT
// A block of rock in its in-situ stress, solved by what the library holds.
#include <voussoir/voussoir.hpp>

#ifndef VOUSSOIR_COMPILED
#error "voussoir::compiled must define VOUSSOIR_COMPILED"
#endif

int main() {
  using namespace voussoir;
  const Domain<2> ground{Vec2(-5, -5), Vec2(5, 5)};
  Solver<> rock(slice(ground, std::vector<Joint>{}, {}), CoulombJoint({5e9, 5e8, 0.6}),
                {.density = 2700});
  return rock.equilibrium().verdict == Verdict::stable ? 0 : 1;
}
