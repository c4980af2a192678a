// SPDX-License-Identifier: MIT
// One of the two sources of voussoir::compiled: what solver/compiled.hpp lists for this geometry.
#define VOUSSOIR_PLANAR_TEMPLATE template
#include <voussoir/solver/compiled.hpp>
