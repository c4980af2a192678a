// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/design/section_capacity.hpp>

namespace voussoir_test {

/// 1 m wide.
[[nodiscard]] inline voussoir::design::ConcreteSection plain(double thickness, double strength) {
  return {.thickness = thickness, .strength = strength};
}

/// 25 cm of C30 with two layers of mesh, not alike.
[[nodiscard]] inline voussoir::design::ConcreteSection reinforced() {
  voussoir::design::ConcreteSection s = plain(0.25, 30e6);
  s.bars = {{.area = 6e-4, .depth = 0.04}, {.area = 9e-4, .depth = 0.20}};
  return s;
}

}  // namespace voussoir_test
