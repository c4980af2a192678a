// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

// The one place that states the version: CMake reads these lines, a test compares the change log.
#define VOUSSOIR_VERSION_MAJOR 0
#define VOUSSOIR_VERSION_MINOR 1
#define VOUSSOIR_VERSION_PATCH 0
#define VOUSSOIR_VERSION_STRING "0.1.0"

namespace voussoir {

/// For run logs and result files: "major.minor.patch".
inline constexpr std::string_view version = VOUSSOIR_VERSION_STRING;

}  // namespace voussoir
