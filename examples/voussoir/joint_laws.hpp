// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/contact/any_joint.hpp>

#include "input.hpp"
#include "input_section.hpp"

/// The contact laws that an input file may give joints: a row for each, from which the reader, its
/// messages, what is called unusual, the outputs and the tables of docs/input.md are made.
namespace voussoir::program {

/// What a law takes as its parameters.
struct LawParameter {
  std::string_view key;
  Dimension dimension;  ///< `dimension::number`: a bare number
  Range range;
  /// What is common, in the same unit, less than a factor of 1000 apart; where `beside` names a
  /// parameter, over its value.
  double common_low, common_high;
  bool is_common_at_zero = false;
  std::string_view beside = {};
  std::string_view sentence = {};
  /// Where the file does not give it; none: it must, unless `as` names a parameter.
  std::optional<double> otherwise = {};
  std::string_view as = {};  ///< whose value it has otherwise
};

/// What is wrong with values each of which is within its range.
struct LawFault {
  std::string_view key;
  std::string complaint;  ///< follows the key and its value
  std::string accepted;
};

struct JointLawRow {
  std::string_view word;      ///< in the file
  std::string_view sentence;  ///< for docs/input.md
  std::vector<LawParameter> parameters;
  /// @pre all parameters are within their ranges
  std::optional<LawFault> (*fault)(const JointLawInput&);
  AnyJoint (*make)(const JointLawInput&);

  [[nodiscard]] const LawParameter* find(std::string_view key) const;
};

[[nodiscard]] const std::vector<JointLawRow>& joint_law_rows();
/// @pre there is such a law
[[nodiscard]] const JointLawRow& joint_law_row(std::string_view word);

/// Reads a table [joint], or what a [[joint_set]] says in its place.
/// @param common  what holds where the table says nothing; null: there is nothing
/// @return  with every parameter of the law, but for those that are at fault; `given` is empty
///          where the table says nothing of the law
[[nodiscard]] JointLawInput read_joint_law(Section& s, const JointLawInput* common);

/// The law of the joints of a set. @param set  index; -1: of none
[[nodiscard]] const JointLawInput& law_of_set(const Input& input, int set);
/// Those that joints have: of [joint], unless all sets have their own, then of these.
[[nodiscard]] std::vector<const JointLawInput*> laws_in_use(const Input& input);

[[nodiscard]] AnyJoint joint_of(const JointLawInput& law);
/// The least `friction_angle_at` a stress among the laws in use [rad].
[[nodiscard]] double least_friction_angle(const Input& input, double stress);

/// "kn 5 GPa/m, ks 500 MPa/m, friction 35 deg"; laws other than the first row's begin with their
/// word. What has its default is left out.
[[nodiscard]] std::string law_text(const JointLawInput& law);
/// Name of a parameter in a JSON file, with its unit: "kn_Pa_per_m".
[[nodiscard]] std::string json_name(const LawParameter& parameter);
/// In the unit of that name.
[[nodiscard]] double json_value(const LawParameter& parameter, double value);

/// The tables of docs/input.md, one for each law.
[[nodiscard]] std::string joint_law_page();

}  // namespace voussoir::program
