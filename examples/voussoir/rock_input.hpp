// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "input.hpp"
#include "input_section.hpp"

/// Readers of the tables of an input file that describe the ground and the opening in it: the keys
/// with their dimensions and ranges, one line each. Defaults are in input.hpp.
namespace voussoir::program {

void read_model(Section& s, Input& input);
/// After the model: an outline that is drawn lies on the site grid.
/// @param directory  where paths in the file are relative to
void read_tunnel(Section& s, Input& input, const std::filesystem::path& directory);
/// After the tunnel.
void read_opening(Section& s, Input& input, OpeningInput& opening,
                  const std::filesystem::path& directory);
/// What a round takes out, as an outline of its own. After its key `opening`.
void read_round_outline(Section& s, Input& input, StageInput& round,
                        const std::filesystem::path& directory);
/// After the tunnel, whose trend two horizontal stresses need.
void read_stress(Section& s, Input& input);
void read_boundary(Section& s, BoundaryInput& boundary);
/// @param is_mapped    joints.file may give the joints of a set that has no random ones
/// @param is_surveyed  joints.orientations may give the orientation of one that says nothing of it
void read_joint_set(Section& s, Input& input, JointSetInput& set, JointSetFile& set_file,
                    bool is_mapped, bool is_surveyed);
/// [joints]; the files are not opened.
void read_mapped(Section& s, Input& input, const std::filesystem::path& directory);
void read_blocks(Section& s, BlocksInput& blocks);

}  // namespace voussoir::program
