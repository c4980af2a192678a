// SPDX-License-Identifier: MIT
// Equivalent moduli of the jointed mass from one-dimensional compression: Table 3, G1 to G8.
#include <array>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/laboratory/oedometer.hpp>
#include <voussoir/rockmass/statistics.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

/// One compression to p0 and back.
struct Compression {
  OedometerResult loaded;
  double residual = 0;  ///< strain left without stress, over that under p0 [-]
};

Compression compressed(const RockMass<Planar>& mass, double friction_angle, Side loaded) {
  const CoulombJoint law({normal_stiffness, shear_stiffness, friction_angle});
  const OedometerParams params{.loaded = loaded};
  const double whole = ground_pressure / oedometer(mass, law, params).constrained_modulus;
  const auto path = compression_path(mass, law, {0.5 * whole, whole, 0.5 * whole, 0.1 * whole},
                                     TwoLevel{}, params);
  const OedometerResult &peak = path[1], &a = path[2], &b = path[3];
  // On the way down the line through the last two states meets zero stress at the residual strain.
  const double modulus = (a.stress_axial - b.stress_axial) / (a.strain - b.strain);
  return {peak, (b.strain - b.stress_axial / modulus) / peak.strain};
}

RockMass<Planar> square_sample(double side, std::uint64_t seed) {
  return sliced_rock(mass_a, seed, {Vec2(-0.5 * side, -0.5 * side), Vec2(0.5 * side, 0.5 * side)});
}

struct Case {
  const char* name;
  const char* what;
  double paper_modulus, paper_ratio;  ///< G [GPa], nu
};
constexpr std::array<Case, 6> cases{{{"G3", "whole section, vertical, 35°", 0.527, 0.37},
                                     {"G4", "whole section, vertical, 89°", 0.529, 0.37},
                                     {"G5", "20 m square, vertical, 35°", 0.542, 0.36},
                                     {"G6", "10 m square, vertical, 35°", 0.536, 0.36},
                                     {"G7", "whole section, horizontal, 35°", 0.649, 0.35},
                                     {"G8", "10 m square, horizontal, 35°", 0.648, 0.35}}};

}  // namespace

Section shear_moduli(Study& study) {
  Section section{
      "shear_moduli",
      "Equivalent moduli from compression",
      "5.1, Table 3",
      {"A platen presses one side of the rock to p0, all other sides are fixed and "
       "smooth; joints slip and open. G = (sigma_1 - sigma_3) / (2 eps_1), nu = sigma_3 "
       "/ (sigma_1 + sigma_3). Small samples are cut from rock of their own."}};
  const auto samples = static_cast<std::size_t>(study.samples());
  std::vector<std::array<Compression, 6>> results(samples);
  std::vector<double> spacing(samples), spacing_b(samples);
  std::vector<std::array<double, 3>> lines(samples);
  parallel_for(samples * 3, study.threads(), [&](std::size_t job) {
    const std::size_t k = job / 3;
    const std::uint64_t seed = k + 1;
    if (job % 3 == 0) {
      const auto mass = sliced_rock(mass_a, seed);
      results[k][0] = compressed(mass, friction, Side::top);
      results[k][1] = compressed(mass, 89 * degree, Side::top);
      spacing[k] = radial_spacing(mass, Vec2::Zero(), radius, 10);
      // Three scanlines of 10 m, as the paper has: to the sides and up.
      for (int l = 0; l < 3; ++l) {
        const Vec2 along(elementary::cosine(l * 90 * degree), elementary::sine(l * 90 * degree));
        lines[k][static_cast<std::size_t>(l)] =
            scanline_spacing(mass, Segment{radius * along, (radius + 10) * along});
      }
    } else if (job % 3 == 1) {
      results[k][4] = compressed(sliced_rock(mass_a, seed), friction, Side::right);
      spacing_b[k] = radial_spacing(sliced_rock(mass_b, seed), Vec2::Zero(), radius, 10);
    } else {
      const auto large = square_sample(20, seed), small = square_sample(10, seed);
      results[k][2] = compressed(large, friction, Side::top);
      results[k][3] = compressed(small, friction, Side::top);
      results[k][5] = compressed(small, friction, Side::right);
    }
  });
  const auto over = [&](const auto& value) {
    Measured m{.samples = study.samples()};
    for (std::size_t k = 0; k < samples; ++k) m.values.push_back(value(k));
    return m;
  };
  const auto modulus = [&](std::size_t c) {
    return over([&](std::size_t k) { return results[k][c].loaded.shear_modulus; });
  };
  const auto poisson = [&](std::size_t c) {
    return over([&](std::size_t k) { return results[k][c].loaded.poisson_ratio; });
  };
  const auto modulus_ratio = [&](std::size_t a, std::size_t b) {
    return over([&](std::size_t k) {
      return results[k][a].loaded.shear_modulus / results[k][b].loaded.shear_modulus;
    });
  };
  const double g1 = elastic_grounds()[0].ground.shear_modulus,
               g2 = elastic_grounds()[1].ground.shear_modulus;
  Table table{"Equivalent moduli", {"", "how", "G, GPa", "G, paper", "nu", "nu, paper"}, {}};
  table.rows.push_back({"G1", "k_s s, s = 0.77 m", printed_text(1e-9 * g1, 4), "0.385", "", "0.2"});
  table.rows.push_back(
      {"G2", "k_n s / (2 (1 + nu))", printed_text(1e-9 * g2, 4), "1.604", "", "0.2"});
  Series ours{"blocks", Mark::points, {}, {}, {}}, paper{"paper", Mark::points, {}, {}};
  Series low{"G_1", Mark::line, {2.5, 8.5}, {1e-9 * g1, 1e-9 * g1}};
  Series high{"G_2", Mark::line, {2.5, 8.5}, {1e-9 * g2, 1e-9 * g2}};
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const Measured g = modulus(c), nu = poisson(c);
    table.rows.push_back(
        {cases[c].name, cases[c].what,
         printed_text(1e-9 * g.mean(), 3) + " ± " + printed_text(1e-9 * g.deviation(), 1),
         printed_text(cases[c].paper_modulus, 3),
         printed_text(nu.mean(), 3) + " ± " + printed_text(nu.deviation(), 1),
         printed_text(cases[c].paper_ratio, 2)});
    const double x = 3 + static_cast<double>(c);
    ours.x.push_back(x - 0.08);
    ours.y.push_back(1e-9 * g.mean());
    ours.spread.push_back(1e-9 * g.deviation());
    paper.x.push_back(x + 0.08);
    paper.y.push_back(cases[c].paper_modulus);
  }
  section.tables.push_back(table);
  Series theory{"persistent joints, shear prevented", Mark::points, {}, {}};
  const double equal = 6 * joint_spacing / std::numbers::pi;
  const auto compliance =
      joint_compliance({{75 * degree, equal}, {25 * degree, equal}, {-25 * degree, equal}},
                       {normal_stiffness, shear_stiffness});
  const double g_v =
      oedometer_of(compliance, CompressedAlong::vertical, ShearCondition::prevented).shear_modulus;
  const double g_h =
      oedometer_of(compliance, CompressedAlong::horizontal, ShearCondition::prevented)
          .shear_modulus;
  for (const double x : {3.0, 4.0, 5.0, 6.0}) {
    theory.x.push_back(x);
    theory.y.push_back(1e-9 * g_v);
  }
  for (const double x : {7.0, 8.0}) {
    theory.x.push_back(x);
    theory.y.push_back(1e-9 * g_h);
  }
  Plot plot{
      "shear_moduli", "Equivalent shear modulus", "", "G, GPa", {ours, paper, theory, low, high}};
  plot.x_range = {{2.5, 8.5}};
  plot.y_range = {{0, 1.8}};
  plot.more = "set xtics ('G_3' 3, 'G_4' 4, 'G_5' 5, 'G_6' 6, 'G_7' 7, 'G_8' 8)\n";
  plot.caption =
      "Whole section vertically at 35° and 89° (G3, G4), squares of 20 m and 10 m (G5, G6), "
      "horizontally (G7, G8).";
  section.plots.push_back(plot);

  // ---- findings ----
  const Measured s = over([&](std::size_t k) { return spacing[k]; });
  const Measured three =
      over([&](std::size_t k) { return (lines[k][0] + lines[k][1] + lines[k][2]) / 3; });
  const Measured sb = over([&](std::size_t k) { return spacing_b[k]; });
  const bool spaced = std::abs(s.mean() / joint_spacing - 1) < 0.1;
  section.findings.push_back(
      {"PF-039", agrees_if(spaced),
       "72 radial scanlines of 10 m: " + s.text(1, "m") + "; three of them: " + three.text(1, "m"),
       spaced
           ? ""
           : "Mass A is read so that it has the paper's moduli. Mass B (joints of 2 m, inscribed "
             "radius 0.36 m) has " +
                 printed_text(sb.mean(), 3) +
                 " m but a G a quarter too high: both together would need joints that touch on "
                 "less than their face, or one contact point each."});
  section.findings.push_back(
      {"PF-040", agrees_if(std::abs(g1 / 0.385e9 - 1) < 1e-3 && std::abs(g2 / 1.604e9 - 1) < 1e-3),
       "G1 = " + printed_text(1e-9 * g1, 4) + ", G2 = " + printed_text(1e-9 * g2, 4) + " GPa"});
  section.findings.push_back({"PF-041", agrees_if(std::abs(g2 / g1 - 4.1667) < 1e-3),
                              "G2 / G1 = " + printed_text(g2 / g1, 5)});
  const Measured g3 = modulus(0), nu3 = poisson(0);
  section.findings.push_back(
      {"PF-042",
       agrees_if(std::abs(g3.mean() / 0.527e9 - 1) < 0.15 && std::abs(nu3.mean() - 0.37) < 0.02),
       "G3 = " + g3.text(1e-9, "GPa") + ", nu = " + printed_text(nu3.mean(), 3)});
  section.findings.push_back({"PF-043", agrees_if(g3.mean() > g1 && g3.mean() < g2),
                              printed_text(1e-9 * g1) + " < " + printed_text(1e-9 * g3.mean()) +
                                  " < " + printed_text(1e-9 * g2, 4) + " GPa"});
  const Measured rough = modulus_ratio(1, 0);
  section.findings.push_back({"PF-044", agrees_if(std::abs(rough.mean() - 1) < 0.02),
                              "G at 89° over G at 35°: " + rough.text(1, "", 5)});
  const Measured large = modulus_ratio(2, 0), small = modulus_ratio(3, 0);
  const bool size = std::abs(large.mean() - 1) < 0.1 && std::abs(small.mean() - 1) < 0.1;
  section.findings.push_back(
      {"PF-045", agrees_if(size),
       "over the whole section: 20 m " + large.text(1, "", 3) + ", 10 m " + small.text(1, "", 3),
       size ? ""
            : "Blocks along a flat wall are restrained more than those inside; they weigh more in "
              "a small sample."});
  const Measured across = modulus_ratio(4, 0), nu7 = poisson(4);
  section.findings.push_back(
      {"PF-046", agrees_if(across.mean() > 1.1 && across.mean() < 1.4 && nu7.mean() < nu3.mean()),
       "horizontal over vertical G: " + across.text(1, "", 3) + " (paper 1.231, joint compliance " +
           printed_text(g_h / g_v, 4) + "); nu " + printed_text(nu7.mean(), 3) + " against " +
           printed_text(nu3.mean(), 3)});
  const Measured strain = over([&](std::size_t k) {
    const auto& r = results[k][0].loaded;
    return r.strain * ground_pressure / r.stress_axial;
  });
  const Measured lateral = over([&](std::size_t k) {
    const auto& r = results[k][0].loaded;
    return r.stress_lateral * ground_pressure / r.stress_axial;
  });
  section.findings.push_back({"PF-047",
                              agrees_if(std::abs(strain.mean() / 2.593e-4 - 1) < 0.15 &&
                                        std::abs(lateral.mean() / 388.9e3 - 1) < 0.05),
                              "at 662 kPa: eps_1 = " + strain.text(1e4, "· 10⁻⁴", 4) +
                                  ", sigma_3 = " + printed_text(1e-3 * lateral.mean(), 4) +
                                  " kPa (paper 2.593, 388.9)"});
  const Measured left = over([&](std::size_t k) { return results[k][0].residual; });
  section.findings.push_back({"PF-048", agrees_if(std::abs(left.mean()) < 0.05),
                              "strain left after unloading: " + left.text(100, "% of eps_1", 2)});
  return section;
}

}  // namespace voussoir::paper
