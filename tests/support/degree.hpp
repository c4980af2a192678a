// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

namespace voussoir_test {

inline constexpr double degree = std::numbers::pi / 180;  ///< [rad]

}  // namespace voussoir_test
