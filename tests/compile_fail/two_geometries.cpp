// expect: two geometries given
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
}  // namespace

using Broken = voussoir::Composition<voussoir::Planar, voussoir::Planar>;
static_assert(sizeof(Broken) > 0);
