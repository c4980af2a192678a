// SPDX-License-Identifier: MIT
// A tunnel that is let go twice, every block moving: bare, and with a ring of shotcrete that is
// sprayed while a residual wall traction still acts. How much rock comes down, and what does the
// ring carry?
//
//   rockfall [NAME]     writes NAME.svg, the end of both runs
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

namespace {

constexpr double deg = std::numbers::pi / 180;
using Run = Dynamics<2, CoulombJoint>;

/// Takes the load that the excavation left off the wall in 0.1 s and follows the rock.
void let_go(Run& run, double time) {
  const double held = run.held(), start = run.time();
  while (run.time() < start + time - 1e-9) {
    run.set_held(std::max(0.0, held - (run.time() + 0.01 - start) / 0.1));
    run.advance(0.01);
  }
}

/// Rock that has moved by more than 0.1 m [m^2].
double fallen(const Run& run, const RockMass<Planar>& rock) {
  double area = 0;
  for (std::size_t b = 0; b < rock.bodies.size(); ++b) {
    const auto& body = rock.bodies[b].properties;
    if ((run.position(static_cast<int>(b)) - body.centroid).norm() > 0.1) area += body.measure;
  }
  return area;
}

/// The middle of the run as it is now: rock grey, detached rock red, lining blue.
void draw(SvgCanvas& canvas, const Run& run, const ViewRect& frame, const std::string& id,
          const std::string& caption) {
  const ViewRect world{{-5, -3.5}, {5, 6.5}};
  const PageMap map = PageMap::equal_scales(world, frame);
  canvas.clip_rectangle(id, frame);
  canvas.begin_layer("layer-" + id, id);
  for (const auto& [shape, b] : run.shapes()) {
    if (run.role(b) == BodyRole::wall) continue;
    const Pose<2> motion = run.motion(b);
    std::vector<Vec2> corners;
    for (const Vec2& v : shape.vertices()) corners.push_back(motion(v));
    const char* const fill = run.role(b) == BodyRole::lining                         ? "#31688e"
                             : (run.position(b) - run.home(b).position).norm() > 0.1 ? "#d9805f"
                                                                                     : "#e3e0d8";
    canvas.polygon(on_page(corners, map), {.fill = fill, .stroke = "#555", .stroke_width = 0.4});
  }
  canvas.end_layer();
  canvas.rectangle(frame, {.stroke = "#333", .stroke_width = 0.8});
  canvas.text(Vec2(frame.low.x(), frame.high.y() + 18), caption);
}

}  // namespace

int main(int argc, char** argv) {
  const auto opening = circular_opening(5, 36);
  const auto ground = domain_around(opening, 20, 9, 6);
  const std::vector sets = {JointSet{"J1", 75 * deg, DipDirection::east, 1 * deg, 1, 0, 1},
                            JointSet{"J2", 25 * deg, DipDirection::east, 1 * deg, 1, 0, 1},
                            JointSet{"J3", 55 * deg, DipDirection::west, 1 * deg, 1, 0, 1}};
  const auto rock = carve(slice(ground, joint_network(sets, ground, 3), {0.25, 5}), opening, 0.074);
  const CoulombJoint joint({5e9, 5e8, 30 * deg});
  const InSitu in_situ{.density = 2700, .surcharge = 4e5};
  const DynamicsSettings settings{.local_damping = 0.3, .viscous_damping = 0.1};

  Run bare = moving_rock(rock, joint, in_situ, settings);
  let_go(bare, 1.2);

  Run lined = moving_rock(rock, joint, in_situ, settings);
  lined.set_held(0.5);
  lined.advance(0.05);
  LiningSection shotcrete = LiningSection::rectangular(0.1, 15e9);
  shotcrete.mass = 2400 * 0.1;
  const auto ring = add_lining<EulerBernoulliBeam>(lined, lining_frame(rock, {.nodes = 36}),
                                                   {shotcrete}, joint, 0.1);
  let_go(lined, 0.3);
  double thrust = 0, moment = 0;
  for (const LiningForce& at : lining_forces(lined, *ring)) {
    thrust = std::max(thrust, at.thrust);
    moment = std::max(moment, std::abs(at.moment));
  }

  const double lost = fallen(bare, rock), kept = fallen(lined, rock);
  const double imbalance = std::max(std::abs(bare.energy().relative_imbalance()),
                                    std::abs(lined.energy().relative_imbalance()));
  std::printf(
      "%zu blocks. Bare: %.1f m2 of rock have come down after %.1f s. Lined: %.2f m2, thrust up to "
      "%.0f kN/m, moment up to %.1f kN m/m\nenergy that is not accounted for: %.2g of what was at "
      "stake\n",
      rock.bodies.size(), lost, bare.time(), kept, 1e-3 * thrust, 1e-3 * moment, imbalance);
  if (argc > 1) {
    PictureHeader header;
    header.title = "A tunnel of 5 m let go, with every block moving";
    const double top = header.height(), side = 0.5 * (picture_width - 3 * picture_margin);
    SvgCanvas canvas(picture_width, top + side + 36, picture_printed_width, header.title);
    header.draw(canvas);
    const auto frame = [&](double k) {
      const Vec2 low(picture_margin + k * (side + picture_margin), top);
      return ViewRect{low, low + Vec2::Constant(side)};
    };
    draw(canvas, bare, frame(0), "bare",
         "bare, after " + fixed_text(bare.time(), 1) + " s: " + fixed_text(lost, 1) +
             " m\u00b2 have come down");
    draw(canvas, lined, frame(1), "lined",
         "with 10 cm of shotcrete: thrust up to " + fixed_text(1e-3 * thrust, 0) + " kN/m");
    write_atomically(std::string(argv[1]) + ".svg", canvas.document());
  }
  // What a ring in soft ground would carry, p0 R, is more than rock that holds itself hands over.
  const double p0 = in_situ.surcharge + in_situ.density * in_situ.gravity * 9;
  return lost > 5 && kept < 0.1 && thrust < p0 * 2.5 && imbalance < 0.01 ? 0 : 1;
}
