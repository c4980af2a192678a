// expect: two contact laws given
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
}  // namespace

using Broken = voussoir::Composition<voussoir::CoulombJoint, voussoir::CoulombJoint>;
static_assert(sizeof(Broken) > 0);
