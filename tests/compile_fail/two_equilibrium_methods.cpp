// expect: two equilibrium methods given
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
}  // namespace

using Broken = voussoir::Composition<voussoir::TwoLevel, voussoir::Explicit>;
static_assert(sizeof(Broken) > 0);
