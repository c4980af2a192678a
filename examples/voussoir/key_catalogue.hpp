// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "input_section.hpp"

/// All keys that an input file may have, as the readers declare them: for the schema that editors
/// complete and check files by, for `voussoir explain`, for the completion of a shell, and for the
/// tests that hold docs/input.md against them.
namespace voussoir::program {

/// What the readers ask for as they go through a document; most of what it lacks is asked for as
/// well. Faults of the document are not reported.
/// @throws InputErrors  the text is no TOML
[[nodiscard]] std::vector<DeclaredKey> keys_of_readers(std::string_view text);

/// Every key once, sorted, those of laid blocks as well. Required are those that any document with
/// their table needs.
[[nodiscard]] const std::vector<DeclaredKey>& key_catalogue();

/// JSON schema (draft 7) of an input file.
[[nodiscard]] std::string schema_json();

}  // namespace voussoir::program
