// SPDX-License-Identifier: MIT
// One of the two sources of voussoir::compiled: what the headers list for this geometry.
#define VOUSSOIR_PLANAR_TEMPLATE template
#include <voussoir/voussoir.hpp>
