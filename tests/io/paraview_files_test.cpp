// SPDX-License-Identifier: MIT
// Bolts, linings and joints of a tunnel in 3-D as files for ParaView. That VTK reads them back is
// tried by tests/vtk/run.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>
#include <voussoir/core/invariants.hpp>
#include <voussoir/io/paraview_files.hpp>
#include <voussoir/rockmass/laid_blocks.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "io/xml_check.hpp"
#include "support/blocks.hpp"
#include "support/jointed_mass.hpp"
#include "support/near.hpp"

namespace paraview_files_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::near;

namespace {

using Cavern = Solver<Spatial>;

/// A data array, its attributes and its numbers.
struct DataArray {
  std::size_t components = 0;
  std::vector<double> numbers;
};

std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) return "";
  const std::size_t from = at + name.size() + 3;
  return tag.substr(from, tag.find('"', from) - from);
}

/// A .vtu as a reader takes it.
struct Grid {
  std::size_t points = 0, cells = 0;
  std::map<std::string, DataArray> arrays;
  std::set<std::string> of_cells, of_points;

  explicit Grid(const std::string& text) {
    std::string section;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
      const std::size_t end = text.find('>', at);
      const std::string tag = text.substr(at, end - at);
      at = end;
      if (tag.starts_with("<Piece")) {
        points = std::stoul(attribute(tag, "NumberOfPoints"));
        cells = std::stoul(attribute(tag, "NumberOfCells"));
      }
      for (const char* const name : {"Points", "Cells", "CellData", "PointData"})
        if (tag == std::string("<") + name) section = name;
      if (!tag.starts_with("<DataArray")) continue;
      const std::string name = attribute(tag, "Name");
      DataArray& array = arrays[name];
      array.components = std::stoul(attribute(tag, "NumberOfComponents"));
      const std::string numbers = text.substr(end + 1, text.find("</DataArray>", end) - end - 1);
      const char* p = numbers.c_str();
      for (char* next = nullptr;; p = next) {
        const double x = std::strtod(p, &next);
        if (next == p) break;
        array.numbers.push_back(x);
      }
      if (section == "CellData") of_cells.insert(name);
      if (section == "PointData") of_points.insert(name);
    }
  }
  [[nodiscard]] const std::vector<double>& operator[](const std::string& name) const {
    return arrays.at(name).numbers;
  }
  [[nodiscard]] Vec3 point(std::size_t k) const {
    const std::vector<double>& p = (*this)["Points"];
    return {p[3 * k], p[3 * k + 1], p[3 * k + 2]};
  }
  /// The points of a cell, in their order.
  [[nodiscard]] std::vector<Vec3> corners(std::size_t cell) const {
    std::vector<Vec3> all;
    const auto end = static_cast<std::size_t>((*this)["offsets"][cell]);
    for (auto k = cell == 0 ? 0 : static_cast<std::size_t>((*this)["offsets"][cell - 1]); k < end;
         ++k)
      all.push_back(point(static_cast<std::size_t>((*this)["connectivity"][k])));
    return all;
  }
};

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// As a file must be that VTK takes: all counts agree, every index is of a point.
void check_whole(const std::string& text) {
  CHECK(xml_fault(text) == "");
  const Grid grid(text);
  REQUIRE(grid.cells > 0);
  CHECK(grid["Points"].size() == 3 * grid.points);
  CHECK(grid["offsets"].size() == grid.cells);
  CHECK(grid["types"].size() == grid.cells);
  CHECK(std::is_sorted(grid["offsets"].begin(), grid["offsets"].end()));
  CHECK(grid["offsets"].back() == static_cast<double>(grid["connectivity"].size()));
  for (const double k : grid["connectivity"]) CHECK(k < static_cast<double>(grid.points));
  for (const std::string& name : grid.of_cells) {
    CAPTURE(name);
    CHECK(grid[name].size() == grid.arrays.at(name).components * grid.cells);
    CHECK(name.find_first_of(" []/") == std::string::npos);
  }
  for (const std::string& name : grid.of_points) {
    CAPTURE(name);
    CHECK(grid[name].size() == grid.arrays.at(name).components * grid.points);
  }
}

/// A tunnel of 4 m with bolts and four strips of shotcrete 1 m wide, in two rounds of lining.
struct Case {
  Cavern tunnel;
  std::map<std::string, std::string> files;
};
const Case& built() {
  static const Case once = [] {
    const PrismaticOpening opening(circular_opening(4, 12));
    const CoulombJoint joints({5e9, 5e8, 40 * degree});
    Case made{Cavern(voussoir_test::jointed_mass({{-6, 0, -6}, {6, 4, 7}}, 2, 1.5), joints,
                     {.density = 2700, .surcharge = 5e5}),
              {}};
    const LiningInstallation<Cavern> lining{
        {},
        {LiningSection::strip(0.15, 1, 25e9), LiningSection::strip(0.15, 0.5, 25e9)},
        CoulombJoint({5e9, 5e9, 35 * degree})};
    Construction<Cavern> plan;
    auto near_end = lining, far_end = lining;
    near_end.layout = LiningRibs{.ring = {.nodes = 24}, .spacing = 1, .to = 2};
    far_end.layout = LiningRibs{.ring = {.nodes = 24}, .spacing = 1, .from = 2};
    plan.add_stage("all")
        .excavate(opening)
        .install_bolts({bolt_bars({.length = 2, .angular_spacing = 45 * degree}, opening, 2, 0, 4),
                        AxialBolt({.axial_stiffness = 2e8, .pretension = 1e4})})
        .install_lining(near_end)
        .install_lining(far_end);
    REQUIRE(construct(made.tunnel, plan).verdict() == Verdict::stable);
    for (const NamedDocument& file : paraview_files(made.tunnel, 1))
      made.files[file.name] = file.text;
    return made;
  }();
  return once;
}

}  // namespace

TEST_SUITE("io/paraview_files") {
  TEST_CASE("one file opens all others, each of which is whole") {
    const auto& files = built().files;
    REQUIRE(files.size() == 5);
    const std::string& all = files.at("tunnel.vtm");
    CHECK(xml_fault(all) == "");
    std::size_t named = 0;
    for (std::size_t at = all.find("file=\""); at != std::string::npos;
         at = all.find("file=\"", at + 1))
      ++named;
    CHECK(named == 4);
    for (const char* const name : {"blocks", "joints", "bolts", "lining"}) {
      CAPTURE(name);
      CHECK(all.find(std::string("name=\"") + name + "\" file=\"" + name + ".vtu\"") !=
            std::string::npos);
      check_whole(files.at(std::string(name) + ".vtu"));
    }
    CHECK(Grid(files.at("blocks.vtu")).arrays.at("displacement_m").components == 3);
  }

  TEST_CASE("without supports there are no files of them, and none is named") {
    const Cavern rock(voussoir_test::jointed_mass({{-3, 0, -3}, {3, 2, 3}}, 2, 1.5),
                      CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700});
    const auto files = paraview_files(rock);
    REQUIRE(files.size() == 3);
    CHECK(files.back().text.find("bolts") == std::string::npos);
    CHECK(files.back().text.find("joints.vtu") != std::string::npos);
    CHECK_THROWS_AS((void)paraview_files(built().tunnel), InvalidInput);  // how wide are strips?
  }

  TEST_CASE("bolts: every bar whole, a length for each joint with the force it has there") {
    const Grid grid(built().files.at("bolts.vtu"));
    const auto bars = bars_of(built().tunnel);
    const auto crossings = bolt_forces(built().tunnel);
    std::size_t idle = 0;
    std::vector<double> length(bars.size(), 0);
    std::vector<double> forces, expected;
    for (std::size_t k = 0; k < grid.cells; ++k) {
      const auto ends = grid.corners(k);
      REQUIRE(ends.size() == 2);
      length[static_cast<std::size_t>(grid["bolt"][k]) - 1] += (ends[1] - ends[0]).norm();
      idle += grid["joint"][k] == 0;
      if (grid["joint"][k] > 0) forces.push_back(grid["axial_force_kN"][k]);
    }
    CHECK(grid.cells == crossings.size() + idle);
    for (std::size_t k = 0; k < bars.size(); ++k)
      CHECK(length[k] == near(bars[k].length()).epsilon(1e-14));  // a sum of a few roundings
    for (const CrossingForce& c : crossings) expected.push_back(1e-3 * c.report.axial);
    CHECK(forces == expected);
    CHECK(largest(grid["largest_axial_force_kN"]) == largest(expected));
    CHECK(*std::min_element(grid["largest_axial_force_kN"].begin(),
                            grid["largest_axial_force_kN"].end()) <
          largest(expected));  // of each bar its own
    // A length contains the place where its bar crosses the joint.
    for (std::size_t k = 0, n = 0; k < grid.cells; ++k) {
      if (grid["joint"][k] == 0) continue;
      const CrossingForce& c = crossings[n++];
      const Vec3& head = bars[static_cast<std::size_t>(c.bolt)].start;
      const auto ends = grid.corners(k);
      CHECK((ends[0] - head).norm() <= c.position);
      CHECK((ends[1] - head).norm() >= c.position);
    }
  }

  TEST_CASE("bolts: what has become of them, and a bar that crosses nothing") {
    const std::vector<SpatialLine> bars{{{0, 0, 0}, {0, 0, 4}}, {{1, 0, 0}, {1, 0, 2}}};
    std::vector<CrossingForce> crossings(3, {0, 1, 2e-3, {.axial = 5e4, .shear = 2e3}});
    crossings[1].position = 2;
    crossings[1].report.is_yielding = true;
    crossings[2].position = 3;
    crossings[2].report.is_broken = true;
    const Grid grid(bolt_grid(crossings, bars).document());
    CHECK(grid["state"] == std::vector<double>{0, 1, 2, 0});
    CHECK(grid["joint"] == std::vector<double>{1, 2, 3, 0});
    CHECK(grid["bolt"] == std::vector<double>{1, 1, 1, 2});
    CHECK(grid["axial_force_kN"] == std::vector<double>{50, 50, 50, 0});
    CHECK(grid["shear_force_kN"][0] == 2);
    CHECK(grid["extension_mm"][0] == 2);
    CHECK(grid.corners(1)[0] == Vec3(0, 0, 1.5));
    CHECK(grid.corners(1)[1] == Vec3(0, 0, 2.5));
    CHECK(grid.corners(3)[1] == Vec3(1, 0, 2));
    crossings[0].bolt = 2;
    CHECK_THROWS_AS((void)bolt_grid(crossings, bars), InvalidInput);
  }

  TEST_CASE("lining: strips side by side cover the wall; forces are those of the ribs per metre") {
    const auto& [tunnel, files] = built();
    const Grid grid(files.at("lining.vtu"));
    CHECK(grid.of_points ==
          std::set<std::string>{"thrust_kN_per_m", "shear_kN_per_m", "moment_kNm_per_m"});
    CHECK(grid.cells == 4 * 24);
    CHECK(grid.points == 4 * grid.cells);
    const auto nodes = rib_forces(tunnel);
    double thrust = 0, least = 0, most = 0;
    for (const RibForce& node : nodes) {
      thrust = std::max(thrust, 1e-3 * node.thrust);
      least = std::min(least, 1e-3 * node.moment);
      most = std::max(most, 1e-3 * node.moment);
    }
    CHECK(largest(grid["thrust_kN_per_m"]) == thrust);
    CHECK(largest(grid["moment_kNm_per_m"]) == most);
    CHECK(*std::min_element(grid["moment_kNm_per_m"].begin(), grid["moment_kNm_per_m"].end()) ==
          least);
    CHECK(least < 0);
    // The whole chain of nodes at every rib times the length of the tunnel.
    double area = 0, chords = 0;
    for (std::size_t k = 0; k < grid.cells; ++k) {
      const SpatialFacet strip{grid.corners(k)};
      area += strip.measure();
    }
    const auto members = lining_members(tunnel);
    std::size_t ribs = 0;
    for (const auto& m : members)
      if (std::abs(m.to.y() - m.from.y()) < 1e-9) {
        chords += (m.to - m.from).norm();
        ++ribs;
      }
    CHECK(ribs == grid.cells);
    CHECK(ribs < members.size());                // ties are none
    CHECK(area == near(chords).epsilon(1e-13));  // strips 1 m wide; a hundred roundings
    // Ribs count on from one lining to the next, 24 members each.
    std::map<double, std::vector<double>> along;
    for (std::size_t k = 0; k < grid.cells; ++k)
      along[grid["rib"][k]].push_back(grid["along_m"][k]);
    REQUIRE(along.size() == 4);
    for (const auto& [rib, places] : along) {
      CHECK(places.size() == 24);
      for (const double s : places) CHECK(std::abs(s - (rib - 0.5)) < 1e-9);
    }
    CHECK(largest(grid["lining"]) == 2);
    // `member` is the row of the table.
    for (std::size_t k = 0; k < grid.cells; ++k) {
      const auto& m = members.at(static_cast<std::size_t>(grid["member"][k]) - 1);
      const auto corners = grid.corners(k);
      CHECK((0.5 * (corners[0] + corners[3]) - m.from).norm() < 1e-12);
      CHECK((0.5 * (corners[1] + corners[2]) - m.to).norm() < 1e-12);
    }
  }

  TEST_CASE("lining: what joins it to another has the forces of both its nodes") {
    // Two layers have a node at one place, each its own force.
    const std::vector<Vec3> axes{Vec3::UnitY(), Vec3::UnitY()};
    const std::vector<RibForce> nodes{{{0, 0, 0}, 1e3, 0, 0, 0},
                                      {{1, 0, 0}, 2e3, 0, 0, 0},
                                      {{1, 0, 0}, 3e3, 0, 0, 1},
                                      {{2, 0, 0}, 4e3, 0, 0, 1}};
    const std::vector<MemberForces<3>> members{{{0, 0, 0}, {1, 0, 0}, 0, 0, 0, 0},
                                               {{1, 0, 0}, {2, 0, 0}, 0, 0, 0, 1},
                                               {{0, 0, 0}, {0, 1, 0}, 0, 0, 0, 0},
                                               {{0, 0, 0}, {2, 0, 0}, 0, 0, 0, 1}};
    const Grid grid(lining_grid(members, nodes, axes, 2).document());
    REQUIRE(grid.cells == 3);
    CHECK(grid["thrust_kN_per_m"] ==
          std::vector<double>{0.5, 1, 1, 0.5, 1.5, 2, 2, 1.5, 0.5, 2, 2, 0.5});
    CHECK(grid["member"] == std::vector<double>{1, 2, 4});
    CHECK_THROWS_AS((void)lining_grid(members, {nodes.front()}, axes, 2), InvalidInput);
    CHECK_THROWS_AS((void)lining_grid(members, nodes, {axes.front()}, 2), InvalidInput);
    CHECK_THROWS_AS((void)lining_grid(members, nodes, axes, 0), InvalidInput);
  }

  TEST_CASE(
      "stages: the rock of each, the joints that have slipped, and one file that plays them") {
    const CoulombJoint weak({5e9, 5e8, 25 * degree});
    Cavern tunnel(voussoir_test::jointed_mass({{-6, 0, -6}, {6, 4, 7}}, 2, 1.5), weak,
                  {.density = 2700, .surcharge = 5e5});
    const SimplePolygon circle = circular_opening(4, 12);
    const auto round = [&](double from, double to) { return PrismaticOpening(circle, from, to); };
    Construction<Cavern> plan;
    plan.add_stage("first").excavate(round(-PrismaticOpening::endless, 2));
    plan.add_stage("second")
        .excavate(round(2, 3))
        .install_bolts(
            {bolt_bars({.length = 2, .angular_spacing = 45 * degree}, round(0, 2), 1, 0, 2),
             AxialBolt({.axial_stiffness = 2e8, .pretension = 1e4})});
    std::map<std::string, std::string> files;
    std::vector<TimedFile> timed;
    std::vector<double> moved;
    std::vector<std::size_t> parts, slipped;
    const auto observer = [&](const Cavern& at, const StageResult&) {
      const int stage = static_cast<int>(timed.size()) + 1;
      for (const NamedDocument& file : stage_files(at, stage)) files[file.name] = file.text;
      timed.push_back({static_cast<double>(stage), "history/" + stage_file_name(stage) + ".vtm"});
      parts.push_back(0);
      double largest = 0;
      const auto state = state_of(at);
      for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks[b].is_gone) continue;
        parts.back() += at.mass().bodies[b].parts.size();
        largest = std::max(largest, std::abs(state.blocks[b].displacement.z()));
      }
      moved.push_back(largest);
      slipped.push_back(0);
      for (const JointArea& joint : joint_areas(at))
        if (has_slipped_or_opened(at, joint)) slipped.back() += joint.polygons.size();
      CHECK(slipped_joints(at).size() <= slipped.back());  // without slivers
      CHECK(!slipped_joints(at).empty());
    };
    (void)construct(tunnel, plan, {}, observer);
    REQUIRE(timed.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string name = "stage_00" + std::to_string(k + 1);
      CAPTURE(name);
      const std::string& blocks = files.at(name + "_blocks.vtu");
      check_whole(blocks);
      const Grid grid(blocks);
      CHECK(grid.cells == parts[k]);
      double largest = 0;
      for (std::size_t n = 2; n < grid["displacement_m"].size(); n += 3)
        largest = std::max(largest, std::abs(grid["displacement_m"][n]));
      CHECK(std::abs(largest / moved[k] - 1) < 1e-6);  // seven digits
      REQUIRE(slipped[k] > 0);
      const Grid joints(files.at(name + "_joints.vtu"));
      check_whole(files.at(name + "_joints.vtu"));
      CHECK(joints.cells == slipped[k]);
      for (std::size_t n = 0; n < joints.cells; ++n)
        CHECK((joints["plastic_slip_mm"][n] > 0.01 || joints["open"][n] == 1));
      const std::string& opens = files.at(name + ".vtm");
      CHECK(xml_fault(opens) == "");
      CHECK(opens.find("name=\"blocks\" file=\"" + name + "_blocks.vtu\"") != std::string::npos);
      CHECK(opens.find("name=\"joints\" file=\"" + name + "_joints.vtu\"") != std::string::npos);
    }
    CHECK(moved[1] > moved[0]);
    CHECK(files.count("stage_001_bolts.vtu") == 0);
    check_whole(files.at("stage_002_bolts.vtu"));
    CHECK(stage_file_name(1234) == "stage_1234");
    const std::string all = pvd_document(timed);
    CHECK(xml_fault(all) == "");
    CHECK(all.find("timestep=\"1\" group=\"\" part=\"0\" file=\"history/stage_001.vtm\"") !=
          std::string::npos);
    CHECK(all.find("timestep=\"2\"") < all.find("stage_002.vtm"));
  }

  TEST_CASE("joints: one whose blocks have not moved apart has not opened, whatever its gap") {
    const Cavern& tunnel = built().tunnel;
    std::size_t slipped = 0;
    for (JointArea joint : joint_areas(tunnel)) {
      if (joint.polygons.empty()) continue;
      ContactReport& report = joint.state.report;
      report = {};
      report.plastic_slip = 2 * visible_slip;
      CHECK(has_slipped_or_opened(tunnel, joint));
      report.is_open = true;
      report.opening = 0.5;  // found across a gap: no block has moved so far
      CHECK_FALSE(has_slipped_or_opened(tunnel, joint));
      double apart = 0;
      for (const auto& polygon : joint.polygons)
        for (const Vec3& p : polygon)
          apart = std::max(apart, (tunnel.displacement_of(joint.state.b, p) -
                                   tunnel.displacement_of(joint.state.a, p))
                                      .dot(joint.state.normal));
      report.opening = apart;
      CHECK(has_slipped_or_opened(tunnel, joint) == (apart > visible_slip));
      slipped += apart > visible_slip;
    }
    CHECK(slipped > 0);
  }

  TEST_CASE("joints: a contact that was found across a gap is none, in no file") {
    // Two cubes 3 mm apart on a base that is moved by 5 mm: contacts are renewed, and the two are
    // near enough to be watched.
    const auto box = [](const Vec3& low, const Vec3& high) {
      return voussoir_test::brick(0.5 * (low + high), high - low);
    };
    Cavern blocks(
        laid_blocks<Spatial>({box({-3, -1, -1}, {3, 1, 0}), box({-1, -0.5, 0}, {0, 0.5, 1}),
                              box({0.003, -0.5, 0}, {1, 0.5, 1})}),
        CoulombJoint({1e9, 1e9, 40 * degree}), {.density = 2700, .is_laid = true});
    blocks.fix(0);
    const Acceptance renewed{.displacement_limit = 0.1, .contact_update_limit = 2e-3};
    REQUIRE(blocks.equilibrium(0, TwoLevel(), renewed).verdict == Verdict::stable);
    blocks.displace({{0, Vec3(0.005, 0, 0)}});
    REQUIRE(blocks.equilibrium(0, TwoLevel(), renewed).verdict == Verdict::stable);
    const auto states = joint_states(blocks);
    const auto across = std::find_if(states.begin(), states.end(), [](const JointState<3>& joint) {
      return std::min(joint.a, joint.b) == 1 && std::max(joint.a, joint.b) == 2;
    });
    REQUIRE(across != states.end());
    CHECK(across->report.is_open);
    CHECK(across->report.opening == near(0.003).epsilon(1e-6));
    const auto areas = joint_areas(blocks);
    CHECK(areas.size() == 2);  // on the base
    for (const JointArea& joint : areas) CHECK(std::min(joint.state.a, joint.state.b) == 0);
    CHECK(joint_grid(areas).cell_count() == 2);
  }

  TEST_CASE("joints: the polygons of a contact are its area, in its plane, between its blocks") {
    const Cavern& tunnel = built().tunnel;
    const auto areas = joint_areas(tunnel);
    REQUIRE(areas.size() == tunnel.system().joints.contacts().size());
    std::size_t cells = 0, joined = 0;
    for (const JointArea& joint : areas) {
      double area = 0;
      for (const auto& polygon : joint.polygons) {
        const SpatialFacet facet{polygon};
        area += facet.measure();
        ++cells;
        for (const Vec3& p : polygon)
          CHECK(std::abs((p - joint.state.centre).dot(joint.state.normal)) < 1e-9);
      }
      joined += joint.polygons.size() > 1;
      // Corners in radii of gyration and back again: a few roundings for each.
      if (!joint.polygons.empty()) CHECK(area == near(joint.state.measure).epsilon(1e-12));
      CHECK(joint.set >= -1);
      CHECK(joint.set < 3);
    }
    CHECK(joined > 0);  // of bodies that the tunnel has cut into parts
    const Grid grid(built().files.at("joints.vtu"));
    CHECK(grid.cells == cells);
    CHECK(cells > areas.size() / 2);
    double normal = 0;
    for (const JointArea& joint : areas)
      if (!joint.polygons.empty()) normal = std::max(normal, 1e-3 * joint.state.report.normal);
    CHECK(largest(grid["normal_force_kN"]) == normal);
    for (std::size_t k = 0; k < grid.cells; ++k)
      CHECK(grid["normal_stress_kPa"][k] * grid["area_m2"][k] ==
            near(grid["normal_force_kN"][k]).epsilon(1e-14).scale(1e-3));  // two roundings
  }

  TEST_CASE("joints: the set is that of the joint between the blocks") {
    // In rock as it was sliced, before anything was excavated, contacts are the facets of cuts.
    const Cavern rock(voussoir_test::jointed_mass({{-3, 0, -3}, {3, 2, 3}}, 2, 1.5),
                      CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700});
    const auto facets = CutContacts::find(rock.mass());
    const auto areas = joint_areas(rock);
    std::set<int> sets;
    REQUIRE(facets.size() == areas.size());
    for (const auto& facet : facets) {
      const Cut& cut = rock.mass().cuts[static_cast<std::size_t>(facet.cut)];
      const int set = rock.mass().joints[static_cast<std::size_t>(cut.source)].set;
      const Vec3 centre = facet.facet.centre();
      const auto found = std::find_if(areas.begin(), areas.end(), [&](const JointArea& joint) {
        return (joint.state.centre - centre).norm() < 1e-9;
      });
      REQUIRE(found != areas.end());
      CHECK(found->set == set);
      sets.insert(found->set);
      // Of a face that two bodies do not share, as one that meets another's wall, no set is told.
      JointState<3> alone = found->state;
      alone.b = alone.a;
      CHECK(detail::SetsBetween(rock.mass())(alone) == -1);
    }
    CHECK(sets.size() == 3);
  }

  TEST_CASE("joints: outlines are told apart whichever way their edges run") {
    const auto square = [](ContactOutline& outline, double x, bool is_turned) {
      const double corners[4][2] = {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}};
      for (int k = 0; k < 4; ++k) {
        ContactOutline::Edge edge{};
        std::copy_n(corners[k], 2, edge.from);
        std::copy_n(corners[(k + 1) % 4], 2, edge.to);
        if (is_turned) std::swap(edge.from, edge.to);
        outline.edges.push_back(edge);
      }
    };
    for (const bool is_turned : {false, true}) {
      CAPTURE(is_turned);
      ContactOutline outline;
      square(outline, 0, is_turned);
      square(outline, 1, is_turned);
      const auto loops = detail::loops_of(outline);
      REQUIRE(loops.size() == 2);
      for (const auto& loop : loops) {
        REQUIRE(loop.size() == 4);
        double doubled = 0;
        for (std::size_t k = 0; k < 4; ++k) doubled += cross(loop[k], loop[(k + 1) % 4]);
        CHECK(std::abs(doubled) == near(2).epsilon(1e-15));
      }
    }
  }
}

}  // namespace paraview_files_test
