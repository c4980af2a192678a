// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>
#include <voussoir/io/joint_vtu.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/io/support_vtu.hpp>
#include <voussoir/io/vtu.hpp>

namespace voussoir {

/// A tunnel in 3-D as ParaView opens it, files of one folder: `blocks.vtu`, `joints.vtu`, where
/// there are such `bolts.vtu` and `lining.vtu`, and `tunnel.vtm`, which opens them all.
///
///   for (const NamedDocument& file : paraview_files(tunnel, 1.0))
///     write_atomically(folder + "/" + file.name, file.text);
///
/// Blocks and joints are drawn where they lay in the in-situ state. ParaView's filters "Cell Data
/// to Point Data" and then "Warp By Vector" move the blocks by `displacement_m`, as much enlarged
/// as it takes to see it.
/// @param strip_width  of the lining [m]; without meaning where there is none
/// @throws InvalidInput  there is a lining and the width is not > 0
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<NamedDocument> paraview_files(const Solver& solver,
                                                            double strip_width = 0) {
  std::vector<NamedDocument> files;
  const auto add = [&](const char* name, const VtuGrid& grid) {
    if (grid.cell_count() > 0) files.push_back({std::string(name) + ".vtu", grid.document()});
  };
  const TunnelState<Spatial> state = state_of(solver);
  files.push_back({std::string("blocks") + ".vtu", vtu_of(state, solver.mass())});
  add("joints", joint_grid(joint_areas(solver)));
  add("bolts", bolt_grid(state.bolts, bars_of(solver)));
  add("lining", lining_grid(state.members, rib_forces(solver), lining_axes(solver), strip_width));
  files.push_back({std::string("tunnel") + ".vtm", vtm_document(files)});
  return files;
}

}  // namespace voussoir
