// expect-success
// SPDX-License-Identifier: MIT
// Proves that the driver finds the headers and Eigen: without it, a misuse could "fail" for any
// reason.
#include <Eigen/Core>
#include <voussoir/core/version.hpp>

static_assert(!voussoir::version.empty());
static_assert(Eigen::Vector2d::RowsAtCompileTime == 2);
