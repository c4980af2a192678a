// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "plotting.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

/// The analyses as pages of documentation, by file name: README.md with the assumptions, the
/// scoreboard and what differs; a page each (NAME.md) with its tables and claims; their pictures
/// (SVG).
/// @throws std::logic_error  a claim that no section or more than one section decides
[[nodiscard]] std::map<std::string, std::string> documentation_pages(
    const std::vector<Section>& sections, const Drawings& drawings, const Study& study);

}  // namespace voussoir::paper
