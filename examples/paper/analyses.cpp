// SPDX-License-Identifier: MIT
#include "analyses.hpp"

#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

const char* to_string(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::differs:
      return "differs";
    case Agreement::not_testable:
      return "not testable";
  }
  return "";
}

const std::vector<NamedAnalysis>& analyses() {
  static const std::vector<NamedAnalysis> all{
      {"rock_mass", rock_mass},
      {"failure_patterns", failure_patterns},
      {"bolt_model", bolt_model},
      {"shear_moduli", shear_moduli},
      {"bolt_forces", bolt_forces},
      {"anchor_strategies", anchor_strategies},
      {"bolt_spacing", bolt_spacing},
      {"normalised_forces", normalised_forces},
      {"pretension", pretension},
      {"force_histograms", force_histograms},
      {"lining_thrust", lining_thrust},
      {"bending_stiffness", bending_stiffness},
      {"lining_thickness", lining_thickness},
      {"interaction", interaction},
      {"softer_bolts", softer_bolts},
      {"stress_ratio", stress_ratio},
      {"delayed_support", delayed_support},
      {"solution_checks", solution_checks},
  };
  return all;
}

}  // namespace voussoir::paper
