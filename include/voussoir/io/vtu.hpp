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
/// bars as lines, walls and joints as polygons, each with its values.
///
///   VtuGrid grid;
///   for (...) grid.add(part, pose);                // one cell
///   grid.add_values("displacement_m", 3, values);  // 3 numbers for every cell, in that order
///   write_atomically("rock.vtu", grid.document());
///
/// Units stand in the names as in the tables (`thrust_kN_per_m`): ParaView's calculators and
/// Python take such a name as it is, one with brackets or blanks only in quotes.
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
  /// @param corners  of a flat polygon, in their order round it, three or more [m]
  void add_polygon(std::span<const Vec3> corners) {
    VOUSSOIR_ASSERT(corners.size() >= 3, "a polygon has three corners");
    std::vector<std::size_t> loop;
    for (const Vec3& p : corners) loop.push_back(add_point(p));
    add_cell(7, loop, {});
  }
  [[nodiscard]] std::size_t cell_count() const { return types_.size(); }
  /// No two cells share one.
  [[nodiscard]] std::size_t point_count() const { return points_.size(); }

  /// @param components  numbers for each cell: 1, or 3 for a vector
  /// @throws InvalidInput  not as many as that
  void add_values(std::string name, std::size_t components, std::vector<double> values) {
    put(cell_values_, std::move(name), components, std::move(values), cell_count());
  }
  /// Of every point, cell by cell in the order in which their corners were given; ParaView draws
  /// what lies between.
  void add_point_values(std::string name, std::size_t components, std::vector<double> values) {
    put(point_values_, std::move(name), components, std::move(values), point_count());
  }

  /// @param digits  significant ones of every number that is no index; 0: as many as it takes to
  ///                read the same number back
  [[nodiscard]] std::string document(int digits = 0) const {
    std::string out =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
        std::to_string(points_.size()) + "\" NumberOfCells=\"" + std::to_string(cell_count()) +
        "\">\n<Points>\n";
    std::vector<double> coordinates;
    for (const Vec3& p : points_) coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
    add_array(out, "Float64", "Points", 3, coordinates, digits);
    out += "</Points>\n<Cells>\n";
    add_array(out, "Int64", "connectivity", 1, connectivity_);
    add_array(out, "Int64", "offsets", 1, offsets_);
    add_array(out, "UInt8", "types", 1, types_);
    if (!faces_.empty()) {
      add_array(out, "Int64", "faces", 1, faces_);
      add_array(out, "Int64", "faceoffsets", 1, face_offsets_);
    }
    out += "</Cells>\n<CellData>\n";
    add_arrays(out, cell_values_, digits);
    if (!point_values_.empty()) {
      out += "</CellData>\n<PointData>\n";
      add_arrays(out, point_values_, digits);
      return out + "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    }
    return out + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }

 private:
  struct Values {
    std::string name;
    std::size_t components;
    std::vector<double> numbers;
  };

  static void put(std::vector<Values>& arrays, std::string name, std::size_t components,
                  std::vector<double> values, std::size_t count) {
    if (values.size() != components * count)
      throw InvalidInput("vtu: \"" + name + "\" has " + std::to_string(values.size()) +
                         " values, needs " + std::to_string(components * count));
    arrays.push_back({std::move(name), components, std::move(values)});
  }
  static void add_arrays(std::string& out, const std::vector<Values>& arrays, int digits) {
    for (const Values& values : arrays)
      add_array(out, "Float64", values.name, values.components, values.numbers, digits);
  }
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
                        std::size_t components, const std::vector<Number>& numbers,
                        int digits = 0) {
    out.append("<DataArray type=\"").append(type).append("\" Name=\"").append(xml_escaped(name));
    out.append("\" NumberOfComponents=\"").append(std::to_string(components));
    out.append("\" format=\"ascii\">\n");
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if constexpr (std::is_floating_point_v<Number>)
        out += digits > 0 ? significant_text(numbers[k], digits) : shortest_text(numbers[k]);
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
  std::vector<Values> cell_values_, point_values_;
};

/// A file that belongs to others.
struct NamedDocument {
  std::string name;  ///< of the file, without folder
  std::string text;
};

/// A ParaView file (.vtm, VTK's multi-block data set) that opens others as one, each a block under
/// the name of its file.
/// @param files   beside which it is to lie
/// @param prefix  with which their names begin, and those of the blocks do not
[[nodiscard]] inline std::string vtm_document(std::span<const NamedDocument> files,
                                              const std::string& prefix = "") {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n";
  std::size_t index = 0;
  for (const NamedDocument& file : files) {
    VOUSSOIR_ASSERT(file.name.starts_with(prefix), "the files have one prefix");
    std::string block = file.name.substr(0, file.name.rfind('.'));
    block.erase(0, prefix.size());
    out += "<DataSet index=\"" + std::to_string(index++) + "\" name=\"" + xml_escaped(block) +
           "\" file=\"" + xml_escaped(file.name) + "\"/>\n";
  }
  return out + "</vtkMultiBlockDataSet>\n</VTKFile>\n";
}

/// A file that ParaView opens as one data set that changes.
struct TimedFile {
  double time;
  std::string name;  ///< relative to the collection, folders parted by "/"
};

/// A ParaView collection (.pvd): files one after the other in time.
/// @param files  by ascending time
[[nodiscard]] inline std::string pvd_document(std::span<const TimedFile> files) {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const TimedFile& file : files)
    out += "<DataSet timestep=\"" + shortest_text(file.time) + "\" group=\"\" part=\"0\" file=\"" +
           xml_escaped(file.name) + "\"/>\n";
  return out + "</Collection>\n</VTKFile>\n";
}

}  // namespace voussoir
