// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/vec.hpp>

namespace voussoir {

/// A straight piece of line in 3-D: a bolt, a scanline.
struct SpatialLine {
  Vec3 start, end;  ///< [m]

  [[nodiscard]] double length() const { return length_of(end - start); }
  [[nodiscard]] Vec3 at(double t) const { return start + t * (end - start); }
};

}  // namespace voussoir
