// expect: two contact detectors given
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
}  // namespace

using Broken = voussoir::Composition<voussoir::CutContacts, voussoir::CutContacts>;
static_assert(sizeof(Broken) > 0);
