// SPDX-License-Identifier: MIT
#include "blocks_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/rockmass/domain.hpp>

#include "input_document.hpp"
#include "rock_loads.hpp"

namespace voussoir::program {

namespace {

constexpr std::size_t most_blocks = 10000, most_corners = 100;
constexpr std::size_t most_bytes = 10'000'000;
/// Of one kind that are shown: a file whose units are wrong has thousands.
constexpr int most_shown = 10;

constexpr Range way_range{.low = -1000, .high = 1000};  // of a fixed block [m]
constexpr Range part_range{.low = -10, .high = 10};     // of the weight [-]

const std::string corners_form =
    R"(3 to 100 corners of a convex polygon, either way round, such as [["0 m", "0 m"], ["2 m", "0 m"], ["1 m", "1 m"]])";
const std::string force_form =
    R"(two forces per metre out of plane, to the right and up, such as ["10 kN/m", "-5 kN/m"])";
const std::string moment_form =
    R"(a moment per metre out of plane, anticlockwise, such as "5 kN m/m")";

std::string in_quotes(const std::string& name) {
  std::string text = "\"";
  text += printable(name);
  return text += '"';
}

Vec2 vec_of(const Point& p) { return {p[0], p[1]}; }

std::vector<Vec2> corners_of(const LaidBlockInput& block) {
  std::vector<Vec2> corners;
  for (const Point& p : block.vertices) corners.push_back(vec_of(p));
  return corners;
}

/// Turns the vertices anticlockwise.
/// @return  what keeps them from being a convex polygon; empty if they are
std::string convex_fault(std::vector<Point>& vertices) {
  double doubled = 0;
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k)
    doubled += cross(vec_of(vertices[k]) - vec_of(vertices[0]),
                     vec_of(vertices[k + 1]) - vec_of(vertices[0]));
  if (doubled < 0) std::reverse(vertices.begin() + 1, vertices.end());  // the first stays so
  try {
    (void)ConvexPolygon(corners_of({.name = "", .vertices = vertices}));
  } catch (const InvalidInput& fault) {
    return std::string("is no block: ") + fault.what();
  }
  return "";
}

/// The name of a block as a key has it: a text, or a whole number that stands for its digits.
std::optional<std::string> name_in(const Value& value) {
  if (value.node().kind == Node::Kind::integer) return std::to_string(value.node().integer);
  return value.as_text();
}

class Reader {
 public:
  Reader(Section& file, LaidInput& laid, const std::filesystem::path& directory)
      : file_(file), checker_(file.checker()), laid_(laid), directory_(directory) {}

  void read() {
    file_.tables("block", [&](Section& s, std::size_t i) { read_block(s, i); });
    file_.table("blocks", [&](Section& s) { read_file(s); });
    check_names();
    if (!checker_.faulty("block") && !checker_.faulty("blocks")) check_places();
    file_.tables("load", [&](Section& s, std::size_t) { read_load(s); });
    file_.tables("displacement", [&](Section& s, std::size_t) { read_displacement(s); });
    file_.optional_table("seismic", [&](Section& s) {
      s.quantity("kh", laid_.kh, dimension::number, part_range, Need::optional);
      s.quantity("kv", laid_.kv, dimension::number, part_range, Need::optional);
    });
    file_.table("loading", [&](Section& s) { s.integer("steps", laid_.steps, 1, 10000); });
    if (file_.has("loading") && !checker_.faulty("") && !laid_.has_loading())
      file_.complain("loading", "has nothing to bring on",
                     "with a [[displacement]], a [seismic] or a proportional [[load]]");
    const auto fixed = [](const LaidBlockInput& block) { return block.fixed; };
    if (!checker_.faulty("block") && !checker_.faulty("blocks") &&
        std::none_of(laid_.blocks.begin(), laid_.blocks.end(), fixed))
      file_.complain(file_.has("block") ? "block" : "blocks",
                     "has no fixed block: nothing would carry the others",
                     "fixed = true in a [[block]], or [blocks] fixed = [\"name\"]");
  }

 private:
  void read_block(Section& s, std::size_t i) {
    LaidBlockInput block{.name = std::to_string(i + 1)};
    if (const auto value = s.find("name", Need::optional, "a text or a whole number")) {
      block.name = name_in(*value).value_or(block.name);
      if (block.name.empty()) value->refuse("is empty", "a name, or no key");
    }
    if (const auto value = s.find("vertices", Need::required, corners_form)) {
      const auto points = value->as_list(3, most_corners, corners_form);
      for (std::size_t k = 0; points && k < points->size(); ++k)
        if (const auto point = points->at(k).as_point()) block.vertices.push_back(*point);
      if (points && block.vertices.size() == points->size())
        if (const std::string fault = convex_fault(block.vertices); !fault.empty())
          checker_.report(value->node().place, value->key(), value->key() + " " + fault,
                          corners_form);
    }
    s.flag("fixed", block.fixed);
    keys_.push_back("block[" + std::to_string(i) + "]");
    laid_.blocks.push_back(std::move(block));
  }

  void read_file(Section& s) {
    const std::string form = "a file name, relative to the input file";
    s.only_with(false, "a model with [tunnel]", [&] {
      for (const char* key : {"min_inscribed_radius", "max_elongation", "min_wall_area"})
        (void)s.find(key, Need::optional);
    });
    const auto value = s.find("file", Need::optional, form);
    const auto text = value ? value->as_text() : std::nullopt;
    if (text && text->empty()) value->refuse("is empty", form);
    if (text && !text->empty()) {
      laid_.file = directory_ / utf8_path(*text);
      read_corners(*value);
    }
    const auto fixed = s.find("fixed", Need::optional, "a list of names");
    const auto names = fixed ? fixed->as_list(0, most_blocks, "a list of names") : std::nullopt;
    for (std::size_t k = 0; names && k < names->size(); ++k)
      if (const int block = block_in(names->at(k)); block >= 0)
        laid_.blocks[static_cast<std::size_t>(block)].fixed = true;
  }

  /// Rows id,x,y: the corners of a block in a row, blocks one after the other.
  void read_corners(const Value& value) {
    const std::string form =
        "a regular text file with rows id,x,y in metres: the corners of each block, one below the "
        "other";
    const std::string name = utf8_text(laid_.file);
    std::error_code error;
    if (!std::filesystem::is_regular_file(laid_.file, error))
      return value.refuse("cannot be read: " + name + " is no regular file", form);
    if (std::filesystem::file_size(laid_.file, error) > most_bytes)
      return value.refuse("is larger than 10 MB", form);
    std::istringstream in(file_text(laid_.file));
    int line_number = 0, shown = 0;
    const auto complain = [&](const std::string& text) {
      if (++shown <= most_shown)
        checker_.report(value.node().place, value.key(),
                        name + ", line " + std::to_string(line_number) + ": " + text, form);
    };
    const std::size_t first = laid_.blocks.size();
    for (std::string line; std::getline(in, line);) {
      ++line_number;
      if (line.ends_with('\r')) line.pop_back();
      if (line.empty() || line.starts_with('#') || (line_number == 1 && line.starts_with("id")))
        continue;
      const std::size_t comma = line.find(','), next = line.find(',', comma + 1);
      Point at;
      if (comma == 0 || next == std::string::npos ||
          !number_in(line.substr(comma + 1, next - comma - 1), at[0]) ||
          !number_in(line.substr(next + 1), at[1])) {
        complain(in_quotes(line) + " is not id,x,y");
        continue;
      }
      const std::string id = line.substr(0, comma);
      if (laid_.blocks.size() == first || laid_.blocks.back().name != id) {
        if (laid_.blocks.size() >= most_blocks) return complain("more than 10000 blocks");
        keys_.push_back(value.key());
        laid_.blocks.push_back({.name = id});
      }
      laid_.blocks.back().vertices.push_back(at);
    }
    if (laid_.blocks.size() == first && shown == 0)
      return value.refuse("has no block in it: " + name, form);
    for (std::size_t b = first; b < laid_.blocks.size(); ++b) {
      const std::string fault = convex_fault(laid_.blocks[b].vertices);
      if (!fault.empty() && ++shown <= most_shown)
        checker_.report(value.node().place, value.key(),
                        name + ": block \"" + printable(laid_.blocks[b].name) + "\" " + fault,
                        form);
    }
    if (shown > most_shown)
      checker_.report(value.node().place, value.key(),
                      name + ": and " + std::to_string(shown - most_shown) + " more", form);
  }
  static std::string file_text(const std::filesystem::path& path);
  static bool number_in(std::string text, double& number) {
    const auto blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && blank(text.front())) text.erase(0, 1);
    while (!text.empty() && blank(text.back())) text.pop_back();
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    return status == std::errc() && end == text.data() + text.size() && std::isfinite(number);
  }

  /// The number of the block that a key names; -1, and reported, if there is none.
  int block_in(const Value& value) {
    const auto name = name_in(value);
    if (!name) return -1;
    std::vector<std::string> names;
    for (const LaidBlockInput& block : laid_.blocks) {
      if (block.name == *name) return static_cast<int>(names.size());
      names.push_back(block.name);
    }
    const std::string guess = closest(*name, names);
    std::string accepted = "the name of a block";
    for (std::size_t k = 0; k < names.size() && k < 8; ++k)
      accepted += (k == 0 ? ": \"" : ", \"") + printable(names[k]) + "\"";
    if (names.size() > 8) accepted += ", ...";
    // Where blocks could not be read, theirs is the error.
    if (!checker_.faulty("block") && !checker_.faulty("blocks.file"))
      value.refuse("names no block" + (guess.empty() ? "" : ", did you mean \"" + guess + "\"?"),
                   accepted);
    return -1;
  }

  void check_names() {
    std::vector<std::size_t> order(laid_.blocks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return laid_.blocks[a].name < laid_.blocks[b].name;
    });
    for (std::size_t k = 1; k < order.size(); ++k) {
      const std::string& name = laid_.blocks[order[k]].name;
      if (name != laid_.blocks[order[k - 1]].name) continue;
      const bool in_file = keys_[order[k]] == "blocks.file";
      checker_.report(keys_[order[k]] + (in_file ? "" : ".name"),
                      in_file ? "has a block \"" + printable(name) +
                                    "\" twice, or its corners are not one below the other"
                              : "is the name of another block, too: \"" + printable(name) + "\"",
                      "a name of its own for every block");
    }
  }

  /// Blocks that overlap, and others that nearly touch.
  void check_places() {
    std::vector<ConvexPolygon> shapes;
    Vec2 low = Vec2::Constant(1e300), high = -low;
    for (const LaidBlockInput& block : laid_.blocks) {
      shapes.emplace_back(corners_of(block));
      for (const Vec2& v : shapes.back().vertices()) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
    }
    if (shapes.empty()) return;
    const Vec2 margin = 0.1 * (high - low);  // as `laid_blocks` makes its domain
    const double tolerance = Domain<2>{Vec2(low - margin), Vec2(high + margin)}.tolerance();
    const auto left = [&](std::size_t b) {
      double x = 1e300;
      for (const Vec2& v : shapes[b].vertices()) x = std::min(x, v.x());
      return x;
    };
    std::vector<std::size_t> order(shapes.size());
    std::vector<double> begin, end;
    for (std::size_t b = 0; b < shapes.size(); ++b) {
      begin.push_back(left(b));
      end.push_back(begin.back());
      for (const Vec2& v : shapes[b].vertices()) end.back() = std::max(end.back(), v.x());
    }
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return begin[a] < begin[b]; });
    int overlaps = 0, gaps = 0;
    const std::string accepted = "blocks that share the corners of their joints to within " +
                                 format_quantity(tolerance, dimension::length) +
                                 " (1e-10 of the model), or lie apart";
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        const std::size_t a = std::min(order[i], order[j]), b = std::max(order[i], order[j]);
        const double size = std::min(shapes[a].diameter(), shapes[b].diameter());
        const double near_by = 1e-4 * size;
        if (begin[order[j]] > end[order[i]] + near_by) break;
        const double apart =
            std::max(separation(shapes[a], shapes[b]), separation(shapes[b], shapes[a]));
        const std::string both =
            in_quotes(laid_.blocks[a].name) + " and " + in_quotes(laid_.blocks[b].name);
        if (apart < -tolerance && ++overlaps <= most_shown)
          checker_.report(
              keys_[b],
              "overlaps: blocks " + both + " by " + format_quantity(-apart, dimension::length),
              accepted);
        if (apart > tolerance && apart < near_by && ++gaps <= most_shown)
          laid_.warnings.push_back("blocks " + both + " are " +
                                   format_quantity(apart, dimension::length) +
                                   " apart: they do not touch before they have moved so far");
      }
    if (overlaps > most_shown)
      checker_.report(keys_.back(),
                      "overlaps: " + std::to_string(overlaps) + " pairs of blocks in all",
                      accepted);
    if (gaps > most_shown)
      laid_.warnings.push_back(std::to_string(gaps) + " pairs of blocks nearly touch in all");
  }
  /// Largest distance of a face of `a` from `b`; negative where none of them separates the two.
  static double separation(const ConvexPolygon& a, const ConvexPolygon& b) {
    double most = -1e300;
    for (std::size_t k = 0; k < a.size(); ++k) {
      double nearest = 1e300;
      for (const Vec2& v : b.vertices()) nearest = std::min(nearest, a.distance(k, v));
      most = std::max(most, nearest);
    }
    return most;
  }

  void read_load(Section& s) {
    BlockLoadInput load;
    const auto named = s.find("block", Need::required, "the name of a block");
    load.block = named ? block_in(*named) : -1;
    if (load.block >= 0 && laid_.blocks[static_cast<std::size_t>(load.block)].fixed)
      named->refuse("is fixed, and bears any load", "a block that can move");
    if (const auto value = s.find("force", Need::optional, force_form))
      if (const auto pair = value->as_list(2, 2, force_form)) {
        const auto x =
            load_value(pair->at(0), dimension::stiffness, "a force per metre", force_form);
        const auto y =
            load_value(pair->at(1), dimension::stiffness, "a force per metre", force_form);
        if (x && y) load.force = {*x, *y};
      }
    if (const auto value = s.find("moment", Need::optional, moment_form))
      load.moment = load_value(*value, dimension::force, "a moment per metre", moment_form)
                        .value_or(load.moment);
    if (!s.has("force") && !s.has("moment"))
      s.complain("force", "is missing, and so is moment", force_form + ", or " + moment_form);
    s.only_with(s.has("force"), "a load with a force", [&] {
      if (const auto value = s.find("at", Need::optional, point_form)) load.at = value->as_point();
    });
    s.choice<bool>("kind", load.is_proportional, {{"proportional", true}, {"dead", false}},
                   Need::optional);
    if (load.block >= 0) laid_.loads.push_back(load);
  }

  void read_displacement(Section& s) {
    BlockDisplacementInput motion;
    const auto named = s.find("block", Need::required, "the name of a block");
    motion.block = named ? block_in(*named) : -1;
    if (motion.block >= 0 && !laid_.blocks[static_cast<std::size_t>(motion.block)].fixed)
      named->refuse("is free: only a fixed block is displaced",
                    "a block with fixed = true, or a [[load]] on this one");
    if (const auto value = s.find("by", Need::optional, point_form))
      if (const auto by = value->as_point()) {
        motion.by = *by;
        if (!way_range.contains((*by)[0]) || !way_range.contains((*by)[1]))
          value->refuse("is outside the accepted range", way_range.text(&dimension::length));
      }
    s.quantity("rotation", motion.rotation, dimension::angle,
               between(-0.5 * std::numbers::pi, 0.5 * std::numbers::pi), Need::optional);
    if (!s.has("by") && !s.has("rotation"))
      s.complain("by", "is missing, and so is rotation",
                 R"(by = ["1 mm", "0 mm"], to the right and up, or rotation = "0.1 deg")");
    if (motion.block >= 0) laid_.displacements.push_back(motion);
  }

  Section& file_;
  Checker& checker_;
  LaidInput& laid_;
  const std::filesystem::path& directory_;
  std::vector<std::string> keys_;  ///< of every block, where errors about it are reported
};

std::string Reader::file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  std::replace(text.begin(), text.end(), '\0', '?');
  return text;
}

}  // namespace

bool has_laid_blocks(Section& file) {
  const Node* blocks = file.checker().document().root.find("blocks");
  return file.has("block") || (blocks != nullptr && blocks->kind == Node::Kind::table &&
                               blocks->find("file") != nullptr);
}

void read_laid_blocks(Section& file, Input& input, const std::filesystem::path& directory) {
  file.table("model", [&](Section& s) {
    s.quantity("gravity", input.model.gravity, dimension::acceleration, gravity_range,
               Need::optional);
    s.only_with(false, "a model with [tunnel]", [&] {
      for (const char* key : {"width", "below_invert", "seed", "origin"})
        (void)s.find(key, Need::optional);
    });
  });
  for (const char* key :
       {"tunnel", "stress", "boundary", "joint_set", "joints", "support", "stage", "diagram"})
    if (file.find(key, Need::optional))
      file.complain(key, "stands beside blocks that are laid",
                    "either [[block]] or [blocks] file, with [rock], [joint], [[load]], [seismic], "
                    "[[displacement]], [loading] and [run]; or [tunnel] with joints that cut rock");
  Reader(file, input.laid.emplace(), directory).read();
}

}  // namespace voussoir::program
