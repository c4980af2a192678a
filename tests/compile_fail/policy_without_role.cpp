// expect: a policy fills no role
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Stray {};
}  // namespace

using Broken = voussoir::Composition<Stray>;
static_assert(sizeof(Broken) > 0);
