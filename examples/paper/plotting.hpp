// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "section.hpp"

/// Plots are drawn by gnuplot: the script that is kept beside the data is the one that made the
/// picture.
namespace voussoir::paper {

/// @throws std::runtime_error  gnuplot cannot be run; names the package to install
void check_gnuplot();

/// The data of a plot: columns series, x, y, spread.
[[nodiscard]] std::string plot_csv(const Plot& plot);
/// A script that draws NAME.svg from NAME.csv, both in the folder it is run in.
[[nodiscard]] std::string plot_script(const Plot& plot);

/// SVG documents by the name of their plot.
using Drawings = std::map<std::string, std::string>;
/// Draws all plots of sections.
/// @throws std::logic_error    two plots of one name
/// @throws std::runtime_error  gnuplot failed: its own words
[[nodiscard]] Drawings drawn(const std::vector<Section>& sections);

/// Every plot with its data and script, every picture: contents by file name.
[[nodiscard]] std::map<std::string, std::string> plot_files(const std::vector<Section>& sections,
                                                            const Drawings& drawings);

}  // namespace voussoir::paper
