// SPDX-License-Identifier: MIT
#pragma once

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
/// Draws plots, in the order given.
/// @throws std::runtime_error  gnuplot failed: its own words
[[nodiscard]] std::vector<std::string> drawn(const std::vector<Plot>& plots);

}  // namespace voussoir::paper
