// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "input_document.hpp"
#include "uncertain_key.hpp"

/// How a distribution stands in an input file.
namespace voussoir::program {

/// What to write, in words.
extern const char* const distribution_form;

/// Takes what is wrong with a distribution: where, of which key, what, and what is accepted.
using RefuseDistribution =
    std::function<void(const Place&, const std::string&, const std::string&, const std::string&)>;

/// Reads a table as the distribution of a key.
/// @return  nothing if it is none, and `refuse` was told why
[[nodiscard]] std::optional<UncertainKey> uncertain_key(const Node& table, const std::string& key,
                                                        const RefuseDistribution& refuse);

}  // namespace voussoir::program
