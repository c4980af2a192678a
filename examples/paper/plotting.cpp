// SPDX-License-Identifier: MIT
#include "plotting.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>

namespace voussoir::paper {

namespace {

namespace files = std::filesystem;

/// A folder that is gone when we are.
class WorkFolder {
 public:
  WorkFolder() {
    std::random_device random;
    path_ = files::temp_directory_path() /
            ("voussoir-" + std::to_string(random()) + std::to_string(random()));
    files::create_directory(path_);
  }
  ~WorkFolder() {
    std::error_code error;
    files::remove_all(path_, error);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  [[nodiscard]] const files::path& path() const { return path_; }

 private:
  files::path path_;
};

std::string content_of(const files::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write(const files::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// In single quotes for the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// In double quotes for gnuplot.
std::string script_text(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

/// The colour of the k-th series: dark enough on white, apart for the colour-blind (Okabe and Ito).
const char* colour(std::size_t k) {
  static const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                  "#e69f00", "#56b4e9", "#444444"};
  return colours[k % std::size(colours)];
}

std::string drawn_as(const Series& s, std::size_t k) {
  const std::string paint = std::string(" lc rgb '") + colour(k) + "'";
  switch (s.mark) {
    case Mark::line:
      return "with lines lw 2" + paint;
    case Mark::dashed_line:
      return "with lines lw 2 dt (8,5)" + paint;
    case Mark::points:
      return (s.spread.empty() ? "with points ps 0.9 pt 7" : "with yerrorbars lw 1.4 ps 0.9 pt 7") +
             paint;
    case Mark::linked_points:
      return (s.spread.empty() ? "with linespoints lw 1.6 ps 0.9 pt 7"
                               : "with yerrorlines lw 1.6 ps 0.9 pt 7") +
             paint;
    case Mark::bars:
      return "with boxes" + paint + " fs solid 0.35 border" + paint;
    case Mark::failed:
      return "with points pt 2 ps 1.4 lw 2.5 lc rgb '#c00000'";
  }
  return "";
}

}  // namespace

void check_gnuplot() {
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0)
    throw std::runtime_error(
        "gnuplot, which draws the plots, cannot be run; Debian: apt-get install gnuplot-nox");
}

std::string plot_csv(const Plot& plot) {
  CsvTable table({"series", "x", "y", "spread"});
  for (const Series& s : plot.series) {
    if (s.x.size() != s.y.size() || (!s.spread.empty() && s.spread.size() != s.x.size()))
      throw InvalidInput("plot " + plot.name + ": series " + s.name + " has columns that differ");
    for (std::size_t k = 0; k < s.x.size(); ++k)
      table.add_row(s.name, s.x[k], s.y[k], s.spread.empty() ? 0.0 : s.spread[k]);
  }
  return table.text();
}

std::string plot_script(const Plot& plot) {
  std::string script =
      "reset\n# Draws " + plot.name + ".svg from " + plot.name + ".csv: gnuplot " + plot.name +
      ".gp\n" +
      "set terminal svg size 840,480 enhanced font 'Helvetica,14' background '#ffffff'\n"
      "set output '" +
      plot.name +
      ".svg'\n"
      "set encoding utf8\n"
      "set datafile separator comma\n"
      "set datafile missing 'nan'\n"
      "set title " +
      script_text(plot.title) + " font ',15'\n" + "set xlabel " + script_text(plot.x_label) +
      "\nset ylabel " + script_text(plot.y_label) +
      "\nset grid lc rgb '#d8d8d8'\nset border lw 1.2\nset tics nomirror\nset border 3\n"
      "set lmargin at screen 0.125\nset rmargin at screen 0.62\n"
      "set key at screen 0.64, screen 0.90 left top Left reverse spacing 1.25 samplen 2\n";
  const auto range = [](const char* axis, const std::pair<double, double>& r) {
    const auto end = [](double x) { return std::isnan(x) ? "*" : shortest_text(x); };
    return std::string("set ") + axis + "range [" + end(r.first) + ":" + end(r.second) + "]\n";
  };
  if (plot.x_range) script += range("x", *plot.x_range);
  if (plot.y_range) script += range("y", *plot.y_range);
  // Error bars of the last point keep off the edge.
  if (!plot.x_range && !plot.logarithmic_x) script += "set offsets 0, graph 0.02, 0, 0\n";
  if (plot.logarithmic_x) script += "set logscale x\nset format x '10^{%T}'\n";
  bool bars = false;
  for (const Series& s : plot.series) bars = bars || s.mark == Mark::bars;
  if (bars) script += "set boxwidth 0.95 relative\n";
  script += plot.more;
  const char* next = "plot ";
  std::size_t k = 0, first = 0;  // the rows of a series lie together
  for (const Series& s : plot.series) {
    if (s.x.empty()) continue;  // nothing failed, say
    const std::string rows = "'" + plot.name + ".csv' skip 1 every ::" + std::to_string(first) +
                             "::" + std::to_string(first + s.x.size() - 1) + " using 2:";
    first += s.x.size();
    if (s.mark == Mark::line && !s.spread.empty()) {
      script += next + rows + "($3-$4):($3+$4) with filledcurves fs transparent solid 0.18" +
                " noborder lc rgb '" + colour(k) + "' notitle";
      next = ", \\\n  ";
    }
    const bool error_bars =
        !s.spread.empty() && (s.mark == Mark::points || s.mark == Mark::linked_points);
    script += next + rows + (error_bars ? "3:4 " : "3 ") + drawn_as(s, k) + " title " +
              script_text(s.name);
    next = ", \\\n  ";
    k += s.mark != Mark::failed;
  }
  return script + "\n";
}

Drawings drawn(const std::vector<Section>& sections) {
  const WorkFolder folder;
  std::string command = "cd " + quoted(folder.path().string()) + " && gnuplot";
  Drawings drawings;
  for (const Section& section : sections)
    for (const Plot& plot : section.plots) {
      if (!drawings.emplace(plot.name, "").second)
        throw std::logic_error("two plots are called " + plot.name);
      write(folder.path() / (plot.name + ".csv"), plot_csv(plot));
      write(folder.path() / (plot.name + ".gp"), plot_script(plot));
      command.append(" ").append(quoted(plot.name + ".gp"));
    }
  if (drawings.empty()) return {};
  const int status = std::system((command + " 2> errors").c_str());
  for (auto& [name, drawing] : drawings) {
    drawing = content_of(folder.path() / (name + ".svg"));
    if (status != 0 || drawing.find("</svg>") == std::string::npos)
      throw std::runtime_error("gnuplot could not draw " + name + ": " +
                               content_of(folder.path() / "errors"));
  }
  return drawings;
}

std::map<std::string, std::string> plot_files(const std::vector<Section>& sections,
                                              const Drawings& drawings) {
  std::map<std::string, std::string> files;
  for (const Section& section : sections) {
    for (const Plot& plot : section.plots) {
      files[plot.name + ".svg"] = drawings.at(plot.name);
      files[plot.name + ".csv"] = plot_csv(plot);
      files[plot.name + ".gp"] = plot_script(plot);
    }
    for (const Picture& picture : section.pictures) files[picture.name + ".svg"] = picture.svg;
  }
  return files;
}

}  // namespace voussoir::paper
