// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/io/joint_vtu.hpp>
#include <voussoir/io/support_vtu.hpp>
#include <voussoir/io/tunnel_picture.hpp>
#include <voussoir/io/tunnel_tables.hpp>
#include <voussoir/io/view_from.hpp>
#include <voussoir/io/vtu.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/opening_centre.hpp>
#include <voussoir/tunnel/rib_forces.hpp>
#include <voussoir/tunnel/support_demand.hpp>

namespace voussoir {

// A constructed tunnel as a finished picture, in 2-D and 3-D: title, verdict in words, key numbers,
// banner where something must not be overlooked, rock, supports.
//
//   const auto built = construct(tunnel, plan);
//   write_atomically("tunnel.svg", draw_tunnel(tunnel, built, {.title = "Design case"}));

/// What a picture cannot know from the tunnel.
struct TunnelPictureText {
  std::string title = "Tunnel in jointed rock";
  double lining_thickness = 0;            ///< [m]; 0: that of each section. Without meaning in 3-D
  std::vector<std::string> remarks = {};  ///< below the verdict, a line each
  std::array<std::string, 3> axes = detail::compass;  ///< in 3-D: what they are called
  /// Convergence of the crown [m] and what it is of, in place of that of the last stage, which in
  /// 3-D is of the whole length.
  std::optional<double> crown = {};
  std::string crown_name = "crown convergence";
  double strip_width = 0;  ///< in 3-D: of the lining, that forces are per metre of [m]; 0: of a rib
  ViewFrom from = ViewFrom::axis;         ///< in 3-D
  bool shows_whole_model = true;          ///< in 2-D, small, beside the rock around the opening
  std::vector<PlacedLoad<2>> loads = {};  ///< in 2-D: that have come on
  /// In tension, of every bolt [N]; infinite: it has none. Empty: nothing is said of it.
  std::vector<double> bolt_strengths = {};
  /// In 2-D: what every node of the linings has of its strength [-]; not a number: not checked.
  std::vector<double> node_utilisations = {};
};

/// The verdict in a sentence, with the error and the out-of-balance force that it rests on, or the
/// reason why it is another.
/// @param fallen  over all stages [m^2], [m^3]
/// @param unit    of it: "m²"
/// @param lost_lining  a lining came off, in any stage
[[nodiscard]] VOUSSOIR_INLINE std::string verdict_sentence(const EquilibriumReport& last,
                                                           double fallen, const std::string& unit,
                                                           bool lost_lining = false);

/// What must not be overlooked in a picture; none: the tunnel stands, all of it.
[[nodiscard]] VOUSSOIR_INLINE std::optional<PictureBanner> banner_of(Verdict verdict, double fallen,
                                                                     const std::string& unit,
                                                                     bool lost_lining = false);

/// "3.29" for 3.29e-3 m; "-" where there is no wall, or none any more.
[[nodiscard]] inline std::string millimetres_text(double metres) {
  return std::isfinite(metres) ? fixed_text(1e3 * metres, 2) : "-";
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string verdict_sentence(const EquilibriumReport& last, double fallen,
                                             const std::string& unit, bool lost_lining) {
  const bool stands = last.verdict == Verdict::stable;
  std::string sentence = std::string("Verdict: ") + to_string(last.verdict, fallen, lost_lining);
  if (stands && fallen > 0)
    sentence +=
        (lost_lining ? ", after rockfall of " : " of ") + fixed_text(fallen, 2) + " " + unit;
  if (!stands) return sentence + ": " + last.reason + ".";
  sentence += std::isfinite(last.error_estimate)
                  ? ". Estimated error of the displacements " +
                        significant_text(100 * last.error_estimate, 2) + " %"
                  : ". Error of the displacements not estimated by this method";
  return sentence + "; the worst block is out of balance by " +
         significant_text(100 * last.unbalance_over_weight, 2) + " % of its weight.";
}

VOUSSOIR_INLINE std::optional<PictureBanner> banner_of(Verdict verdict, double fallen,
                                                       const std::string& unit, bool lost_lining) {
  if (verdict == Verdict::stable && !(fallen > 0) && !lost_lining) return std::nullopt;
  std::string word = to_string(verdict, fallen, lost_lining);
  for (char& c : word)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  const std::string rock = fixed_text(fallen, 2) + " " + unit + " of rock detached";
  if (verdict == Verdict::stable && lost_lining)
    return PictureBanner{word, "the lining came off the wall; " + rock, "#b45309"};
  if (verdict == Verdict::stable)
    return PictureBanner{word, rock + " before the rest came to rest", "#b45309"};
  if (verdict == Verdict::collapse) return PictureBanner{word, rock + ": no equilibrium"};
  return PictureBanner{word, "no equilibrium was found: what is drawn here is no result"};
}

#endif

namespace detail {

/// Crown, blocks and what the supports carry.
/// @param text  see there what they are of
template <class Solver>
[[nodiscard]] std::vector<KeyNumber> key_numbers_of(
    const Solver& solver, const ConstructionResult<typename Solver::Geometry>& result,
    const TunnelPictureText& text) {
  const double strip_width = text.strip_width;
  SupportDemand demand = support_demand(solver);
  const std::string per_metre = Solver::dim == 2 || strip_width > 0 ? "/m" : "";
  if (strip_width > 0)
    for (double* const force : {&demand.largest_thrust, &demand.largest_moment})
      *force /= strip_width;
  std::vector<KeyNumber> numbers{
      {text.crown_name,
       millimetres_text(text.crown.value_or(result.stages.back().convergence.crown)) + " mm"},
      {"blocks", std::to_string(solver.mass().bodies.size())}};
  if (solver.bolt_count() > 0)
    numbers.push_back(
        {"largest bolt force", fixed_text(1e-3 * demand.largest_bolt_force, 0) + " kN"});
  if (has_standing_lining(solver)) {
    numbers.push_back(
        {"largest thrust", fixed_text(1e-3 * demand.largest_thrust, 0) + " kN" + per_metre});
    numbers.push_back(
        {"largest moment", fixed_text(1e-3 * demand.largest_moment, 1) + " kN m" + per_metre});
  }
  return numbers;
}

/// What a part of the picture says of its strength.
[[nodiscard]] inline std::string words_of_strength(double utilisation) {
  if (std::isnan(utilisation)) return "";
  if (std::isinf(utilisation)) return "\nbeyond its strength";
  std::string words(1, '\n');
  return words.append(readable_text(100 * utilisation, 2)).append(" % of its strength");
}
/// @param force      [N]
/// @param strengths  see `TunnelPictureText`
[[nodiscard]] inline std::string words_of_strength(double force, std::size_t bolt,
                                                   const std::vector<double>& strengths) {
  if (bolt >= strengths.size() || !std::isfinite(strengths[bolt])) return "";
  return words_of_strength(force / strengths[bolt]);
}

/// In-situ stress at the middle of the opening times half its width, see `BlocksPicture`.
template <class Solver>
[[nodiscard]] double reference_thrust_of(const Solver& solver, const ViewRect& opening) {
  const double depth = solver.mass().domain.surface() - opening.centre().y();
  return solver.in_situ().vertical(depth) * 0.5 * opening.width();
}

/// Directions and diagrams of a picture become those of one opening; what is around others stays in
/// the picture.
inline void look_at(BlocksPicture& picture, const SimplePolygon& opening) {
  const ViewRect rect = *bounding_rect(opening.vertices());
  const ViewRect around = rect.grown(0.1 * rect.width());
  picture.other_openings.push_back(std::exchange(picture.outline, opening.vertices()));
  picture.centre = rect.centre();
  for (PictureBolt& bolt : picture.bolts) bolt.is_elsewhere = !around.contains(bolt.head);
  for (PictureLining& lining : picture.linings)
    lining.is_elsewhere = !lining.nodes.empty() && !around.contains(lining.nodes.front().point);
}

}  // namespace detail

/// The ribs of a solver's linings on the wall of one opening; those along another axis, and around
/// another opening, are left out.
/// @param strip_width  see `UnrolledLining`
/// @param measured     that opening; none: the last one, with all that are along its axis
template <class Solver>
requires(Solver::dim == 3) [[nodiscard]] UnrolledLining
    unrolled_lining(const Solver& solver, double strip_width,
                    const std::optional<PrismaticOpening>& measured = {}) {
  UnrolledLining unrolled{{}, strip_width};
  const auto& openings = solver.mass().openings;
  if (openings.empty()) return unrolled;
  const PrismaticOpening& shown = measured ? *measured : openings.back();
  const TunnelAxis& axis = shown.axis();
  // Rounds of one tunnel share the origin of their sections: where one of them has it inside, it is
  // the centre of all.
  Vec2 centre = centre_of(shown);
  for (const auto& opening : openings)
    if (!measured && opening.axis().is_parallel_to(axis) &&
        opening.section().contains(zeros<Vec2>()))
      centre = zeros<Vec2>();
  const ViewRect around = *bounding_rect(shown.section().vertices());
  const std::vector<Vec3> along = lining_axes(solver);
  const double per = strip_width > 0 ? 1 / strip_width : 1;
  for (const RibForce& node : rib_forces(solver)) {
    if (std::abs(along[static_cast<std::size_t>(node.lining)].dot(axis.along())) < 1 - 1e-9)
      continue;
    const Vec3 seen = axis.local(node.position);
    if (measured && !around.grown(0.1 * around.width()).contains(Vec2(seen.x(), seen.y())))
      continue;
    const double angle = detail::angle_in_degrees(Vec2(seen.x(), seen.y()) - centre);
    unrolled.nodes.push_back(
        {seen.z(), angle > 270 ? angle - 360 : angle, per * node.thrust, per * node.moment});
  }
  return unrolled;
}

/// The picture of a constructed tunnel in 2-D: rock by displacement, opened and slipped joints,
/// bolts, diagrams of the lining.
/// @return  an SVG document
template <class Solver>
requires(Solver::dim == 2) [[nodiscard]] std::string
    draw_tunnel(const Solver& solver, const ConstructionResult<typename Solver::Geometry>& result,
                const TunnelPictureText& text = {}) {
  const double fallen = result.fallen_measure();
  const auto state = state_of(solver);
  BlocksPicture picture = picture_of(state, solver.mass(), bars_of(solver), text.lining_thickness);
  picture.loads = picture_loads(state, solver.mass(), text.loads);
  picture.header.title = text.title;
  picture.shows_whole_model = text.shows_whole_model;
  picture.header.lines = {verdict_sentence(result.last(), fallen, "m²", result.has_lost_lining())};
  picture.header.lines.insert(picture.header.lines.end(), text.remarks.begin(), text.remarks.end());
  picture.header.key_numbers = detail::key_numbers_of(solver, result, text);
  picture.banner = banner_of(result.verdict(), fallen, "m²", result.has_lost_lining());
  for (std::size_t k = 0; k < picture.bolts.size(); ++k)
    picture.bolts[k].says +=
        detail::words_of_strength(detail::max_force(picture.bolts[k]), k, text.bolt_strengths);
  for (PictureLining& lining : picture.linings)
    for (PictureLiningNode& node : lining.nodes)
      if (node.number < text.node_utilisations.size())
        node.says += detail::words_of_strength(text.node_utilisations[node.number]);
  if (result.measured) detail::look_at(picture, *result.measured);
  if (const auto tunnel = result.measured ? bounding_rect(result.measured->vertices())
                                          : detail::rect_of_tunnel(solver.mass()))
    picture.reference_thrust = detail::reference_thrust_of(solver, *tunnel);
  return draw_blocks_picture(picture);
}

/// Whether a joint has slipped by more than `visible_slip`, or its blocks have moved apart by more
/// than that.
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] bool has_slipped_or_opened(const Solver& solver, const JointArea& joint) {
  const ContactReport& report = joint.state.report;
  if (!report.is_open) return report.plastic_slip > visible_slip;
  return !is_across_gap(solver, joint) && detail::moved_apart(solver, joint) > visible_slip;
}

/// The joints of which `has_slipped_or_opened` is true; without slivers, which are too narrow to be
/// seen.
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<SlippedJoint> slipped_joints(const Solver& solver) {
  std::vector<SlippedJoint> slipped;
  const double sliver = 1e-4 * length_of(solver.mass().domain.size());
  for (JointArea& joint : joint_areas(solver)) {
    if (!has_slipped_or_opened(solver, joint)) continue;
    const ContactReport& report = joint.state.report;
    for (std::vector<Vec3>& polygon : joint.polygons)
      if (detail::mean_width(polygon) > sliver)
        slipped.push_back({std::move(polygon), report.plastic_slip, report.is_open, joint.state.a,
                           joint.state.b});
  }
  return slipped;
}

/// In 3-D, cut open: rock by displacement, joints by slip, bolts and lining by force, and below it
/// thrust and moment of every rib on the unrolled wall.
template <class Solver>
requires(Solver::dim == 3) [[nodiscard]] std::string
    draw_tunnel(const Solver& solver, const ConstructionResult<typename Solver::Geometry>& result,
                const TunnelPictureText& text = {}) {
  const double fallen = result.fallen_measure();
  TunnelView view = picture_of(state_of(solver), bars_of(solver));
  for (std::size_t k = 0; k < view.bolts.size(); ++k)
    view.bolts[k].says += detail::words_of_strength(view.bolts[k].force, k, text.bolt_strengths);
  view.axes = text.axes;
  view.header.title = text.title;
  view.header.lines = {verdict_sentence(result.last(), fallen, "m³", result.has_lost_lining())};
  if (std::string seen = look_from(text.from, solver.mass(), view, result.measured); !seen.empty())
    view.header.lines.push_back(std::move(seen));
  view.header.lines.insert(view.header.lines.end(), text.remarks.begin(), text.remarks.end());
  view.header.key_numbers = detail::key_numbers_of(solver, result, text);
  view.joints = slipped_joints(solver);
  view.unrolled = unrolled_lining(solver, text.strip_width, result.measured);
  view.banner = banner_of(result.verdict(), fallen, "m³", result.has_lost_lining());
  return draw_tunnel_view(solver.mass(), view);
}

/// The rock for ParaView: one cell for every convex part that is not detached, with the
/// displacement and the number of its block.
template <class Geometry>
[[nodiscard]] VtuGrid block_grid(const TunnelState<Geometry>& state,
                                 const RockMass<Geometry>& mass) {
  VOUSSOIR_ASSERT(state.blocks.size() == mass.bodies.size(),
                  "a state is of the rock that is drawn");
  VtuGrid grid;
  std::vector<double> moved, number;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const auto& block = state.blocks[b];
    if (block.is_gone) continue;
    const auto& u = block.displacement;
    for (const auto& part : mass.bodies[b].parts) {
      grid.add(part, block.motion);
      // A section lies in the x-z plane there, as its cells do.
      const double up = u[Geometry::dim - 1], across = Geometry::dim == 3 ? u[1] : 0;
      moved.insert(moved.end(), {u[0], across, up});
      number.push_back(static_cast<double>(b));
    }
  }
  grid.add_values("displacement_m", 3, moved);
  grid.add_values("block", 1, number);
  return grid;
}

/// The file of it.
template <class Geometry>
[[nodiscard]] std::string vtu_of(const TunnelState<Geometry>& state,
                                 const RockMass<Geometry>& mass) {
  return block_grid(state, mass).document();
}

}  // namespace voussoir
