// SPDX-License-Identifier: MIT
// The rock, its stress and the order of the steps: what all analyses of the paper share.
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/rockmass/statistics.hpp>
#include <voussoir/theory/initial_friction.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section rock_mass(Study& study) {
  Section section{"rock_mass",
                  "The rock, its stress and the order of steps",
                  "2.1, 4, Table 2, Fig. 1",
                  {"Mass A: one joint centre per square metre and set, joints of 1 m, inscribed "
                   "radius 0.25 m or more, elongation 5 or less, joints of all sets in one random "
                   "order. The stress is prescribed at the contacts, not simulated."}};
  struct Sampled {
    BlockSizes sizes;
    std::size_t not_whole = 0;
    std::map<int, Measured> dips;
    double joints_per_area = 0;
    InSituState hydrostatic{}, deep{}, half_enough{}, half_short{};
    Eigen::AlignedBox2d corners;  // of all blocks
  };
  const double needed = largest_initial_friction(0.5);
  const auto sampled = realise(study.realisations(), [&](std::uint64_t seed) {
    Sampled s;
    const auto mass = sliced_rock(mass_a, seed);
    s.sizes = block_sizes(mass);
    for (const auto& body : mass.bodies) s.not_whole += body.parts.size() != 1;
    std::size_t inside = 0;
    const auto joints = joint_network(joint_sets(mass_a), mass.domain, seed);
    for (const Joint& joint : joints) {
      const Vec2 middle = 0.5 * (joint.trace.start + joint.trace.end);
      if ((middle.array() < mass.domain.low.array()).any() ||
          (middle.array() > mass.domain.high.array()).any())
        continue;
      ++inside;
      const Vec2 along = joint.trace.end - joint.trace.start;
      s.dips[joint.set].values.push_back(std::atan(std::abs(along.y() / along.x())) / degree);
    }
    s.joints_per_area = static_cast<double>(inside) / mass.domain.size().prod() / 3;
    s.hydrostatic = in_situ_state(seed, 1, friction);
    s.deep = in_situ_state(seed, 1, friction, density * gravity * 30);
    for (const auto& body : mass.bodies)
      for (const auto& part : body.parts)
        for (const Vec2& corner : part.vertices()) s.corners.extend(corner);
    s.half_enough = in_situ_state(seed, 0.5, needed * 1.001);
    s.half_short = in_situ_state(seed, 0.5, needed * 0.8);
    return s;
  });
  const auto over = [&](const auto& value) {
    Measured m{.samples = study.samples()};
    for (const Sampled& s : sampled) m.values.push_back(value(s));
    return m;
  };
  const Variant bare{}, reference{.bolts = reference_bolts};
  const Variant untouched{.bolts = Bolts{}, .lining = Lining{}, .held = 1};
  study.prepare({bare, reference, untouched, reference.as_the_paper()});

  Table table{"Realisations of the rock", {"", "value"}, {}};
  const auto row = [&](const std::string& name, const std::string& value) {
    table.rows.push_back({name, value});
  };
  row("blocks before excavation",
      over([](const Sampled& s) { return static_cast<double>(s.sizes.count); }).text(1, "", 4));
  row("median block", over([](const Sampled& s) { return s.sizes.median; }).text(1, "m²"));
  row("vertical stress around the tunnel centre",
      over([](const Sampled& s) { return s.hydrostatic.vertical; }).text(1e-3, "kPa", 4));
  row("horizontal",
      over([](const Sampled& s) { return s.hydrostatic.horizontal; }).text(1e-3, "kPa", 4));
  row("worst block out of balance, over its weight",
      printed_text(1e13 * over([](const Sampled& s) { return s.hydrostatic.unbalance; }).mean(),
                   2) +
          " · 10⁻¹³");
  section.tables.push_back(table);
  // Convergence around the unsupported and the bolted opening, realisation 1 to n: what "Fig. 7"
  // shows.
  Plot wall{"wall_convergence",
            "Convergence of the bolted opening (7 m, 11.25°), every realisation",
            "angle from the right-hand springing, degrees",
            "convergence, mm",
            {}};
  for (const Outcome& o : study.of(reference)) {
    if (!o.stable() || o.seed > 6) continue;
    Series s{"realisation " + std::to_string(o.seed), Mark::line, {}, {}};
    for (double angle = 0; angle <= 360; angle += 5) {
      const double u = convergence_at(o.wall, angle * degree);
      if (!std::isfinite(u)) continue;
      s.x.push_back(angle);
      s.y.push_back(1e3 * u);
    }
    wall.series.push_back(s);
  }
  say_collapsed(wall, study, {{"with these bolts", reference}});
  wall.x_range = {{0, 360}};
  wall.y_range = {{0, NAN}};
  section.plots.push_back(wall);

  // ---- findings ----
  const double across = 2 * std::sqrt(circular_opening(diameter).area() / std::numbers::pi);
  section.findings.push_back(
      {"PF-001", agrees_if(std::abs(across / 10 - 1) < 0.01),
       "circle of the area of the 72-sided opening: " + printed_text(across, 4) + " m"});
  const Measured deep = over([](const Sampled& s) { return s.deep.vertical; });
  section.findings.push_back(
      {"PF-002", agrees_if(std::abs(deep.mean() / 1456785 - 1) < 0.01),
       "with 30 m of rock as a load on the 20 m that are modelled: mean vertical stress of the "
       "blocks within 5 m of the centre " +
           deep.text(1e-6, "MPa", 4) + "; 2700 · 9.81 · 55 = 1.457 MPa"});
  const Measured vertical = over([](const Sampled& s) { return s.hydrostatic.vertical; });
  const Measured gradient = over([](const Sampled& s) { return s.hydrostatic.gradient; });
  const double depth = vertical.mean() / gradient.mean();
  const double top = over([](const Sampled& s) { return s.corners.max().y(); }).mean();
  section.findings.push_back(
      {"PF-003", agrees_if(std::abs(top - radius - 20) < 1e-6 && std::abs(depth / 25 - 1) < 0.05),
       "highest corner of a block " + printed_text(top - radius, 4) +
           " m above the crown; vertical stress at the centre over its gradient: " +
           printed_text(depth) + " m of depth"});
  const Measured horizontal = over([](const Sampled& s) { return s.hydrostatic.horizontal; });
  section.findings.push_back({"PF-004", agrees_if(std::abs(vertical.mean() / 662e3 - 1) < 0.01),
                              "rho g z = " + printed_text(1e-3 * ground_pressure, 6) +
                                  " kPa; mean of the blocks within 5 m of the centre " +
                                  vertical.text(1e-3, "kPa", 4)});
  double nearest = 1e9, farthest = 0;  // sides and base, from the wall
  for (const Sampled& s : sampled)
    for (const double edge : {-s.corners.min().x(), s.corners.max().x(), -s.corners.min().y()}) {
      nearest = std::min(nearest, edge - radius);
      farthest = std::max(farthest, edge - radius);
    }
  section.findings.push_back(
      {"PF-005", agrees_if(std::abs(nearest - 30) < 1e-6 && std::abs(farthest - 30) < 1e-6),
       "outermost corners of blocks at the sides and below: " + printed_text(nearest, 4) + " to " +
           printed_text(farthest, 4) + " m from the wall, all realisations"});
  const Measured change =
      study.measure(reference, [](const Outcome& o) { return o.boundary_change; });
  section.findings.push_back(
      {"PF-006", agrees_if(change.mean() < 0.05),
       "mean change of the normal stress at sides and base: " + change.text(100, "%", 2)});
  section.findings.push_back(
      {"PF-007",
       agrees_if(std::abs(horizontal.mean() / vertical.mean() - 1) < 0.05 &&
                 std::abs(gradient.mean() / (density * gravity) - 1) < 0.05),
       "horizontal over vertical " + printed_text(horizontal.mean() / vertical.mean(), 4) +
           ", gradient " + gradient.text(1e-3, "kPa/m", 4) + " (rho g = 26.49)"});
  const Measured at_rest = study.measure(
      untouched, [](const Outcome& o) { return std::max(o.largest_force(), o.largest_thrust()); });
  section.findings.push_back(
      {"PF-008", agrees_if(at_rest.mean() < 100),
       "support installed with the whole traction still on the wall: largest force in bolts and "
       "lining " +
           printed_text(1e9 * at_rest.mean(), 1) + " nN; it starts from the excavation"});
  const Measured enough = over([](const Sampled& s) { return s.half_enough.drift; });
  const Measured short_of = over([](const Sampled& s) { return s.half_short.drift; });
  section.findings.push_back(
      {"PF-009", needed_friction_agrees(enough.mean(), short_of.mean()),
       "K0 = 0.5 needs " + printed_text(needed / degree, 4) + "°: " +
           (short_of.mean() > no_motion
                ? "with it blocks move " + power_text(enough.mean() / short_of.mean(), 0) +
                      " times as far as with four fifths of it, " +
                      printed_text(1e9 * short_of.mean(), 2) + " nm"
                : std::string("blocks stay where they are, with it and with four fifths of it")) +
           ". The stress is prescribed, so no angle is needed on the way.",
       short_of.mean() > no_motion
           ? ""
           : "No joint of these realisations is inclined so that four fifths of the angle let it slip."});
  const Measured unbalance = study.measure(
      reference.as_the_paper(), [](const Outcome& o) { return o.report.unbalance_over_weight; });
  const Measured crowns = study.measure(reference, crown);
  const Measured crowns_sudden = study.measure(reference.as_the_paper(), crown);
  section.findings.push_back(
      {"PF-010", agrees_if(unbalance.mean() < 0.01),
       "the search needs none; explicit stepping with local damping of 0.1 ends with the worst "
       "block out of balance by " +
           unbalance.text(100, "% of its weight", 2),
       "",
       "crown " + printed_text(1e3 * crowns_sudden.mean()) + " mm against " +
           printed_text(1e3 * crowns.mean()) + " mm: how it is damped is part of the answer"});
  section.findings.push_back(
      {"PF-011", Agreement::not_testable, "three unknowns a block, none out of the plane",
       "A plane model has no motion out of its plane that could be zero; a 3-D slice with "
       "that motion fixed is compared with it in tests/solver/spatial_test.cpp."});
  const CoulombJoint law({normal_stiffness, shear_stiffness, friction});
  const auto force = [&](double opening, double slip) {
    PointMotion<2> motion{};
    motion.opening = opening;
    motion.slip << slip;
    return law.force(PointLoad<2>{1.0, {}, motion}, CoulombJoint::State<2>{});
  };
  const double kn = force(-1e-4, 0).normal / 1e-4;
  const double ks = std::abs(force(-1e-4, 1e-6).tangential[0]) / 1e-6;
  const double limit = std::abs(force(-1e-4, 1).tangential[0]) / force(-1e-4, 1).normal;
  section.findings.push_back(
      {"PF-012",
       agrees_if(std::abs(kn / 5e9 - 1) < 1e-9 && std::abs(ks / 5e8 - 1) < 1e-9 &&
                 std::abs(limit / elementary::tangent(friction) - 1) < 1e-9),
       "one point of 1 m: k_n " + printed_text(1e-9 * kn, 4) + ", k_s " +
           printed_text(1e-9 * ks, 4) + " GPa/m, shear stops at " +
           printed_text(std::atan(limit) / degree, 4) + "°"});
  const Measured whole = over([](const Sampled& s) { return static_cast<double>(s.not_whole); });
  section.findings.push_back({"PF-013", agrees_if(whole.mean() == 0),
                              printed_text(whole.mean(), 1) +
                                  " blocks of more than one convex part before excavation; "
                                  "joints end at faces of blocks"});
  const double at_slip = force(-1e-4, 1).normal, before_slip = force(-1e-4, 0).normal;
  section.findings.push_back(
      {"PF-014",
       agrees_if(std::abs(kn / 5e9 - 1) < 1e-9 && std::abs(ks / 5e8 - 1) < 1e-9 &&
                 std::abs(std::atan(limit) - 35 * degree) < 1e-9 &&
                 std::abs(at_slip / before_slip - 1) < 1e-12 &&
                 std::abs(gradient.mean() / gravity / 2700 - 1) < 0.05),
       "k_n, k_s and friction as above; a slip of 1 m changes the normal force by " +
           printed_text(std::abs(at_slip / before_slip - 1), 1) +
           " of it (no dilation); gradient of the stress over g: " +
           printed_text(gradient.mean() / gravity, 4) + " kg/m³"});
  section.findings.push_back({"PF-015", agrees_if(std::abs(kn / ks - 10) < 1e-6),
                              "k_n / k_s = " + printed_text(kn / ks, 4)});
  std::string dips;
  bool dips_hold = true;
  for (const auto& [set, dip] : std::map<int, double>{{0, 75}, {1, 25}, {2, 25}}) {
    std::vector<double> all;
    for (const Sampled& s : sampled) {
      const auto& values = s.dips.at(set).values;
      all.insert(all.end(), values.begin(), values.end());
    }
    const Measured m{.values = all};
    dips += (dips.empty() ? "" : ", ") + printed_text(m.mean(), 4) + " ± " +
            printed_text(m.deviation(), 2);
    dips_hold = dips_hold &&
                std::abs(m.mean() - dip) < 3 / std::sqrt(static_cast<double>(all.size())) &&
                std::abs(m.deviation() - 1) < 0.05;
  }
  const Measured density_of = over([](const Sampled& s) { return s.joints_per_area; });
  const Measured smallest =
      over([](const Sampled& s) { return s.sizes.smallest_inscribed_radius; });
  section.findings.push_back(
      {"PF-016",
       agrees_if(dips_hold && std::abs(density_of.mean() - 1) < 0.05 && smallest.mean() >= 0.5),
       "dips " + dips + "°, centres " + printed_text(density_of.mean()) +
           " per m², smallest inscribed radius " + printed_text(smallest.mean()) + " m",
       "Read as a radius, 0.5 m allows no mean spacing below pi r / 2 = 0.785 m, more than the 0.77 m "
       "that the paper measured. It is read as a diameter."});
  section.findings.push_back(
      {"PF-017", agrees_if(at_rest.mean() < 100),
       "all of the in-situ traction is on the wall when support goes in, before the rock moves: its "
       "forces then are " +
           printed_text(1e9 * at_rest.mean(), 1) + " nN"});
  section.findings.push_back(
      {"PF-018", Agreement::not_testable, "a search for equilibrium has no time steps",
       "Explicit stepping evaluates bolts and lining with the contacts, once a step, before the motion; "
       "no measurement of a result could tell."});
  return section;
}

}  // namespace voussoir::paper
