// SPDX-License-Identifier: MIT
// One of the sources of voussoir::design: the solver of this geometry whose models are chosen at
// run time.
#define VOUSSOIR_DESIGN_SPATIAL_TEMPLATE template
#include <voussoir/design/models.hpp>
