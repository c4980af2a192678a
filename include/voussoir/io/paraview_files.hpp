// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/io/joint_vtu.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/io/support_vtu.hpp>
#include <voussoir/io/tunnel_picture.hpp>
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

/// "stage_001"
[[nodiscard]] inline std::string stage_file_name(int stage) {
  const std::string number = std::to_string(stage);
  return "stage_" + std::string(3 - std::min<std::size_t>(3, number.size()), '0') + number;
}

/// How a tunnel in 3-D is at the end of a stage, for the collection `pvd_document` makes of such
/// files: blocks, the joints of which `has_slipped_or_opened` is true, bolts and lining, each where
/// there are such, with the values and in the places of `paraview_files`, and last "stage_001.vtm",
/// which opens the others. The rock is that of the stage: what later rounds take out is there.
///
///   construct(tunnel, plan, {}, [&](const auto& solver, const StageResult&) {
///     for (const NamedDocument& file : stage_files(solver, ++stage, 1.0))
///       write_atomically(folder + "/history/" + file.name, file.text);
///     timed.push_back({1.0 * stage, "history/" + stage_file_name(stage) + ".vtm"});
///   });
///   write_atomically(folder + "/history.pvd", pvd_document(timed));
///
/// Numbers have seven digits: the files of many stages are half as long.
/// @param stage        from 1
/// @param strip_width  see `paraview_files`
/// @throws InvalidInput  there is a lining and the width is not > 0
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<NamedDocument> stage_files(const Solver& solver, int stage,
                                                         double strip_width = 0) {
  constexpr int digits = 7;
  const std::string name = stage_file_name(stage), prefix = name + "_";
  std::vector<NamedDocument> files;
  const auto add = [&](const char* part, const VtuGrid& grid) {
    if (grid.cell_count() > 0)
      files.push_back({std::string(prefix).append(part).append(".vtu"), grid.document(digits)});
  };
  const TunnelState<Spatial> state = state_of(solver);
  add("blocks", block_grid(state, solver.mass()));
  std::vector<JointArea> joints = joint_areas(solver);
  std::erase_if(joints,
                [&](const JointArea& joint) { return !has_slipped_or_opened(solver, joint); });
  add("joints", joint_grid(joints));
  add("bolts", bolt_grid(state.bolts, bars_of(solver)));
  add("lining", lining_grid(state.members, rib_forces(solver), lining_axes(solver), strip_width));
  files.push_back({name + ".vtm", vtm_document(files, prefix)});
  return files;
}

}  // namespace voussoir
