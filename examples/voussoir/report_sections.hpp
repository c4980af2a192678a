// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report_files.hpp"
#include "report_page.hpp"

/// What a report says of results: values of their files, with units and in words.
namespace voussoir::program {

using Json = nlohmann::json;

// Values by their JSON pointer, "/convergence/crown_mm". What is not there, or is another kind of
// value, is not a number, an empty text, an empty list.
[[nodiscard]] double number_at(const Json& json, const std::string& pointer);
[[nodiscard]] std::string words_at(const Json& json, const std::string& pointer);
[[nodiscard]] Json list_at(const Json& json, const std::string& pointer);
[[nodiscard]] bool holds_at(const Json& json, const std::string& pointer);  ///< true, and there

// Numbers as people read them; a dash where there is none.
[[nodiscard]] std::string shown(double value, int digits = 3);  ///< whole ones as they are
[[nodiscard]] std::string shown_given(double value);            ///< as an input has it: "0.5", "5"
[[nodiscard]] std::string shown_fixed(double value, int decimals);
[[nodiscard]] std::string shown_percent(double share, int digits = 2);  ///< "19 %"
[[nodiscard]] std::string shown_power(double value);                    ///< "3.8 × 10⁻⁵"
/// "12 blocks", "1 block"
[[nodiscard]] std::string shown_count(std::size_t count, const std::string& thing);

/// A run as its sections read it.
struct RunResults {
  explicit RunResults(const ReportFiles& of) : files(of), run(of.json("run.json")) {}
  const ReportFiles& files;
  Json run;
  [[nodiscard]] bool is_spatial() const { return number_at(run, "/dimension") == 3; }
  [[nodiscard]] bool is_laid() const { return run.contains("loads_on_fixed_blocks"); }
  [[nodiscard]] std::string verdict() const { return words_at(run, "/verdict"); }
  [[nodiscard]] double detached() const {  ///< [m2], [m3]; not a number of laid blocks
    return number_at(run, is_spatial() ? "/detached_volume_m3" : "/detached_area_m2");
  }
  [[nodiscard]] const char* measure() const { return is_spatial() ? "m³" : "m²"; }
};

/// Verdict, title and the three numbers at the head.
[[nodiscard]] html::Page run_head(const RunResults& results);

/// The largest convergence of the wall, and where.
struct LargestConvergence {
  double millimetres;  ///< not a number: no wall was measured
  std::string place;   ///< "crown"
};
[[nodiscard]] LargestConvergence largest_convergence(const Json& run);

/// How much would come off by other ways of looking for it; empty: that was not looked at.
[[nodiscard]] std::string marginal_sentence(const RunResults& results);

/// What is left out of a table, and where it is; empty: nothing.
[[nodiscard]] std::string left_out(std::size_t all, std::size_t shown_of_them,
                                   const std::string& file);

// Sections of a run; without a body where there is nothing to say.
[[nodiscard]] html::Section picture_section(const RunResults& results);
[[nodiscard]] html::Section strength_section(const RunResults& results);
[[nodiscard]] html::Section detached_section(const RunResults& results);
[[nodiscard]] html::Section history_section(const RunResults& results);
[[nodiscard]] html::Section basis_section(const RunResults& results);
[[nodiscard]] html::Section inputs_section(const RunResults& results);
[[nodiscard]] html::Section checks_section(const RunResults& results);
[[nodiscard]] html::Section limits_section(const RunResults& results);
[[nodiscard]] html::Section reproduce_section(const RunResults& results);

// Sections of what other verbs wrote, beside a run or alone.
[[nodiscard]] html::Section safety_section(const ReportFiles& files);
[[nodiscard]] html::Section realisations_section(const ReportFiles& files);
[[nodiscard]] html::Section design_section(const ReportFiles& files);
[[nodiscard]] html::Section diagram_section(const ReportFiles& files);
[[nodiscard]] html::Section sweep_section(const ReportFiles& files);

/// The page of a folder of results.
/// @throws InvalidInput  a file is damaged
[[nodiscard]] std::string report_page(const ReportFiles& files);

}  // namespace voussoir::program
