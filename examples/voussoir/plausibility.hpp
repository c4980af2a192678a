// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "input.hpp"

/// Values that are possible and not plausible: a unit that slipped by a thousand computes as well
/// as the right one, and often stands.
namespace voussoir::program {

/// Keys whose values are accepted but far from what rock, steel and concrete have, beside what is
/// common: "joint.kn = 5 MPa/m is unusual (common: 250 MPa/m to 200 GPa/m)".
///
/// What is common spans less than three powers of ten for every key, so that a common value times
/// or over a thousand is not. Stiffnesses in shear are held against those across, lengths of the
/// model against its opening.
[[nodiscard]] std::vector<std::string> unusual_values(const Input& input);

/// Everything that the values of a file give rise to saying, whatever is computed of it: these,
/// keys that are not used, and keys with a distribution that are at their medians.
[[nodiscard]] std::vector<std::string> warnings_about_values(const Input& input);

/// Those of some tables, "; " before each: what is likely to blame where they do not fit together.
/// @param tables  "model.", "joint_set"
[[nodiscard]] std::string unusual_among(const Input& input,
                                        std::initializer_list<std::string_view> tables);

/// What the in-situ stress does to joints and opening, before anything is computed: closures that
/// small displacements, and common sense, allow are small beside a block and beside the opening.
struct InSituClosure {
  double stress;      ///< p0, vertical, at the centre of the opening [Pa]
  double of_joints;   ///< p0 / kn, of the softest joints [m]
  double block;       ///< edge of the mean block [m]
  double of_opening;  ///< p0 D / E with E = kn s, D its breadth, s the spacing of joints [m]
  double opening;     ///< D [m]
  [[nodiscard]] bool is_large_for_blocks() const { return of_joints > 0.1 * block; }
  [[nodiscard]] bool is_large_for_opening() const { return of_opening > 0.02 * opening; }
};
/// @param stress   p0, vertical, at the centre of the opening [Pa], > 0
/// @param block    edge of the mean block [m]
/// @param spacing  of joints about the opening [m]; infinite: none
[[nodiscard]] InSituClosure in_situ_closure(const Input& input, double stress, double block,
                                            double spacing);
/// A sentence for each that is large.
[[nodiscard]] std::vector<std::string> remarks_on(const InSituClosure& closure);

/// Adds to a numerical fault which keys of the input are likely to blame.
template <class Compute>
auto naming_unusual_values(const Input& input, Compute&& compute) {
  try {
    return compute();
  } catch (const NumericalFault& fault) {
    std::string text = fault.what();
    for (const std::string& value : unusual_values(input)) text += "\n   = " + value;
    throw NumericalFault(text);
  }
}

}  // namespace voussoir::program
