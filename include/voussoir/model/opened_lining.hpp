// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// What a further round has taken out of a lining that stood: where a second opening meets it, it
/// is opened, and ends at the cut.
template <int Dim>
struct OpenedLining {
  int lining = 0;              ///< in the order of installation, from 0
  int nodes = 0;               ///< taken out
  int members = 0;             ///< taken out, those that joined it to another lining included
  bool is_gone = false;        ///< nothing of it is left
  std::vector<Vec<Dim>> ends;  ///< its nodes at the cut, which hang free there [m]
};

}  // namespace voussoir
