// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>

namespace voussoir::program {

/// A script for a shell that completes verbs, their options and, behind `--set` and `--vary`, the
/// keys of an input file.
/// @param shell  "bash" or "zsh"
[[nodiscard]] std::string completion_script(const CLI::App& app, std::string_view shell);

}  // namespace voussoir::program
