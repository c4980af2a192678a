// expect: two kinds of bolt anchors given
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
}  // namespace

using Broken = voussoir::Composition<voussoir::LorigAnchors, voussoir::GargaWangAnchors>;
static_assert(sizeof(Broken) > 0);
