// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <istream>
#include <map>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/dxf_curves.hpp>
#include <voussoir/rockmass/detail/dxf_entity.hpp>
#include <voussoir/rockmass/detail/dxf_pairs.hpp>
#include <voussoir/rockmass/dxf_drawing.hpp>

namespace voussoir::detail {

#if VOUSSOIR_BODIES

/// Reads one drawing: see `read_dxf`.
class DxfReader {
 public:
  DxfReader(std::istream& in, const std::string& name, const Vec2& origin, const DxfLimits& limits,
            StopCheck& stop)
      : name_(name),
        origin_(origin),
        limits_(limits),
        stop_(stop),
        faults_(name),
        pairs_(in, name, {limits.line_length, limits.bytes}, faults_, stop),
        curves_({limits.sagitta, limits.points}, faults_) {
    file_.name = name;
  }

  [[nodiscard]] DxfFile read() {
    read_sections();
    if (!has_entities_)
      faults_.add(pairs_.number(), "the file has no section ENTITIES", "EOF",
                  std::string(dxf_wanted) + " with lines in it");
    curves_.finish();
    faults_.finish();
    flatten();
    say();
    return std::move(file_);
  }

 private:
  enum class Section { none, unnamed, header, entities, other };

  void read_sections() {
    Section section = Section::none;
    DxfGroup group;
    for (;;) {
      if (!pairs_.next(group)) {
        faults_.add(pairs_.number(),
                    pairs_.number() == 0 ? "the file is empty"
                                         : "the file ends without EOF: it was cut off",
                    group.value, dxf_wanted);
        return faults_.finish();
      }
      if (group.code == 0) {
        if (section == Section::entities) end_entity();
        const bool is_end = group.value == "EOF";
        if (section == Section::none && is_end) return;
        if (is_end || (section == Section::none && group.value != "SECTION")) {
          faults_.add(
              group.line,
              is_end ? "the file ends inside a section: it was cut off" : "no section begins here",
              group.value, dxf_wanted);
          return faults_.finish();
        }
        if (section == Section::none)
          section = Section::unnamed;
        else if (group.value == "ENDSEC")
          section = Section::none;
        else if (section == Section::entities)
          begin_entity(group);
        continue;
      }
      if (section == Section::none) {
        faults_.add(group.line, "no section begins here", group.value, dxf_wanted);
        return faults_.finish();
      }
      if (section == Section::unnamed && group.code == 2) {
        section = group.value == "HEADER"     ? Section::header
                  : group.value == "ENTITIES" ? Section::entities
                                              : Section::other;
        if (section == Section::entities) {
          has_entities_ = true;
          curves_.use(DxfUnits(set_unit(), origin_));
        }
      } else if (section == Section::header) {
        if (group.code == 9) variable_ = group.value;
        if (variable_ == "$INSUNITS" && group.code == 70) unit_ = group;
        if (variable_ == "$DWGCODEPAGE" && group.code == 3) code_page_ = group.value;
      } else if (section == Section::entities) {
        keep(group);
      }
    }
  }

  /// Metres of the drawing's unit.
  [[nodiscard]] double set_unit() {
    struct NamedUnit {
      const char *code, *name;
      double metres;
    };
    constexpr NamedUnit known[] = {{"1", "in", 0.0254}, {"2", "ft", 0.3048}, {"4", "mm", 1e-3},
                                   {"5", "cm", 1e-2},   {"6", "m", 1},       {"7", "km", 1e3},
                                   {"14", "dm", 0.1}};
    file_.unit = "m";
    if (limits_.metres > 0) {
      file_.unit = message({limits_.metres, " m"});
      for (const NamedUnit& unit : known)
        if (unit.metres == limits_.metres) file_.unit = unit.name;
      file_.metres = limits_.metres;
      return file_.metres;
    }
    is_unit_told_ = !unit_.value.empty() && unit_.value != "0";
    if (!is_unit_told_) return 1;
    for (const NamedUnit& unit : known)
      if (unit_.value == unit.code) {
        file_.unit = unit.name;
        file_.metres = unit.metres;
        return unit.metres;
      }
    faults_.add(unit_.line, "the unit of the drawing, $INSUNITS, is not known", unit_.value,
                "1 in, 2 ft, 4 mm, 5 cm, 6 m, 7 km, 14 dm, or 0 for metres");
    return 1;
  }

  void begin_entity(const DxfGroup& group) {
    stop_();
    entity_.type = group.value;
    entity_.line = group.line;
    entity_.groups.clear();
    entity_.is_good = true;
    is_read_ = DxfCurves::is_known(group.value);
    is_of_program_ = is_embedded_ = false;
  }

  void keep(const DxfGroup& group) {
    // Data of other programs: {ACAD_REACTORS ... }, extended data, objects in objects.
    if (group.code == 102) is_of_program_ = group.value.starts_with("{");
    is_embedded_ = is_embedded_ || group.code == 101 || group.code >= 1000;
    if (is_of_program_ || is_embedded_) return;
    if (is_read_ || group.code == 8 || group.code == 60 || group.code == 67)
      entity_.groups.push_back(group);
  }

  void end_entity() {
    if (entity_.type.empty()) return;
    const DxfGroup* const named = entity_.find(8);
    const bool is_part = entity_.type == "VERTEX" || entity_.type == "SEQEND";
    std::string layer = dxf_text(named == nullptr ? "0" : named->value, is_guessed_);
    int index = -1;
    if (!is_part) {
      const auto [known, is_new] =
          layers_.try_emplace(lower(layer), static_cast<int>(file_.layers.size()));
      if (is_new) file_.layers.push_back(layer);
      index = known->second;
    }
    const char* reason = nullptr;
    if (!limits_.layers.empty() && dxf_layer_index(limits_.layers, layer) < 0)
      reason = "on layers that were not asked for";
    else if (entity_.whole(67, faults_) == 1)
      reason = "in paper space";
    else if (entity_.whole(60, faults_) == 1)
      reason = "invisible";
    curves_.add(entity_, layer, index, reason);
    entity_.type.clear();
  }

  /// From the three axes of the drawing to the two of the section.
  void flatten() {
    const std::vector<DxfCurve>& curves = curves_.curves();
    int up = 1;
    if (!curves.empty()) {
      Vec3 low = curves[0].points[0], high = low;
      for (const DxfCurve& curve : curves)
        for (const Vec3& p : curve.points)
          for (int k = 0; k < 3; ++k)
            low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
      const Vec3 span = high - low;
      if (span.z() > limits_.flatness && span.y() > limits_.flatness)
        throw InvalidInput(
            message({name_, ": the drawing is no flat section: x differs by ", span.x(),
                     " m, y by ", span.y(), " m and z by ", span.z(),
                     " m; accepted: a section drawn in x and y (or in x and z, with one y): ",
                     span.x() <= limits_.flatness ? "turn the drawing out of y and z"
                                                  : "flatten it in the CAD program (FLATTEN)"}));
      if (span.z() > limits_.flatness) {
        up = 2;
        file_.notes.push_back("the section is drawn in x and z: z is taken as up");
      }
      span_ = {span.x(), span[up]};
    }
    for (const DxfCurve& curve : curves) {
      DxfPolyline line{{}, curve.is_closed, curve.layer, curve.line};
      for (const Vec3& p : curve.points) {
        const Vec2 at(p.x(), p[up]);
        if (line.points.empty() || line.points.back() != at)
          line.points.push_back(at);
        else
          ++repeated_;
      }
      if (line.is_closed && line.points.size() > 1 && line.points.back() == line.points.front()) {
        line.points.pop_back();
        ++repeated_;
      }
      if (line.points.size() < 3) line.is_closed = false;
      if (line.points.size() > 1)
        file_.lines.push_back(std::move(line));
      else
        ++of_no_length_;
    }
  }

  void say() {
    if (file_.lines.empty())
      throw InvalidInput(name_ + ": holds no line, polyline, arc or circle" +
                         (limits_.layers.empty() ? "" : " on the layers that were asked for") +
                         "; layers: " + names_of_layers() +
                         curves_.left_out().text("; not read: "));
    for (const std::string& asked : limits_.layers) (void)dxf_layer_with_lines(file_, asked);
    if (!is_unit_told_ && limits_.metres <= 0)
      file_.notes.push_back(message(
          {"the drawing does not say its unit ($INSUNITS): taken as metres, its lines span ",
           span_.x(), " m by ", span_.y(), " m"}));
    if (const std::string ignored = curves_.left_out().text("not read: "); !ignored.empty())
      file_.notes.push_back(ignored);
    if (of_no_length_ > 0)
      file_.notes.push_back(message({of_no_length_, " lines of zero length, left out"}));
    if (repeated_ > 0)
      file_.notes.push_back(message({repeated_, " points that repeat the one before"}));
    if (is_guessed_)
      file_.notes.push_back("names of layers that are no UTF-8 are taken as Latin-1" +
                            (code_page_.empty() ? "" : "; the file says " + shown(code_page_)));
  }

  /// With numbers of lines where those on all layers were read.
  [[nodiscard]] std::string names_of_layers() const {
    if (limits_.layers.empty()) return dxf_layer_list(file_);
    constexpr std::size_t most = 30;
    std::string text;
    for (std::size_t k = 0; k < std::min(most, file_.layers.size()); ++k)
      text += (k == 0 ? "" : ", ") + shown(file_.layers[k]) +
              (dxf_layer_index(limits_.layers, file_.layers[k]) < 0 ? "" : " (none)");
    if (file_.layers.size() > most) text += message({" and ", file_.layers.size() - most, " more"});
    return text;
  }

  const std::string& name_;
  Vec2 origin_;
  const DxfLimits& limits_;
  StopCheck& stop_;
  TraceFaults faults_;
  DxfPairs pairs_;
  DxfCurves curves_;
  DxfFile file_;
  std::map<std::string, int> layers_;  ///< in small letters
  DxfEntity entity_;
  bool is_read_ = false, is_of_program_ = false, is_embedded_ = false;  ///< groups of the entity
  bool has_entities_ = false, is_unit_told_ = false, is_guessed_ = false;
  DxfGroup unit_;
  std::string variable_, code_page_;
  std::size_t repeated_ = 0, of_no_length_ = 0;
  Vec2 span_ = zeros<Vec2>();  ///< [m]
};

#endif

}  // namespace voussoir::detail
