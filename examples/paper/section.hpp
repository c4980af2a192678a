// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace voussoir::paper {

/// How a series is drawn.
enum class Mark {
  line,         ///< a theory; with spreads a mean, in a band of them
  dashed_line,  ///< another
  points,       ///< measured, with the standard deviation over realisations if there is one
  linked_points,
  bars,    ///< a histogram
  failed,  ///< tunnels that did not stand: red crosses
};

struct Series {
  std::string name;
  Mark mark = Mark::points;
  std::vector<double> x, y;
  std::vector<double> spread = {};  ///< empty, or one value a point
};

struct Plot {
  std::string name;  ///< of the files: letters, digits and underscores
  std::string title;
  std::string x_label, y_label;  ///< with units; gnuplot's enhanced text: "F/(p_0 D)"
  std::vector<Series> series;
  std::string caption = {};
  std::optional<std::pair<double, double>> x_range = {}, y_range = {};  ///< NaN: an open end
  bool logarithmic_x = false;
  std::string more = {};  ///< further lines for the gnuplot script, before `plot`
};

/// A picture that the toolkit draws itself, as SVG.
struct Picture {
  std::string name, svg, caption;
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Whether the measurement says what the paper says.
enum class Agreement { agrees, differs, not_testable };
[[nodiscard]] const char* to_string(Agreement agreement);

/// A claim of the paper and what was found.
struct Finding {
  std::string claim;  ///< "PF-042"
  Agreement agreement;
  std::string measured;
  std::string why = {};  ///< where it differs or cannot be tested: the cause
  /// The same run as the paper ran it, where the answer depends on it, and what it says then.
  std::string as_the_paper = {};
  std::optional<Agreement> agreement_as_the_paper = {};
};
/// Agreement of a measurement that can be true or false.
[[nodiscard]] inline Agreement agrees_if(bool holds) {
  return holds ? Agreement::agrees : Agreement::differs;
}

/// What an analysis shows: one section of the report. Text is plain, one entry a paragraph.
struct Section {
  std::string name;  ///< of the program and the files
  std::string title;
  std::string paper;  ///< where in the paper: "5.1, Table 3"; empty: not there
  std::vector<std::string> text;
  std::vector<Plot> plots = {};
  std::vector<Picture> pictures = {};
  std::vector<Table> tables = {};
  std::vector<Finding> findings = {};

  [[nodiscard]] std::string source() const {
    return paper.empty() ? "Not in the paper" : "Boon et al. (2015), " + paper;
  }
};

}  // namespace voussoir::paper
