// SPDX-License-Identifier: MIT
#pragma once

namespace voussoir {

/// From where a picture shows a tunnel in 3-D, and which rock it leaves out to show the rest.
enum class ViewFrom {
  axis,  ///< from the right and a little above, cut open along the axis by an upright plane
  face,  ///< from the portal along the axis, cut across just before the face
  above  ///< from above, the axis from left to right, cut open through the springing
};

}  // namespace voussoir
