// SPDX-License-Identifier: MIT
// Two joints cut a square of rock in four; and both source files have the same library.
#include <cstdio>
#include <vector>
#include <voussoir/voussoir.hpp>

const char* version_seen_by_other();

int main() {
  using namespace voussoir;
  const Domain<2> ground{Vec2(-5, -5), Vec2(5, 5)};
  const std::vector<Joint> joints = {{{Vec2(-9, 1), Vec2(9, 1)}, 0},
                                     {{Vec2(0, -9), Vec2(0, 9)}, 1}};
  const auto blocks = slice(ground, joints, {}).bodies.size();
  std::printf("voussoir %s: %zu blocks\n", VOUSSOIR_VERSION_STRING, blocks);
  return blocks == 4 && version == version_seen_by_other() ? 0 : 1;
}
