// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

/// Pictures of a run within the page of its report.
namespace voussoir::program::html {

/// An SVG document of the program as an element of a page: as wide as there is room, ids of its own
/// so that several can stand in one page, layers that the page's script can switch off.
/// @param prefix  of its ids, "picture-1-"
/// @return  empty if it is no SVG document
[[nodiscard]] std::string inline_svg(std::string_view document, std::string_view prefix);

/// The picture with a caption. Its number is that of its id.
/// @param caption      plain
/// @param with_layers  the reader can switch them off
[[nodiscard]] std::string figure(std::string_view document, const std::string& id,
                                 std::string_view caption, bool with_layers = false);

}  // namespace voussoir::program::html
