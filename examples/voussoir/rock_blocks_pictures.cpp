// SPDX-License-Identifier: MIT
// Pictures of `voussoir blocks`: the curve of sizes, the section, the wall unrolled.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <voussoir/core/elementary.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/io/mass_picture.hpp>
#include <voussoir/rockmass/wall_outline.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>

#include "mapped_rock.hpp"
#include "rock_blocks.hpp"

namespace voussoir::program {

std::string block_sizes_svg(const Input& input, const RockBlocks& rock) {
  const WholeBlockSizes& sizes = rock.sizes;
  const bool is_spatial = input.is_spatial();
  const std::string unit = is_spatial ? "m³" : "m²";
  PictureHeader header;
  header.title = input.title.empty() ? "Block sizes in situ" : input.title;
  header.lines = {std::string("Share of the rock in blocks up to a size, in situ, by ") +
                  (is_spatial ? "volume; " : "area; ") + counted(sizes.count(), "block") + ", " +
                  std::to_string(sizes.cut_count()) + " at the sides of the model are left out."};
  if (sizes.count() > 0)
    for (const int percent : {10, 50, 90})
      header.key_numbers.push_back({"D" + std::to_string(percent) + " (" +
                                        readable_text(sizes.true_size_at(0.01 * percent)) +
                                        " edge-corrected)",
                                    readable_text(sizes.size_at(0.01 * percent)) + " " + unit});
  const double top = header.height() + 30;
  const ViewRect frame{{76, top}, {picture_width - picture_margin, top + 380}};
  SvgCanvas canvas(picture_width, frame.high.y() + 96, picture_printed_width, header.title);
  header.draw(canvas);
  if (sizes.count() == 0) {
    canvas.text(frame.centre(), "no block lies whole in the model",
                {.size = 14.5, .anchor = TextAnchor::middle});
    return canvas.document();
  }
  const auto decade = [](double size) {
    return elementary::logarithm(size) / elementary::logarithm(10);
  };
  const double least = round_down_125(0.99 * sizes.blocks().front().size),
               most = round_up_125(1.01 * sizes.blocks().back().size);
  const double low = decade(least), high = decade(most);
  const PageMap map({{low, 0}, {high, 100}}, frame);
  canvas.begin_layer("axes");
  for (double power = std::floor(low - 1e-9); power <= high; ++power)
    for (int digit = 1; digit <= 9; ++digit) {
      const double size = digit * elementary::power(10, power), x = map({decade(size), 0}).x();
      if (size < 0.999 * least || size > 1.001 * most) continue;
      canvas.line({x, frame.low.y()}, {x, frame.high.y()},
                  {.stroke = digit == 1 ? "#bbb" : "#e6e6e6", .stroke_width = 0.6});
      if (digit == 1 || ((digit == 2 || digit == 5) && high - low <= 4))
        canvas.text({x, frame.high.y() + 18}, readable_text(size, 1),
                    {.anchor = TextAnchor::middle});
    }
  for (int percent = 0; percent <= 100; percent += 10) {
    const double y = map({low, static_cast<double>(percent)}).y();
    canvas.line({frame.low.x(), y}, {frame.high.x(), y},
                {.stroke = percent % 50 == 0 ? "#bbb" : "#e6e6e6", .stroke_width = 0.6});
    canvas.text({frame.low.x() - 6, y + 4.5}, std::to_string(percent), {.anchor = TextAnchor::end});
  }
  canvas.rectangle(frame, {.stroke = "#111", .stroke_width = 0.8});
  canvas.text({frame.low.x(), frame.low.y() - 10}, "rock in blocks up to this size [%]");
  canvas.text({frame.high.x(), frame.high.y() + 38}, "block size [" + unit + "]",
              {.anchor = TextAnchor::end});
  canvas.end_layer();
  // Of very many blocks those that are a tenth of a pixel apart are one.
  const auto curve = [&](double WholeBlock::*passing) {
    std::vector<Vec2> points;
    double before = 0;
    for (const WholeBlock& block : sizes.blocks()) {
      const Vec2 foot = map({decade(block.size), 100 * before});
      before = block.*passing;
      const Vec2 head = map({decade(block.size), 100 * before});
      if (!points.empty() && length_of(head - points.back()) < 0.1) continue;
      points.push_back(foot);
      points.push_back(head);
    }
    points.push_back(map({decade(sizes.blocks().back().size), 100}));
    return points;
  };
  const SvgStyle counted{.stroke = "#2c5f8a", .stroke_width = 2},
      corrected{.stroke = "#b3541e", .stroke_width = 1.5, .dash = "6 3"};
  canvas.begin_layer("curves");
  canvas.polyline(curve(&WholeBlock::true_passing), corrected);
  canvas.polyline(curve(&WholeBlock::passing), counted);
  canvas.end_layer();
  const auto dash = [](const SvgStyle& style) {
    return [style](SvgCanvas& c, const Vec2& at) {
      c.line(at - Vec2(12, 0), at + Vec2(12, 0), style);
    };
  };
  const Legend legend({{"blocks that lie whole in the model", dash(counted)},
                       {"corrected for those that the sides have cut", dash(corrected)}},
                      frame.width());
  legend.draw(canvas, {frame.low.x(), frame.high.y() + 66});
  return canvas.document();
}

namespace {

const char* colour_of(BlockMode mode) {
  switch (mode) {
    case BlockMode::falls:
      return "#c8402e";
    case BlockMode::slides_on_one_face:
    case BlockMode::slides_on_two_faces:
      return "#e8a33d";
    case BlockMode::rests:
      return "#b9d3a8";
    case BlockMode::tapered:
      break;
  }
  return "#e4e4e0";
}

PictureHeader rock_header(const Input& input, const std::string& line) {
  PictureHeader header;
  header.title = input.title.empty() ? "Tunnel in jointed rock" : input.title;
  header.lines = {line};
  return header;
}

std::vector<LegendItem> legend_of_modes() {
  const auto box = [](BlockMode mode) {
    return [mode](SvgCanvas& c, const Vec2& at) {
      c.rectangle({at - Vec2(11, 6), at + Vec2(11, 6)},
                  {.fill = colour_of(mode), .stroke = "#555", .stroke_width = 0.6});
    };
  };
  return {{"falls", box(BlockMode::falls)},
          {"slides if friction is too low", box(BlockMode::slides_on_one_face)},
          {"rests, could be lifted or pulled out", box(BlockMode::rests)},
          {"wedged in, not judged or not at the wall", box(BlockMode::tapered)}};
}

std::vector<BlockMode> modes_of_bodies(const RockBlocks& rock, std::size_t count) {
  std::vector<BlockMode> modes(count, BlockMode::tapered);
  for (const RemovableBlock& block : rock.removable)
    modes[static_cast<std::size_t>(block.body)] = block.mode;
  return modes;
}

std::string section_svg(const Input& input, const RockBlocks& rock, const RockMass<Planar>& mass) {
  const PictureHeader header =
      rock_header(input,
                  "Blocks at the wall that can move out, by kinematics alone; numbers: "
                  "those of removable.csv.");
  const std::optional<ViewRect> opening = bounding_rect(mass.openings.back().vertices());
  const double reach = 1.2 * std::max(opening->width(), opening->height());
  const double width = picture_width - 2 * picture_margin, top = header.height();
  const ViewRect frame{{picture_margin, top}, {picture_margin + width, top + 0.8 * width}};
  const PageMap map = PageMap::equal_scales(
      {opening->centre() - Vec2(reach, 0.8 * reach), opening->centre() + Vec2(reach, 0.8 * reach)},
      frame);
  const Legend legend(legend_of_modes(), width);
  SvgCanvas canvas(picture_width, frame.high.y() + legend.height() + 60, picture_printed_width,
                   header.title);
  header.draw(canvas);
  const std::vector<BlockMode> modes = modes_of_bodies(rock, mass.bodies.size());
  canvas.clip_rectangle("view", frame);
  canvas.begin_layer("blocks", "view");
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const ConvexPolygon& part : mass.bodies[b].parts) {
      const auto corners = bounding_rect(part.vertices());
      if (!corners || !corners->overlaps(map.world())) continue;
      // Parts of one block have no line between them.
      canvas.polygon(on_page(part.vertices(), map), {.fill = colour_of(modes[b])});
      SvgPath edges;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const int label = part.cut(k);
        const bool is_seam = mass.bodies[b].parts.size() > 1 && label >= 0 &&
                             mass.cuts[static_cast<std::size_t>(label)].kind != Cut::Kind::joint;
        if (!is_seam) edges.add_line(map(part.face(k).start), map(part.face(k).end));
      }
      canvas.path(edges, {.stroke = "#555", .stroke_width = 0.7});
    }
  canvas.polygon(on_page(mass.openings.back().vertices(), map),
                 {.stroke = "#111", .stroke_width = 1.6});
  canvas.end_layer();
  canvas.begin_layer("numbers", "view");
  for (std::size_t k = 0; k < shown_count(rock); ++k) {
    const auto& body = mass.bodies[static_cast<std::size_t>(rock.removable[k].body)];
    canvas.text(map(body.properties.centroid) + Vec2(0, 4.5), std::to_string(k + 1),
                {.anchor = TextAnchor::middle, .bold = true, .halo = true});
  }
  canvas.end_layer();
  canvas.rectangle(frame, {.stroke = "#111", .stroke_width = 0.8});
  draw_scale_bar(canvas, {frame.low.x() + 10, frame.high.y() + 24}, 130, map.scale());
  legend.draw(canvas, {frame.low.x() + 10, frame.high.y() + 62});
  return canvas.document();
}

/// The middle of the floor or of the crown, from vertex 0 along the outline [m].
double place_at(const WallOutline& outline, bool of_crown) {
  double best = -std::numeric_limits<double>::infinity(), place = 0;
  for (std::size_t e = 0; e < outline.size(); ++e) {
    const Segment& edge = outline.edge(e);
    const double across = edge.end.x() - edge.start.x();
    const double t = across != 0 ? std::clamp(-edge.start.x() / across, 0.0, 1.0) : 0.0;
    const Vec2 point = edge.at(t);
    const double height = (of_crown ? point.y() : -point.y()) - std::abs(point.x());
    if (height <= best) continue;
    best = height;
    place = outline.start(e) + t * edge.length();
  }
  return place;
}

/// Where two blocks, or what is left of one and a hole, meet on the wall: sides of its pieces that
/// do not lie along an edge of the outline.
template <class Unroll>
SvgPath joints_on_wall(const RockMass<Spatial>& mass, const PrismaticOpening& opening,
                       const WallOutline& outline, const Unroll& unrolled, const PageMap& map) {
  SvgPath path;
  const double around = outline.start(outline.size());
  for (const WallPiece<Spatial>& piece : wall_pieces(mass, opening)) {
    const auto e = static_cast<std::size_t>(piece.edge);
    const double length = outline.edge(e).length(), start = unrolled(outline.start(e));
    const std::vector<Vec3>& corners = piece.facet.vertices;
    const auto place = [&](const Vec3& v) {
      return std::clamp(outline.place(e, opening.across(v)), 0.0, length);
    };
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 &p = corners[k], &q = corners[k + 1 == corners.size() ? 0 : k + 1];
      const double from = place(p), to = place(q), slack = 1e-6 * length;
      const bool is_along_edge =
          (from < slack && to < slack) || (from > length - slack && to > length - slack);
      if (is_along_edge && piece.hole < 0) continue;
      for (const double shift : {0.0, around}) {
        if (shift > 0 && start - length > -1e-9) continue;
        path.add_line(map({start - from + shift, opening.along(p)}),
                      map({start - to + shift, opening.along(q)}));
      }
    }
  }
  return path;
}

}  // namespace

std::string rock_svg(const Input& input, const RockBlocks& rock) {
  if (const auto* section = std::get_if<RockMass<Planar>>(&rock.excavated))
    return section_svg(input, rock, *section);
  MassPicture picture;
  picture.header = rock_header(input, "The rock as it is before anything moves.");
  picture.axes = {"right", "along", "up"};
  picture.y_azimuth = input.tunnel.trend.value_or(0);
  for (const JointSetInput& set : input.joint_sets) picture.set_names.push_back(set.name);
  return draw_mass_picture(std::get<RockMass<Spatial>>(rock.excavated), picture);
}

std::string wall_svg(const Input& input, const RockBlocks& rock) {
  const auto& mass = std::get<RockMass<Spatial>>(rock.excavated);
  const PrismaticOpening& opening = mass.openings.back();
  const WallOutline outline(opening);
  const double around = outline.start(outline.size()), floor = place_at(outline, false);
  // Places along the outline go from right to left over the crown.
  const auto unrolled = [&](double place) {
    const double u = floor - place;
    return u < 0 ? u + around : u;
  };
  const ViewRect world{{0, mass.domain.low.y()},
                       {around, std::min(mass.domain.high.y(), opening.to())}};
  const PictureHeader header =
      rock_header(input,
                  "The wall unrolled, as on a plan: the floor is cut along its middle; "
                  "numbers: those of removable.csv.");
  const double left = 64, width = picture_width - picture_margin - left, top = header.height() + 30;
  const ViewRect frame{{left, top}, {left + width, top + width * world.height() / world.width()}};
  const PageMap map(world, frame);
  const Legend legend(legend_of_modes(), picture_width - 2 * picture_margin);
  SvgCanvas canvas(picture_width, frame.high.y() + legend.height() + 70, picture_printed_width,
                   header.title);
  header.draw(canvas);
  const std::vector<BlockMode> modes = modes_of_bodies(rock, mass.bodies.size());
  std::vector<std::optional<std::pair<double, Vec2>>> largest(mass.bodies.size());
  canvas.clip_rectangle("view", frame);
  canvas.begin_layer("wall", "view");
  for (const WallPiece<Spatial>& piece : wall_pieces(mass, opening)) {
    const auto edge = static_cast<std::size_t>(piece.edge),
               b = static_cast<std::size_t>(piece.body);
    const double length = outline.edge(edge).length(), start = unrolled(outline.start(edge));
    std::vector<Vec2> corners;
    Vec2 middle = Vec2::Zero();
    for (const Vec3& v : piece.facet.vertices) {
      const double along_edge = std::clamp(outline.place(edge, opening.across(v)), 0.0, length);
      corners.emplace_back(start - along_edge, opening.along(v));
      middle += corners.back() / static_cast<double>(piece.facet.vertices.size());
    }
    // The edge that is cut along the floor is at both sides of the page.
    for (const double shift : {0.0, around}) {
      if (shift > 0 && start - length > -1e-9) continue;
      std::vector<Vec2> moved = corners;
      for (Vec2& corner : moved) corner.x() += shift;
      canvas.polygon(
          on_page(moved, map),
          {.fill = colour_of(modes[b]), .stroke = colour_of(modes[b]), .stroke_width = 0.5});
    }
    if (middle.x() < 0) middle.x() += around;
    if (const double area = piece.facet.measure(); !largest[b] || area > largest[b]->first)
      largest[b] = std::pair(area, middle);
  }
  canvas.path(joints_on_wall(mass, opening, outline, unrolled, map),
              {.stroke = "#555", .stroke_width = 0.8});
  canvas.end_layer();
  canvas.begin_layer("numbers");
  for (std::size_t k = 0; k < shown_count(rock); ++k)
    if (const auto& place = largest[static_cast<std::size_t>(rock.removable[k].body)])
      canvas.text(map(place->second) + Vec2(0, 4.5), std::to_string(k + 1),
                  {.anchor = TextAnchor::middle, .bold = true, .halo = true});
  canvas.end_layer();
  canvas.begin_layer("axes");
  canvas.rectangle(frame, {.stroke = "#111", .stroke_width = 0.8});
  const double crown = map({unrolled(place_at(outline, true)), 0}).x();
  canvas.line({crown, frame.low.y()}, {crown, frame.high.y()},
              {.stroke = "#111", .stroke_width = 0.8, .dash = "8 4"});
  const std::vector<std::pair<double, std::string>> names{
      {frame.low.x(), "floor"},
      {0.5 * (frame.low.x() + crown), "left wall"},
      {crown, "crown"},
      {0.5 * (frame.high.x() + crown), "right wall"},
      {frame.high.x() - 14, "floor"}};
  for (const auto& [x, name] : names)
    canvas.text({x, frame.low.y() - 8}, name, {.anchor = TextAnchor::middle});
  const RoundTicks ticks = round_ticks(world.low.y(), world.high.y(), 8);
  for (const double value : ticks.values)
    canvas.text(map({0, value}) + Vec2(-6, 4.5), ticks.label(value), {.anchor = TextAnchor::end});
  canvas.text({16, frame.centre().y()}, "along [m]",
              {.anchor = TextAnchor::middle, .rotation = -90});
  draw_scale_bar(canvas, {frame.low.x(), frame.high.y() + 20}, 130, map.scale());
  canvas.end_layer();
  legend.draw(canvas, {picture_margin, frame.high.y() + 48});
  return canvas.document();
}

}  // namespace voussoir::program
