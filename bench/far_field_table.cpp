// SPDX-License-Identifier: MIT
// What the edge of the domain does to a tunnel, by kind of boundary and by where it is, as CSV.
//   far_field_table kirsch   a hole in uniform stress, squares without slip, over Kirsch
//   far_field_table ring     a lining of 30 cm in such squares, over Einstein and Schwartz
//   far_field_table rock     the design rock of the paper, bare and supported, joints that slip
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/voussoir.hpp>

namespace {

using namespace voussoir;

constexpr double degree = std::numbers::pi / 180;

FarField<2> field_of(const std::string& boundary, const ElasticMatrix<2>& moduli, Boundary above) {
  if (boundary == "rollers") return FarField<2>().with(Side::top, Boundary::stress);
  const FarField<2> elastic = FarField<2>::elastic(moduli).with(Side::top, above);
  if (boundary == "elastic") return elastic;
  return elastic.with(Side::left, Boundary::stress)
      .with(Side::right, Boundary::stress)
      .with(Side::top, Boundary::stress);
}

/// Squares between joints of k_n = k_s: isotropic, E = k s, G = E / 2, nu = 0.
RockMass<Planar> squares(const Domain<2>& domain, double side) {
  std::vector<Joint> joints;
  for (int set = 0; set < 2; ++set) {
    const double angle = 20 * degree + set * 90 * degree;
    const Vec2 normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
    const double far = domain.diameter();
    const int count = static_cast<int>(far / side) + 1;
    for (int k = -count; k <= count; ++k) {
      const Vec2 middle = (k + 0.5) * side * normal;
      joints.push_back({Segment{middle - far * along, middle + far * along}, set});
    }
  }
  return slice(domain, joints, {.min_inscribed_radius = 1e-3});
}

void hole_in_squares() {
  const double young = 1e10, pressure = 1e6;
  std::puts(
      "boundary,k0,box_half_width_over_radius,blocks_per_radius,blocks,mean_over_kirsch,"
      "cos2_over_kirsch");
  for (const double box : {3.0, 4.0, 6.0, 9.0})
    for (const int blocks_per_radius : {5, 10, 20}) {
      const Domain<2> domain{{-box, -box}, {box, box}};
      const double side = 1.0 / blocks_per_radius, stiffness = young / side;
      const auto rock = squares(domain, side);
      const MohrCoulombJoint law({.joint_normal_stiffness = stiffness,
                                  .joint_shear_stiffness = stiffness,
                                  .friction_angle = 1,
                                  .cohesion = 2e9,
                                  .tensile_strength = 1e9},
                                 any_units);
      for (const char* boundary : {"rollers", "stress", "elastic"})
        for (const double k0 : {0.5, 1.0, 2.0}) {
          const auto field =
              field_of(boundary, elastic_matrix<2>({0.5 * young, 0}), Boundary::elastic);
          Solver<Planar, MohrCoulombJoint> tunnel(
              rock, law, {.density = 0.01, .k0 = k0, .surcharge = pressure}, {}, field);
          tunnel.excavate(circular_opening(2, 360), 1e-9);
          const SectionClosure closure = section_closure(elastic_wall_motion(tunnel));
          const FarStress far{pressure, k0};
          const double mean = far.mean() / young, cos2 = 3 * far.deviator() / young;
          std::printf("%s,%g,%g,%d,%zu,%.5f,%.5f\n", boundary, k0, box, blocks_per_radius,
                      rock.bodies.size(), 0.25 * (closure.across + closure.upright) / mean,
                      k0 == 1 ? 1.0 : 0.25 * (closure.across - closure.upright) / cos2);
          std::fflush(stdout);
        }
    }
}

/// Nodes of the lining are a third of a block apart. Blocks are rigid: glued stiffly to one, the
/// lining has no strain along it, and all of it between blocks. So shear is handed over along two
/// blocks, k_s = E A / (2 s)^2, which is glued the firmer the smaller they are; full slip has a
/// hundred thousandth of k_n. Moments are those of straight bars; a curved one has I / A N / R more
/// of the sign of a tension outside.
void ring_in_squares() {
  const double young = 2e9, radius = 5, box = 6 * radius, pressure = 1e6, k0 = 0.5, normal = 1e11;
  const LiningSection section = LiningSection::rectangular(0.3, 25e9);
  std::puts(
      "interface,blocks_per_radius,nodes,blocks,mean_thrust_over_exact,cos2_thrust_error_over_mean,"
      "cos2_moment_over_exact");
  for (const bool slips : {false, true})
    for (const int blocks_per_radius : {5, 10, 20}) {
      const double side = radius / blocks_per_radius, stiffness = young / side;
      const auto glued = [&](double k_n, double k_s) {
        return MohrCoulombJoint({.joint_normal_stiffness = k_n,
                                 .joint_shear_stiffness = k_s,
                                 .friction_angle = 1,
                                 .cohesion = 2e9,
                                 .tensile_strength = 1e9},
                                any_units);
      };
      const Domain<2> domain{{-box, -box}, {box, box}};
      Solver<Planar, MohrCoulombJoint, RockOnLining<MohrCoulombJoint>> tunnel(
          squares(domain, side), glued(stiffness, stiffness),
          {.density = 1, .k0 = k0, .surcharge = pressure}, {},
          field_of("elastic", elastic_matrix<2>({0.5 * young, 0}), Boundary::elastic));
      tunnel.excavate(circular_opening(2 * radius, 360), 1e-9);
      // Glued: no farther apart than a bond needs, which 20 a block of a fifth would be.
      const int nodes = std::max(20 * blocks_per_radius, 130);
      tunnel.install_lining(
          lining_frame(tunnel.mass(), {.nodes = nodes}), section,
          glued(normal, slips ? 1e-5 * normal : section.axial_stiffness / (4 * side * side)));
      // Weights are next to nothing: the error estimate decides.
      (void)tunnel.equilibrium(0, {}, {.error_estimate = 1e-6, .unbalance_over_weight = 1e9});
      const LiningResponse exact = einstein_schwartz(
          RingLining::rectangular(radius, 0.3, 25e9), {pressure, k0}, {0.5 * young, 0},
          slips ? LiningInterface::full_slip : LiningInterface::no_slip);
      double thrust = 0, thrust2 = 0, moment2 = 0;
      for (const LiningForce& at : lining_forces(tunnel)) {
        const double theta = std::atan2(at.position.y(), at.position.x());
        thrust += at.thrust / nodes;
        thrust2 += 2 * at.thrust * std::cos(2 * theta) / nodes;
        moment2 += 2 * at.moment * std::cos(2 * theta) / nodes;
      }
      moment2 += section.bending_stiffness / section.axial_stiffness * thrust2 / radius;
      std::printf("%s,%d,%d,%zu,%.4f,%.4f,%.4f\n", slips ? "full slip" : "no slip",
                  blocks_per_radius, nodes, tunnel.mass().bodies.size(), thrust / exact.thrust,
                  (thrust2 - exact.thrust_amplitude) / exact.thrust,
                  moment2 / exact.moment_amplitude);
      std::fflush(stdout);
    }
}

/// Where the blocks within two spans of the tunnel are: equal in two domains if these cut the same
/// rock.
std::vector<Vec2> near_blocks(const RockMass<Planar>& rock) {
  std::vector<Vec2> centres;
  for (const auto& body : rock.bodies)
    if (body.properties.centroid.norm() < 20) centres.push_back(body.properties.centroid);
  std::sort(centres.begin(), centres.end(), [](const Vec2& a, const Vec2& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  return centres;
}
bool are_alike(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](const Vec2& p, const Vec2& q) { return (p - q).norm() < 1e-6; });
}

void design_rock() {
  const SimplePolygon opening = circular_opening(10, 72);
  const CoulombJoint law({5e9, 5e8, 35 * degree});
  std::vector<JointSet> sets;
  for (const auto& [dip, direction] : {std::pair{75.0, DipDirection::east},
                                       {25.0, DipDirection::east},
                                       {25.0, DipDirection::west}}) {
    JointSet set;
    set.dip = dip * degree;
    set.dip_direction = direction;
    set.dip_deviation = 1 * degree;
    set.intensity = set.extent = 1;
    sets.push_back(set);
  }
  std::puts(
      "seed,k0,support,boundary,width_m,below_invert_m,verdict,height_mm,width_mm,"
      "crown_against_opening_mm,rise_mm,crown_mm,same_rock_within_20_m");
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const double k0 : {1.0, 0.5}) {
      // The same joints in every domain: those of the largest.
      const auto joints = joint_network(sets, domain_around(opening, 70, 20, 70), seed);
      const auto usual = near_blocks(slice(domain_around(opening, 70, 20, 30), joints, {0.25, 5}));
      for (const char* boundary : {"rollers", "elastic"})
        for (const auto& [width, below] : {std::pair{70.0, 30.0}, {70.0, 70.0}, {40.0, 20.0}})
          for (const bool is_supported : {false, true}) {
            const auto rock = slice(domain_around(opening, width, 20, below), joints, {0.25, 5});
            const bool is_same = are_alike(near_blocks(rock), usual);
            const auto field = field_of(boundary, elastic_moduli(rock, law), Boundary::stress);
            Solver<> tunnel(rock, law, {.density = 2700, .k0 = k0}, {}, field);
            tunnel.excavate(opening, 0.074);
            Verdict verdict = Verdict::stable;
            std::vector<WallMotion> wall;
            if (is_supported) {
              for (const Segment& bar :
                   bolt_bars({.length = 4, .angular_spacing = 15 * degree}, opening))
                tunnel.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8}));
              tunnel.install_lining(lining_frame(tunnel.mass(), {.nodes = 72}),
                                    LiningSection::rectangular(0.1, 25e9),
                                    CoulombJoint({1e9, 1e9, 30 * degree}));
              verdict = tunnel.equilibrium(0).verdict;
              wall = wall_motion(tunnel);
            } else {
              wall = elastic_wall_motion(tunnel);
            }
            const SectionClosure closure = section_closure(wall);
            const Convergence absolute = convergence_of(wall),
                              relative = convergence_of(wall, mean_displacement(wall));
            std::printf("%d,%g,%s,%s,%g,%g,%s,%.4f,%.4f,%.4f,%.4f,%.4f,%s\n",
                        static_cast<int>(seed), k0,
                        is_supported ? "bolts and lining" : "none; no slip", boundary, width, below,
                        to_string(verdict), 1e3 * closure.upright, 1e3 * closure.across,
                        1e3 * relative.crown, 1e3 * absolute.rise, 1e3 * absolute.crown,
                        is_same ? "yes" : "no");
            std::fflush(stdout);
          }
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "kirsch") == 0)
    hole_in_squares();
  else if (argc == 2 && std::strcmp(argv[1], "ring") == 0)
    ring_in_squares();
  else if (argc == 2 && std::strcmp(argv[1], "rock") == 0)
    design_rock();
  else
    return std::fputs("far_field_table kirsch | ring | rock\n", stderr), 2;
}
