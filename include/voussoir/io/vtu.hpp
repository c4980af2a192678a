// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/xml_text.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>

namespace voussoir {

/// A ParaView file (.vtu, VTK's unstructured grid in XML, text): blocks as polygons or polyhedra,
/// bars as lines, each with its values.
///
///   VtuGrid grid;
///   for (...) grid.add(part, pose);                 // one cell
///   grid.add_values("displacement [m]", 3, values);  // 3 numbers for every cell, in that order
///   write_atomically("rock.vtu", grid.document());
///
/// Source: VTK file formats, XML; cell types 3 (line), 7 (polygon), 42 (polyhedron).
class VtuGrid {
 public:
  /// @param motion  where a point of the shape as given is now
  void add(const ConvexPolygon& shape, const Pose<2>& motion = {}) {
    std::vector<std::size_t> loop;
    for (const Vec2& v : shape.vertices()) {
      const Vec2 p = motion(v);
      loop.push_back(add_point({p.x(), 0, p.y()}));
    }
    add_cell(7, loop, {});
  }
  void add(const ConvexPolyhedron& shape, const Pose<3>& motion = {}) {
    std::vector<std::size_t> points, faces{shape.size()};
    for (const Vec3& v : shape.vertices()) points.push_back(add_point(motion(v)));
    for (std::size_t k = 0; k < shape.size(); ++k) {
      faces.push_back(shape.loop(k).size());
      for (const int v : shape.loop(k)) faces.push_back(points[static_cast<std::size_t>(v)]);
    }
    add_cell(42, points, std::move(faces));
  }
  void add_line(const Vec3& from, const Vec3& to) {
    const std::size_t a = add_point(from), b = add_point(to);
    add_cell(3, {a, b}, {});
  }
  [[nodiscard]] std::size_t cell_count() const { return types_.size(); }

  /// @param components  numbers for each cell: 1, or 3 for a vector
  /// @throws InvalidInput  not as many as that
  void add_values(std::string name, std::size_t components, std::vector<double> values) {
    if (values.size() != components * cell_count())
      throw InvalidInput("vtu: \"" + name + "\" has " + std::to_string(values.size()) +
                         " values, needs " + std::to_string(components * cell_count()));
    arrays_.push_back({std::move(name), components, std::move(values)});
  }

  [[nodiscard]] std::string document() const {
    std::string out =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
        std::to_string(points_.size()) + "\" NumberOfCells=\"" + std::to_string(cell_count()) +
        "\">\n<Points>\n";
    std::vector<double> coordinates;
    for (const Vec3& p : points_) coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
    add_array(out, "Float64", "Points", 3, coordinates);
    out += "</Points>\n<Cells>\n";
    add_array(out, "Int64", "connectivity", 1, connectivity_);
    add_array(out, "Int64", "offsets", 1, offsets_);
    add_array(out, "UInt8", "types", 1, types_);
    if (!faces_.empty()) {
      add_array(out, "Int64", "faces", 1, faces_);
      add_array(out, "Int64", "faceoffsets", 1, face_offsets_);
    }
    out += "</Cells>\n<CellData>\n";
    for (const Values& values : arrays_)
      add_array(out, "Float64", values.name, values.components, values.numbers);
    return out + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }

 private:
  struct Values {
    std::string name;
    std::size_t components;
    std::vector<double> numbers;
  };

  std::size_t add_point(const Vec3& p) {
    points_.push_back(p);
    return points_.size() - 1;
  }
  void add_cell(int type, const std::vector<std::size_t>& points, std::vector<std::size_t> faces) {
    VOUSSOIR_ASSERT(!points.empty() && points.back() < points_.size(), "a cell has points");
    types_.push_back(type);
    connectivity_.insert(connectivity_.end(), points.begin(), points.end());
    offsets_.push_back(connectivity_.size());
    faces_.insert(faces_.end(), faces.begin(), faces.end());
    VOUSSOIR_ASSERT(offsets_.size() == types_.size(), "a cell has a kind and an end");
    face_offsets_.push_back(faces.empty() ? -1 : static_cast<long>(faces_.size()));
  }
  template <class Number>
  static void add_array(std::string& out, const char* type, const std::string& name,
                        std::size_t components, const std::vector<Number>& numbers) {
    out.append("<DataArray type=\"").append(type).append("\" Name=\"").append(xml_escaped(name));
    out.append("\" NumberOfComponents=\"").append(std::to_string(components));
    out.append("\" format=\"ascii\">\n");
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if constexpr (std::is_floating_point_v<Number>)
        out += shortest_text(numbers[k]);
      else
        out += std::to_string(numbers[k]);
      out += (k + 1) % 12 == 0 ? '\n' : ' ';
    }
    out += "\n</DataArray>\n";
  }

  std::vector<Vec3> points_;
  std::vector<std::size_t> connectivity_, offsets_, faces_;
  std::vector<long> face_offsets_;
  std::vector<int> types_;
  std::vector<Values> arrays_;
};

}  // namespace voussoir
