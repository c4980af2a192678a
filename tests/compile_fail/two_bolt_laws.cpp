// expect: two bolt laws given
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
}  // namespace

using Broken = voussoir::Composition<voussoir::AxialBolt, voussoir::AxialShearBolt>;
static_assert(sizeof(Broken) > 0);
