// expect: two linings given
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
}  // namespace

using Broken = voussoir::Composition<voussoir::EulerBernoulliBeam, voussoir::TimoshenkoBeam>;
static_assert(sizeof(Broken) > 0);
