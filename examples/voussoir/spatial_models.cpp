// SPDX-License-Identifier: MIT
#include "models.hpp"

template class voussoir::ComposedSolver<voussoir::program::SpatialTunnel::Parts::Models>;
