// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

/// What is wrong with an input file, and where.
namespace voussoir::program {

/// One thing that is wrong with an input, and where.
struct InputError {
  std::string file;           ///< name of the file as the user gave it
  int line = 0;               ///< from 1; 0: the file as a whole, or an override
  int column = 0;             ///< in characters, from 1
  int width = 1;              ///< characters to underline
  std::string source_line;    ///< text of that line
  std::string override_text;  ///< "joint.kn=5e9" when an override is at fault, otherwise empty
  std::string key;            ///< "joint_set[0].dip"; empty: none is concerned
  std::string message;        ///< "joint.kn = 5e9 has no unit"
  std::string accepted;       ///< what to write instead; may be empty

  /// The message with its place, the line in question and what is accepted, as compilers do.
  [[nodiscard]] std::string text() const;
};

/// What is wrong with an input, in the order of its lines; `what()` holds the first `most_shown`
/// and how many there are.
class InputErrors : public std::runtime_error {
 public:
  /// A page of them: a file with more is not an input with slips.
  static constexpr std::size_t most_shown = 50;

  /// @param more  that were found besides
  /// @pre  errors is not empty
  explicit InputErrors(std::vector<InputError> errors, std::size_t more = 0);
  [[nodiscard]] const std::vector<InputError>& errors() const { return errors_; }
  [[nodiscard]] std::size_t more() const { return more_; }

 private:
  std::vector<InputError> errors_;
  std::size_t more_;
};

}  // namespace voussoir::program
