// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Input files to begin with, which run as they are: `voussoir init`.
namespace voussoir::program {

struct Template {
  std::string_view name;      ///< "horseshoe"
  std::string_view sentence;  ///< what it is, for `--list`
};

[[nodiscard]] const std::vector<Template>& templates();

/// The file, with comments.
/// @pre there is such a template
[[nodiscard]] std::string template_text(std::string_view name);

}  // namespace voussoir::program
