// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "plotting.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

/// What all analyses assume, one a line: the first page of the report.
[[nodiscard]] const std::vector<std::string>& assumptions();

/// One page that needs no other file.
[[nodiscard]] std::string report_html(const std::vector<Section>& sections,
                                      const Drawings& drawings, const Study& study);

}  // namespace voussoir::paper
