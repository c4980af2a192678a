// SPDX-License-Identifier: MIT
#pragma once

#include "input_section.hpp"

/// How a joint set lies, read from the file: dip and dip direction, and what people write instead.
namespace voussoir::program {

/// Declares and reads `dip` and `dip_direction`. Dips beyond 90 degrees, azimuths, "75/270", points
/// of the compass and words of other languages are refused with what they come to in the section.
void read_orientation(Section& s, JointSetInput& set, Need need);

}  // namespace voussoir::program
