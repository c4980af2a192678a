// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <voussoir/core/errors.hpp>

/// What a run says when it goes bad.
namespace voussoir_test {

/// The message of the fault that an action ends in; "" without.
template <class Action>
[[nodiscard]] std::string fault_of(Action&& action) {
  try {
    action();
  } catch (const voussoir::NumericalFault& fault) {
    return fault.what();
  }
  return "";
}

/// The message with which an action is refused; "" if it is not.
template <class Action>
[[nodiscard]] std::string refusal_of(Action&& action) {
  try {
    action();
  } catch (const voussoir::InvalidInput& refused) {
    return refused.what();
  }
  return "";
}

[[nodiscard]] inline bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace voussoir_test
