// SPDX-License-Identifier: MIT
#pragma once

#include "input_section.hpp"

/// How a joint set lies, read from the file: dip and dip direction, and what people write instead.
namespace voussoir::program {

/// Declares and reads `dip` and `dip_direction`. Dips beyond 90 degrees, "75/270" and words of
/// other languages are refused with what they come to.
void read_orientation(Section& s, JointSetInput& set, Need need);

}  // namespace voussoir::program
