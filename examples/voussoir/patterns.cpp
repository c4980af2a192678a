// SPDX-License-Identifier: MIT
#include "patterns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace voussoir::program {

namespace {

constexpr double degree = std::numbers::pi / 180, diameter = 10;
constexpr double released_at = 0.1;  ///< displacement at which the way of a block is looked at [m]
constexpr double lost_at = 0.3;      ///< displacement of rock that counts as lost [m]
constexpr double minor_area = 4;     ///< a smaller roof fall is called minor [m^2]
constexpr double angle_tolerance = 12 * degree;

/// Along the dip, downwards.
Vec2 down_dip(const PatternSet& set) {
  const double dip = set.dip * degree;
  return {(set.east ? 1 : -1) * elementary::cosine(dip), -elementary::sine(dip)};
}
/// The set whose line is nearest to a direction, or -1 if none is within the tolerance.
int set_along(const std::array<PatternSet, 3>& sets, const Vec2& direction) {
  int nearest = -1;
  double best = elementary::cosine(angle_tolerance);
  for (std::size_t k = 0; k < 3; ++k)
    if (const double c = std::abs(down_dip(sets[k]).dot(direction)); c > best) {
      best = c;
      nearest = static_cast<int>(k);
    }
  return nearest;
}
double acute_angle(const PatternSet& a, const PatternSet& b) {
  return std::acos(std::min(1.0, std::abs(down_dip(a).dot(down_dip(b)))));
}
/// Sets by falling dip.
std::array<int, 3> by_dip(const std::array<PatternSet, 3>& sets) {
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return sets[static_cast<std::size_t>(a)].dip > sets[static_cast<std::size_t>(b)].dip;
  });
  return order;
}
char letter(int set) { return static_cast<char>('A' + set); }

/// Where a block was before it moved.
enum class Place { roof, wall, elsewhere };
Place place_of(const Vec2& p) {
  const double angle = elementary::angle_of(p.y(), std::abs(p.x()));
  if (angle > 45 * degree && std::abs(p.x()) < diameter) return Place::roof;
  return angle > -45 * degree ? Place::wall : Place::elsewhere;
}

/// How a block moved when it came loose.
struct Release {
  bool seen = false;
  Vec2 way = Vec2::Zero();
  double turn = 0;
};

}  // namespace

const char* to_string(RoofFall fall) {
  switch (fall) {
    case RoofFall::none:
      return "none";
    case RoofFall::minor:
      return "minor fall";
    case RoofFall::wedge:
      return "wedge";
    case RoofFall::steepest:
      return "slides on steepest set";
    case RoofFall::second_steepest:
      return "slides on 2nd steepest set";
    case RoofFall::shallowest:
      return "slides on shallowest set";
    case RoofFall::mixed:
      return "ravels";
  }
  return "";
}
const char* to_string(WallFailure failure) {
  switch (failure) {
    case WallFailure::none:
      return "none";
    case WallFailure::sliding:
      return "sliding";
    case WallFailure::toppling:
      return "toppling";
    case WallFailure::both_ways:
      return "sliding on both sides";
    case WallFailure::other:
      return "other";
  }
  return "";
}

// Orientations, friction and the class of each mechanism: Table 1 of Boon et al. (2015).
const std::vector<PatternCase>& pattern_cases() {
  using R = RoofFall;
  using W = WallFailure;
  constexpr bool east = true, west = false;
  static const std::vector<PatternCase> cases = {
      {1, {{{60, east}, {40, east}, {80, west}}}, 35, R::wedge, W::none},
      {2, {{{10, east}, {30, west}, {50, west}}}, 35, R::wedge, W::toppling},
      {3, {{{80, east}, {5, east}, {65, west}}}, 35, R::wedge, W::sliding},
      {4, {{{20, west}, {60, west}, {80, west}}}, 35, R::wedge, W::none},
      {5, {{{40, east}, {20, east}, {50, west}}}, 35, R::steepest, W::sliding},
      {6, {{{55, east}, {25, east}, {45, west}}}, 35, R::second_steepest, W::none},
      {7, {{{60, east}, {80, east}, {40, west}}}, 35, R::minor, W::sliding},
      {8, {{{75, east}, {55, east}, {65, west}}}, 35, R::wedge, W::both_ways},
      {9, {{{60, east}, {85, east}, {80, west}}}, 25, R::minor, W::none},
      {10, {{{5, east}, {55, east}, {15, west}}}, 30, R::steepest, W::toppling},
      {11, {{{85, east}, {75, east}, {65, west}}}, 25, R::wedge, W::none},
      {12, {{{85, east}, {75, east}, {65, west}}}, 35, R::minor, W::none},
      {13, {{{85, east}, {75, east}, {55, west}}}, 30, R::wedge, W::both_ways},
      {14, {{{85, east}, {75, east}, {55, west}}}, 35, R::minor, W::sliding},
      {15, {{{85, east}, {75, east}, {45, west}}}, 30, R::minor, W::sliding},
      {16, {{{85, east}, {75, east}, {45, west}}}, 35, R::minor, W::sliding},
      {17, {{{85, east}, {75, east}, {35, west}}}, 35, R::minor, W::sliding},
      {18, {{{75, east}, {25, west}, {75, west}}}, 35, R::mixed, W::sliding},
      {19, {{{75, east}, {25, west}, {55, west}}}, 35, R::wedge, W::both_ways},
      {20, {{{75, east}, {25, west}, {45, west}}}, 35, R::steepest, W::sliding},
      {21, {{{75, east}, {25, east}, {25, west}}}, 35, R::steepest, W::sliding},
      {22, {{{75, east}, {45, east}, {25, west}}}, 35, R::steepest, W::sliding},
      {23, {{{75, east}, {85, east}, {25, west}}}, 35, R::minor, W::sliding},
      {24, {{{85, east}, {70, east}, {45, east}}}, 25, R::wedge, W::none},
  };
  return cases;
}

PatternResult run_pattern(const PatternCase& the_case, std::uint64_t seed,
                          const PatternOptions& options) {
  PatternResult result;
  result.number = the_case.number;
  result.seed = seed;
  // Rock mass A of the design case. Twice the diameter of rock above the crown is modelled, the
  // rest of the cover is a load.
  const double above = 2 * diameter;
  const auto opening = circular_opening(diameter);
  const Domain<2> ground = domain_around(opening, 4 * diameter, above, 1.2 * diameter);
  std::vector<JointSet> sets;
  for (std::size_t k = 0; k < 3; ++k)
    sets.push_back({std::string(1, letter(static_cast<int>(k))), the_case.sets[k].dip * degree,
                    the_case.sets[k].east ? DipDirection::east : DipDirection::west, 1 * degree, 1,
                    0, 1});
  const auto mass =
      carve(slice(ground, joint_network(sets, ground, seed), {0.25, 5}), opening, 0.074);
  DynamicsSettings settings;
  settings.local_damping = options.local_damping;
  settings.viscous_damping = options.viscous_damping;
  InSitu in_situ{.density = 2700};
  in_situ.surcharge = in_situ.density * in_situ.gravity * std::max(0.0, options.cover - above);
  auto run =
      moving_rock(mass, CoulombJoint({5e9, 5e8, the_case.friction * degree}), in_situ, settings);
  const std::size_t count = mass.bodies.size();
  result.blocks = static_cast<int>(count);
  std::vector<Release> releases(count);
  const auto displacement = [&](std::size_t b) {
    return Vec2(run.position(static_cast<int>(b)) - mass.bodies[b].properties.centroid);
  };
  const auto picture = [&] {
    PatternResult::Stage stage;
    stage.time = run.time();
    for (std::size_t b = 0; b < count; ++b) {
      if (mass.bodies[b].properties.centroid.norm() > 2.2 * diameter) continue;
      const Pose<2> motion = run.motion(static_cast<int>(b));
      for (const auto& part : mass.bodies[b].parts) {
        std::vector<Vec2> outline;
        for (const Vec2& v : part.vertices()) outline.push_back(motion(v));
        stage.outlines.push_back(std::move(outline));
        stage.released.push_back(displacement(b).norm() > released_at);
      }
    }
    result.stages.push_back(std::move(stage));
  };
  constexpr double look = 0.02;
  const double end = options.unloading + options.duration;
  const double first = options.unloading + 0.25 * options.duration;
  std::array<double, 4> shots{first, options.unloading + 0.5 * options.duration,
                              options.unloading + 0.75 * options.duration, end};
  std::size_t shot = 0;
  try {
    for (double t = 0; t < end - 1e-9; t += look) {
      const double done = options.unloading > 0 ? (t + 0.5 * look) / options.unloading : 1.0;
      run.set_held(std::max(0.0, 1 - done));
      run.advance(look);
      for (std::size_t b = 0; b < count; ++b) {
        const Vec2 u = displacement(b);
        if (releases[b].seen || !(u.norm() > released_at)) continue;
        releases[b] = {true, u.normalized(),
                       std::abs(run.body(static_cast<int>(b)).angle) *
                           run.body(static_cast<int>(b)).radius / u.norm()};
      }
      if (shot < shots.size() && run.time() >= shots[shot] - 1e-9) {
        picture();
        ++shot;
      }
    }
  } catch (const NumericalFault& fault) {
    result.note = fault.what();
    picture();
  }
  result.time = run.time() - options.unloading;
  result.imbalance = run.energy().relative_imbalance();

  // ---- how evenly the wall moves: by eighths of the circle ----
  std::array<double, 8> moved{}, area{};
  const auto eighth_of = [](const Vec2& place) {
    const double direction = elementary::angle_of(place.y(), place.x()) + 2 * std::numbers::pi;
    return static_cast<std::size_t>(direction / (0.25 * std::numbers::pi)) % 8;
  };
  for (std::size_t b = 0; b < count; ++b) {
    const auto& body = mass.bodies[b].properties;
    if (body.centroid.norm() > 0.75 * diameter) continue;
    moved[eighth_of(body.centroid)] += body.measure * displacement(b).norm();
    area[eighth_of(body.centroid)] += body.measure;
  }
  double sum_of_means = 0, largest_mean = 0;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const double mean = area[k] > 0 ? moved[k] / area[k] : 0.0;
    sum_of_means += mean;
    largest_mean = std::max(largest_mean, mean);
  }
  if (sum_of_means > 0) result.wall_unevenness = 8 * largest_mean / sum_of_means;

  // ---- what has been lost, and how ----
  std::vector<char> lost(count, 0);
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  for (std::size_t b = 0; b < count; ++b) {
    const auto& body = mass.bodies[b].properties;
    const Place place = place_of(body.centroid);
    if (!(displacement(b).norm() > lost_at)) continue;
    result.by_direction[eighth_of(body.centroid)] += body.measure;
    if (place == Place::elsewhere) continue;
    lost[b] = place == Place::roof;
    const Release& r = releases[b];
    const int along = set_along(the_case.sets, r.way);
    const bool falls = r.way.y() < -elementary::cosine(angle_tolerance);
    if (place == Place::roof) {
      result.roof_area += body.measure;
      if (falls)
        result.roof_free += body.measure;
      else if (along >= 0)
        result.roof_slides[static_cast<std::size_t>(along)] += body.measure;
      result.height = std::max(result.height, body.centroid.y() - 0.5 * diameter);
    } else {
      result.wall_area += body.measure;
      const bool left = body.centroid.x() < 0;
      (left ? result.left_area : result.right_area) += body.measure;
      if (r.turn > 0.5) {
        result.toppled += body.measure;
      } else if (along >= 0) {
        result.wall_slides[static_cast<std::size_t>(along)] += body.measure;
        (left ? result.left_slides : result.right_slides)[static_cast<std::size_t>(along)] +=
            body.measure;
      }
    }
  }
  double edge = 0;
  for (const auto& c : CutContacts::find(mass)) {
    if (lost[static_cast<std::size_t>(c.a)] == lost[static_cast<std::size_t>(c.b)]) continue;
    const double length = c.facet.length();
    edge += length;
    const int set = set_along(the_case.sets, (c.facet.end - c.facet.start) / length);
    if (set >= 0) result.bounds[static_cast<std::size_t>(set)] += length;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    result.roof_slides[k] = share(result.roof_slides[k], result.roof_area);
    result.wall_slides[k] = share(result.wall_slides[k], result.wall_area);
    result.left_slides[k] = share(result.left_slides[k], result.left_area);
    result.right_slides[k] = share(result.right_slides[k], result.right_area);
    result.bounds[k] = share(result.bounds[k], edge);
  }
  result.roof_free = share(result.roof_free, result.roof_area);
  result.toppled = share(result.toppled, result.wall_area);
  double widest = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = a + 1; b < 3; ++b)
      if (const double angle = acute_angle(the_case.sets[static_cast<std::size_t>(a)],
                                           the_case.sets[static_cast<std::size_t>(b)]);
          angle > widest + 1e-9) {
        widest = angle;
        result.widest_pair = {a, b};
      }

  // ---- names ----
  const auto order = by_dip(the_case.sets);
  const double two_largest = 1 - *std::min_element(result.bounds.begin(), result.bounds.end()) -
                             (1 - result.bounds[0] - result.bounds[1] - result.bounds[2]);
  const double slides = *std::max_element(result.roof_slides.begin(), result.roof_slides.end());
  if (result.roof_area < 0.2) {
    result.roof = RoofFall::none;
  } else if (result.roof_area < minor_area) {
    result.roof = RoofFall::minor;
  } else if (result.roof_free < 0.5 && slides > 0.4) {
    const int along =
        static_cast<int>(std::max_element(result.roof_slides.begin(), result.roof_slides.end()) -
                         result.roof_slides.begin());
    result.roof = along == order[0]   ? RoofFall::steepest
                  : along == order[1] ? RoofFall::second_steepest
                                      : RoofFall::shallowest;
  } else {
    result.roof = two_largest > 0.75 ? RoofFall::wedge : RoofFall::mixed;
  }
  if (result.wall_area < 0.5)
    result.wall = WallFailure::none;
  else if (result.toppled > 0.5)
    result.wall = WallFailure::toppling;
  else if (result.left_area > 0.25 * result.wall_area &&
           result.right_area > 0.25 * result.wall_area)
    result.wall = WallFailure::both_ways;
  else
    result.wall = result.wall_slides[0] + result.wall_slides[1] + result.wall_slides[2] > 0.4
                      ? WallFailure::sliding
                      : WallFailure::other;
  return result;
}

bool roof_agrees(const PatternCase& the_case, const PatternResult& result) {
  if (the_case.roof == result.roof) return true;
  if (the_case.roof != RoofFall::wedge) return false;
  // A wedge that slides on one of the two planes of the widest angle is still that wedge.
  const auto order = by_dip(the_case.sets);
  for (const int set : result.widest_pair) {
    if (result.roof == RoofFall::steepest && set == order[0]) return true;
    if (result.roof == RoofFall::second_steepest && set == order[1]) return true;
    if (result.roof == RoofFall::shallowest && set == order[2]) return true;
  }
  return false;
}
bool wall_agrees(const PatternCase& the_case, const PatternResult& result) {
  if (the_case.wall == result.wall) return true;
  return the_case.wall == WallFailure::sliding && result.wall == WallFailure::both_ways;
}

std::string description(const PatternResult& r) {
  const auto percent = [](double part) { return fixed_text(100 * part, 0) + " %"; };
  std::string text = std::string("roof: ") + to_string(r.roof);
  if (r.roof_area > 0) {
    text += ", " + fixed_text(r.roof_area, 1) + " m\u00b2, " + fixed_text(r.height, 1) +
            " m high; edge";
    for (int k = 0; k < 3; ++k)
      text += std::string(k ? ", " : " ") + letter(k) + " " +
              percent(r.bounds[static_cast<std::size_t>(k)]);
    text += "; falls free " + percent(r.roof_free) + ", slides";
    for (int k = 0; k < 3; ++k)
      text += std::string(k ? ", " : " ") + letter(k) + " " +
              percent(r.roof_slides[static_cast<std::size_t>(k)]);
  }
  text += std::string(". Walls: ") + to_string(r.wall);
  if (r.wall_area > 0)
    text += ", " + fixed_text(r.wall_area, 1) + " m\u00b2, turning " + percent(r.toppled);
  return text + ".";
}

std::string patterns_csv(const std::vector<PatternResult>& results) {
  CsvTable table(
      {"case",          "seed",          "blocks",        "time_s",        "energy_imbalance",
       "roof_m2",       "roof_height_m", "edge_A",        "edge_B",        "edge_C",
       "roof_free",     "roof_slides_A", "roof_slides_B", "roof_slides_C", "wall_m2",
       "wall_slides_A", "wall_slides_B", "wall_slides_C", "wall_turning",  "roof_measured",
       "roof_paper",    "roof_agrees",   "wall_measured", "wall_paper",    "wall_agrees",
       "note"});
  for (const PatternResult& r : results) {
    const PatternCase& c = pattern_cases()[static_cast<std::size_t>(r.number - 1)];
    table.add_row(r.number, static_cast<int>(r.seed), r.blocks, r.time, r.imbalance, r.roof_area,
                  r.height, r.bounds[0], r.bounds[1], r.bounds[2], r.roof_free, r.roof_slides[0],
                  r.roof_slides[1], r.roof_slides[2], r.wall_area, r.wall_slides[0],
                  r.wall_slides[1], r.wall_slides[2], r.toppled, std::string(to_string(r.roof)),
                  std::string(to_string(c.roof)), roof_agrees(c, r) ? 1 : 0,
                  std::string(to_string(r.wall)), std::string(to_string(c.wall)),
                  wall_agrees(c, r) ? 1 : 0, r.note);
  }
  return table.text();
}

namespace {

std::string case_title(const PatternCase& c) {
  std::string text = "Case " + std::to_string(c.number) + ": ";
  for (int k = 0; k < 3; ++k) {
    const PatternSet& s = c.sets[static_cast<std::size_t>(k)];
    text += std::string(k ? ", " : "") + letter(k) + " " + fixed_text(s.dip, 0) + "\u00b0" +
            (s.east ? "E" : "W");
  }
  return text + ", friction " + fixed_text(c.friction, 0) + "\u00b0";
}

void draw_stage(SvgCanvas& canvas, const PatternResult::Stage& stage, const ViewRect& frame,
                const std::string& id) {
  const ViewRect world{{-1.15 * diameter, -0.75 * diameter}, {1.15 * diameter, 1.55 * diameter}};
  const PageMap map = PageMap::equal_scales(world, frame);
  canvas.clip_rectangle(id, frame);
  canvas.begin_layer("stage-" + id, id);
  SvgPath held(1), released(1);
  for (std::size_t k = 0; k < stage.outlines.size(); ++k) {
    if (!std::any_of(stage.outlines[k].begin(), stage.outlines[k].end(),
                     [&](const Vec2& p) { return world.contains(p); }))
      continue;
    (stage.released[k] ? released : held).add_polygon(on_page(stage.outlines[k], map));
  }
  canvas.path(held, {.fill = "#e3e0d8", .stroke = "#555", .stroke_width = 0.35});
  canvas.path(released, {.fill = "#d9805f", .stroke = "#555", .stroke_width = 0.35});
  canvas.end_layer();
  canvas.rectangle(frame, {.stroke = "#333", .stroke_width = 0.8});
}

}  // namespace

std::string pattern_svg(const PatternResult& r) {
  const PatternCase& c = pattern_cases()[static_cast<std::size_t>(r.number - 1)];
  PictureHeader header;
  header.title = case_title(c);
  header.lines = {
      "Measured, seed " + std::to_string(r.seed) + ". " + description(r),
      std::string("Paper: roof: ") + to_string(c.roof) + "; walls: " + to_string(c.wall) + "."};
  if (!r.note.empty()) header.lines.push_back("Ended early: " + r.note);
  const double banner_room = r.note.empty() ? 0 : PictureBanner::height + 10;
  const double top = header.height() + banner_room;
  const double side = 0.5 * (picture_width - 3 * picture_margin);
  SvgCanvas canvas(picture_width, top + 2 * (side + 30), picture_printed_width, header.title);
  header.draw(canvas);
  if (!r.note.empty())
    PictureBanner{"ENDED EARLY",
                  "a numerical fault ended this run: what is drawn last is no result"}
        .draw(canvas,
              {{picture_margin, header.height()},
               {picture_width - picture_margin, header.height() + PictureBanner::height}},
              header.height());
  for (std::size_t k = 0; k < r.stages.size() && k < 4; ++k) {
    const Vec2 low(picture_margin + static_cast<double>(k % 2) * (side + picture_margin),
                   top + static_cast<double>(k / 2) * (side + 30));
    draw_stage(canvas, r.stages[k], {low, low + Vec2::Constant(side)}, "s" + std::to_string(k));
    canvas.text(low + Vec2(0, side + 16),
                fixed_text(r.stages[k].time, 2) + " s from the beginning of the unloading");
  }
  return canvas.document();
}

std::string patterns_sheet(const std::vector<PatternResult>& results) {
  std::map<int, std::vector<const PatternResult*>> by_case;
  for (const PatternResult& r : results) by_case[r.number].push_back(&r);
  PictureHeader header;
  header.title = "How unsupported tunnels fail: the cases of Table 1, every block moving";
  int roofs = 0, walls = 0;
  for (const PatternResult& r : results) {
    const PatternCase& c = pattern_cases()[static_cast<std::size_t>(r.number - 1)];
    roofs += roof_agrees(c, r);
    walls += wall_agrees(c, r);
  }
  const auto of_all = [&](int n) {
    return std::to_string(n) + " of " + std::to_string(results.size());
  };
  header.key_numbers = {{"runs", std::to_string(results.size())},
                        {"roof named as in the paper", of_all(roofs)},
                        {"walls named as in the paper", of_all(walls)}};
  constexpr int columns = 3;
  const double width = (picture_width - 2 * picture_margin) / columns, side = width - 12;
  constexpr double letters = 14.5, line = 1.25 * letters;  // to be read at the width of a page
  const double row = side + 5.5 * line + 12;
  const auto rows = static_cast<double>((by_case.size() + columns - 1) / columns);
  header.lines = {
      "The first realisation of each case. Below it what the paper sees at the roof and at the walls, and "
      "what realisations 1 to 3 do, with m\u00b2 lost."};
  std::map<int, std::vector<std::string>> captions;
  double size = letters;  // one for all captions
  for (const auto& [number, runs] : by_case) {
    const PatternCase& c = pattern_cases()[static_cast<std::size_t>(number - 1)];
    std::vector<std::string>& lines = captions[number];
    lines = {case_title(c), std::string("paper: ") + to_string(c.roof) + "; " + to_string(c.wall)};
    for (std::size_t k = 0; k < runs.size() && k < 3; ++k)
      lines.push_back(std::to_string(runs[k]->seed) + ": " + to_string(runs[k]->roof) + " " +
                      fixed_text(runs[k]->roof_area, 0) + "; " + to_string(runs[k]->wall) + " " +
                      fixed_text(runs[k]->wall_area, 0));
    for (const std::string& text : lines)
      size = std::min(
          size,
          letters * side /
              std::max(1.0, text_width(text, {.size = letters, .bold = &text == &lines.front()})));
  }
  const double top = header.height() + 6;
  SvgCanvas canvas(picture_width, top + rows * row + 10, picture_printed_width, header.title);
  header.draw(canvas);
  std::size_t place = 0;
  for (const auto& [number, runs] : by_case) {
    const Vec2 low(picture_margin + static_cast<double>(place % columns) * width,
                   top + static_cast<double>(place / columns) * row);
    if (!runs.front()->stages.empty())
      draw_stage(canvas, runs.front()->stages.back(), {low, low + Vec2::Constant(side)},
                 "c" + std::to_string(number));
    double y = side;
    for (const std::string& text : captions[number])
      canvas.text(low + Vec2(0, y += line), text,
                  {.size = size, .bold = &text == &captions[number].front()});
    ++place;
  }
  return canvas.document();
}

}  // namespace voussoir::program
