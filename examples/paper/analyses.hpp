// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

/// Every analysis of the paper, in its order, and what its answers depend on. Each is one function
/// in a file of its own name, one program `paper_<name>`, and one section of the report of
/// `voussoir paper`.
namespace voussoir::paper {

class Study;     // study.hpp
struct Section;  // section.hpp

Section rock_mass(Study& study);
Section failure_patterns(Study& study);
Section bolt_model(Study& study);
Section shear_moduli(Study& study);
Section bolt_forces(Study& study);
Section anchor_strategies(Study& study);
Section bolt_spacing(Study& study);
Section normalised_forces(Study& study);
Section pretension(Study& study);
Section force_histograms(Study& study);
Section lining_thrust(Study& study);
Section bending_stiffness(Study& study);
Section lining_thickness(Study& study);
Section interaction(Study& study);
Section softer_bolts(Study& study);
Section stress_ratio(Study& study);
Section delayed_support(Study& study);
Section solution_checks(Study& study);

using Analysis = Section (*)(Study&);
struct NamedAnalysis {
  const char* name;
  Analysis run;
};
[[nodiscard]] const std::vector<NamedAnalysis>& analyses();

}  // namespace voussoir::paper
