// expect-success
// SPDX-License-Identifier: MIT
// Proves that the driver finds the headers and Eigen: without it, a misuse could "fail" for any reason.
#include <voussoir/core/version.hpp>

#include <Eigen/Core>

static_assert(!voussoir::version.empty());
static_assert(Eigen::Vector2d::RowsAtCompileTime == 2);
