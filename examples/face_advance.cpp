// SPDX-License-Identifier: MIT
// A tunnel is driven in 12 rounds through jointed rock that is elastic and alike in all directions,
// under hydrostatic stress. What is known beforehand: 12 rounds end as one, to the tolerance of the
// searches; and the convergence along the tunnel follows the profile that Unlu & Gercek (2003)
// found for a continuum with the same Poisson ratio. What it is for: ribs installed round by round
// behind the face meet rock that has moved already, and carry about half of what an analysis says
// in which they are wished in place. With an argument, the profile is drawn in that file (.svg).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

// Joints that neither slip nor open, for the strength given to them below.
using Tunnel = Solver<Spatial, MohrCoulombJoint, TimoshenkoBeam>;

namespace {

constexpr int round_count = 12;
constexpr double in_situ_stress = 2e7;  // [Pa]
constexpr JointStiffness stiffness{5e10, 5e10 / 3};
const MohrCoulombJoint joint({.joint_normal_stiffness = stiffness.normal,
                              .joint_shear_stiffness = stiffness.shear,
                              .friction_angle = 1,
                              .cohesion = 2e9,
                              .tensile_strength = 1e9});
/// So close that 13 searches agree within 1e-6.
constexpr Acceptance tight{.error_estimate = 1e-8};

/// A tunnel that begins at the edge of the rock, where the mirror image of it ends: smooth and
/// fixed, the edge is a plane of symmetry.
struct Drive {
  double radius, round_length;  // [m]
  double joint_spacing;         // of each of the six sets [m]
  double beside, ahead;         // rock from the axis to its edge, and ahead of the last face [m]

  [[nodiscard]] double length() const { return round_count * round_length; }
  [[nodiscard]] RockMass<Spatial> rock() const {
    const Domain<3> ground{{-beside, 0, -beside}, {beside, length() + ahead, beside}};
    return slice<Spatial>(ground, joint_network(isotropic_sets(joint_spacing), ground, 1),
                          {.min_inscribed_radius = 0.05 * joint_spacing});
  }
  [[nodiscard]] PrismaticOpening round(int k) const {
    return PrismaticOpening(circular_opening(2 * radius, 36), k == 0 ? -1 : k * round_length,
                            (k + 1) * round_length);
  }
  [[nodiscard]] PrismaticOpening whole(double to) const {
    return PrismaticOpening(circular_opening(2 * radius, 36), -1, to);
  }
};

bool settles(Tunnel& tunnel) {
  const EquilibriumReport report = tunnel.equilibrium(0, {}, tight);
  if (report.verdict != Verdict::stable) std::printf("%s\n", report.reason.c_str());
  return report.verdict == Verdict::stable;
}

/// Largest difference of displacements, over the largest displacement. Both have the same blocks,
/// those at the faces of rounds in another order.
double difference(const Tunnel& x, const Tunnel& y) {
  const auto in_order = [](const Tunnel& tunnel) {
    std::vector<std::pair<Vec3, Vec3>> moved;
    for (std::size_t b = 0; b < tunnel.mass().bodies.size(); ++b) {
      const Vec3 centre = tunnel.mass().bodies[b].properties.centroid;
      moved.emplace_back(centre, tunnel.displacement_of(static_cast<int>(b), centre));
    }
    std::sort(moved.begin(), moved.end(),
              [](const auto& a, const auto& b) { return a.first.x() < b.first.x(); });
    return moved;
  };
  const auto a = in_order(x), b = in_order(y);
  double apart = a.size() == b.size() ? 0 : 1, largest = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    apart = std::max(apart, (a[k].second - b[k].second).norm());
    largest = std::max(largest, b[k].second.norm());
  }
  return apart / largest;
}

/// What the press says of a rock, in three directions.
struct Moduli {
  double poisson_ratio = 0, shear_modulus = 0;
  double spread = 0;  // (most - least) / mean of the three constrained moduli

  explicit Moduli(const RockMass<Spatial>& rock) {
    double least = 1e300, most = 0, sum = 0;
    for (const SpatialSide side : {SpatialSide::top, SpatialSide::east, SpatialSide::north}) {
      const OedometerResult pressed = oedometer(rock, joint, {.loaded = side});
      poisson_ratio += pressed.poisson_ratio / 3;
      shear_modulus += pressed.shear_modulus / 3;
      least = std::min(least, pressed.constrained_modulus);
      most = std::max(most, pressed.constrained_modulus);
      sum += pressed.constrained_modulus;
    }
    spread = (most - least) / (sum / 3);
    const auto free = isotropic_joint_oedometer(stiffness, joint_intensity(rock));
    std::printf(
        "press: nu %.3f, G %.2f GPa, moduli along x, y, z within %.1f %%; blocks that do not "
        "hinder each other: nu %.3f, G %.2f GPa\n",
        poisson_ratio, 1e-9 * shear_modulus, 100 * spread, free.poisson_ratio,
        1e-9 * free.shear_modulus);
  }
};

struct ProfilePoint {
  double x;     // from the face, positive behind it [radii]
  double part;  // u / u_max
};
struct Profile {
  std::vector<ProfilePoint> points;
  double elastic = 0, plastic = 0;  // root mean square of the differences to the two curves
};

/// @param moved, longest  convergence of the drive, and of the tunnel that goes through
Profile profile_of(const Drive& drive, const OutlineSampling& sampling,
                   const std::vector<double>& moved, double longest, double nu) {
  Profile profile;
  std::printf("\n   x/a    u/u_max   Unlu & Gercek   Vlachopoulos & Diederichs\n");
  for (int k = sampling.stretches - 1; k >= 0; --k) {
    const double x = (drive.length() - sampling.middle(k)) / drive.radius;
    const double part = moved[static_cast<std::size_t>(k)] / longest;
    const double u = elastic_longitudinal_profile(x, nu), v = longitudinal_profile(x, 1);
    profile.points.push_back({x, part});
    profile.elastic += (part - u) * (part - u) / sampling.stretches;
    profile.plastic += (part - v) * (part - v) / sampling.stretches;
    std::printf("%7.3f   %.4f    %.4f          %.4f\n", x, part, u, v);
  }
  profile.elastic = std::sqrt(profile.elastic);
  profile.plastic = std::sqrt(profile.plastic);
  return profile;
}

/// The points on the two curves.
std::string draw(const Profile& profile, double nu, double radius) {
  const std::string words = "blocks of 1 m, tunnel of " + trimmed_text(2 * radius, 1) + " m";
  PictureHeader header{"Convergence along a tunnel",
                       {"Elastic jointed rock, hydrostatic stress, driven in 12 rounds: " + words},
                       {}};
  const PageMap map({{-3, 0}, {6, 1.05}},
                    {{90, header.height() + 20}, {picture_width - 30, header.height() + 480}});
  SvgCanvas canvas(picture_width, map.page().high.y() + 110, picture_printed_width, header.title);
  header.draw(canvas);
  const ViewRect& frame = map.page();
  for (double x = -3; x <= 6; ++x) {
    canvas.line(map({x, 0}), map({x, 1.05}), {.stroke = x == 0 ? "#666" : "#e2e2e2"});
    canvas.text(map({x, 0}) + Vec2(0, 20), trimmed_text(x, 0), {.anchor = TextAnchor::middle});
  }
  for (int k = 0; k <= 5; ++k) {
    canvas.line(map({-3, 0.2 * k}), map({6, 0.2 * k}), {.stroke = "#e2e2e2"});
    canvas.text(map({-3, 0.2 * k}) + Vec2(-8, 5), trimmed_text(0.2 * k, 1),
                {.anchor = TextAnchor::end});
  }
  canvas.rectangle(frame, {.stroke = "#111"});
  canvas.text(map({0, 0.93}) + Vec2(-6, 0), "face", {.anchor = TextAnchor::end, .fill = "#666"});
  canvas.text({frame.centre().x(), frame.high.y() + 44}, "distance behind the face / radius",
              {.anchor = TextAnchor::middle});
  canvas.text({36, frame.centre().y()}, "u / u_max",
              {.anchor = TextAnchor::middle, .rotation = -90});
  const SvgStyle of_elastic{.stroke = "#2c5f8a", .stroke_width = 2.5},
      of_plastic{.stroke = "#c8102e", .stroke_width = 2, .dash = "8 5"};
  std::vector<Vec2> elastic, plastic;
  for (int k = -300; k <= 600; ++k) {
    elastic.push_back(map({0.01 * k, elastic_longitudinal_profile(0.01 * k, nu)}));
    plastic.push_back(map({0.01 * k, longitudinal_profile(0.01 * k, 1)}));
  }
  canvas.polyline(plastic, of_plastic);
  canvas.polyline(elastic, of_elastic);
  const SvgStyle of_point{.fill = "white", .stroke = "#111", .stroke_width = 1.6};
  for (const ProfilePoint& p : profile.points) canvas.circle(map({p.x, p.part}), 4.5, of_point);
  const auto stroke = [](const SvgStyle& style) {
    return [style](SvgCanvas& page, const Vec2& at) {
      page.line(at - Vec2(13, 0), at + Vec2(13, 0), style);
    };
  };
  const auto rms = [](double value) { return " (RMS " + fixed_text(value, 3) + ")"; };
  Legend({{"blocks", [&](SvgCanvas& page, const Vec2& at) { page.circle(at, 4.5, of_point); }},
          {"Unlu & Gercek 2003, \u03bd = " + fixed_text(nu, 2) + rms(profile.elastic),
           stroke(of_elastic)},
          {"Vlachopoulos & Diederichs 2009, r_p = a" + rms(profile.plastic), stroke(of_plastic)}},
         frame.width())
      .draw(canvas, {frame.low.x(), frame.high.y() + 58});
  return canvas.document();
}

/// Drives the tunnel, and compares. @return  whether all is as it is known to be
bool follows_the_profile(const std::string& picture) {
  const Drive drive{
      .radius = 3, .round_length = 2, .joint_spacing = 2.16, .beside = 12, .ahead = 12};
  const RockMass<Spatial> rock = drive.rock();
  const Moduli moduli(rock);
  Tunnel in_rounds(rock, joint, {.density = 2700, .surcharge = in_situ_stress});
  Tunnel at_once = in_rounds, through = in_rounds;
  bool good = true;
  for (int k = 0; k < round_count; ++k) {
    in_rounds.excavate(drive.round(k), 0);
    good = settles(in_rounds) && good;
  }
  at_once.excavate(drive.whole(drive.length()), 0);
  through.excavate(drive.whole(PrismaticOpening::endless), 0);
  good = settles(at_once) && settles(through) && good;
  const double apart = difference(in_rounds, at_once);

  // Half a radius is left out at either end.
  const double a = drive.radius, from = drive.length() - 6 * a, to = drive.length() + 3 * a;
  const OutlineSampling sampling{.from = from, .to = to, .stretches = 36};
  double longest = 0;  // of the section in plane strain
  for (const double u : outline_convergence(through, drive.whole(to), sampling))
    longest += u / sampling.stretches;
  const auto moved = outline_convergence(in_rounds, drive.whole(to), sampling);
  const Profile profile = profile_of(drive, sampling, moved, longest, moduli.poisson_ratio);
  std::printf(
      "\n%zu blocks, %.2f m: u_max %.2f mm (p0 a / 2G: %.2f), 12 rounds and one differ by %.1e; "
      "RMS %.4f to Unlu & Gercek, %.4f to Vlachopoulos & Diederichs\n\n",
      rock.bodies.size(),
      std::cbrt(rock.domain.measure() / static_cast<double>(rock.bodies.size())), 1e3 * longest,
      1e3 * in_situ_stress * a / (2 * moduli.shear_modulus), apart, profile.elastic,
      profile.plastic);
  if (!picture.empty()) write_atomically(picture, draw(profile, moduli.poisson_ratio, a));
  return good && apart < 1e-6 && profile.elastic < 0.025;
}

/// Two ribs on the wall of the last round.
void install_ribs(Tunnel& tunnel, double spacing) {
  const LiningRibs ribs{.ring = {.nodes = 36}, .spacing = spacing, .tied = false};
  tunnel.install_lining(lining_frame(tunnel.mass(), ribs, tunnel.fallen()),
                        {LiningSection::strip(0.25, spacing, 25e9)},
                        CoulombJoint({1e10, 1e10, 0.6}));
}

/// Least and largest mean thrust of the ribs between two places [N].
std::pair<double, double> thrusts(const Tunnel& tunnel, double spacing, double from, double to) {
  const auto count = static_cast<std::size_t>((to - from) / spacing + 0.5);
  std::vector<double> sum(count, 0.0), members(count, 0.0);
  for (const auto& member : lining_members(tunnel)) {
    const double y = member.from.y();
    if (y < from || y > to) continue;
    const auto rib = static_cast<std::size_t>((y - from) / spacing);
    sum[rib] += member.thrust;
    members[rib] += 1;
  }
  for (std::size_t k = 0; k < count; ++k) sum[k] /= members[k];
  const auto [least, most] = std::minmax_element(sum.begin(), sum.end());
  return {*least, *most};
}

/// Ribs behind the face and ribs wished in place. @return  whether the former carry less
bool ribs_carry_less() {
  const Drive drive{
      .radius = 5, .round_length = 2.5, .joint_spacing = 5.4, .beside = 20, .ahead = 15};
  const double spacing = 0.5 * drive.round_length;
  Tunnel driven(drive.rock(), joint, {.density = 2700, .surcharge = 0.1 * in_situ_stress});
  Tunnel wished = driven;
  bool good = true;
  for (int k = 0; k < round_count; ++k) {
    driven.excavate(drive.round(k), 0);
    good = settles(driven) && good;  // bare: the ribs of this round come when it has been mucked
    install_ribs(driven, spacing);
  }
  wished.excavate(drive.whole(drive.length()), 0);
  install_ribs(wished, spacing);
  good = settles(wished) && good;
  // Not those near the beginning, and not those that the next rounds have yet to load.
  const double from = 2 * drive.round_length, to = drive.length() - 4 * drive.round_length;
  const auto behind = thrusts(driven, spacing, from, to),
             in_place = thrusts(wished, spacing, from, to);
  std::printf(
      "ribs of 25 cm, %.2f m apart, thrust: installed one round behind the face %.0f to %.0f kN, "
      "wished in place %.0f to %.0f kN.\nBehind the face the rock has moved before a rib stands: "
      "it carries %.0f %% of what an analysis says that wishes it in place.\n",
      spacing, 1e-3 * behind.first, 1e-3 * behind.second, 1e-3 * in_place.first,
      1e-3 * in_place.second,
      100 * (behind.first + behind.second) / (in_place.first + in_place.second));
  return good && behind.second < 0.75 * in_place.first;
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%s\n", Tunnel::composition().c_str());
  const bool follows = follows_the_profile(argc > 1 ? argv[1] : "");
  const bool less = ribs_carry_less();
  return follows && less ? 0 : 1;
}
