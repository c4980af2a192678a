// SPDX-License-Identifier: MIT
#include "stage_pictures.hpp"

#include <algorithm>
#include <cstdio>
#include <voussoir/design/openings.hpp>
#include <voussoir/io/solved_picture.hpp>

#include "rock_loads.hpp"

namespace voussoir::program {

namespace {

/// Whose convergence is measured, where there are several openings.
void set_measured(const Input& input, ConstructionResult<Planar>& built) {
  if (!input.openings.empty()) built.measured = opening_in_section(input, 0);
}
void set_measured(const Input& input, ConstructionResult<Spatial>& built) {
  if (!input.openings.empty()) built.measured = driven_tunnel(input);
}

}  // namespace

template <class Solver>
void StagePictures::add_picture(const Solver& tunnel, const StageResult& stage) {
  const bool has_one_stage = input_->stages.size() < 2 && input_->round_count() < 2;
  if (!input_->picture.history || has_one_stage) return;
  stages_.push_back(stage);
  const std::size_t number = stages_.size();
  if (number % stride_ != 0) return;
  ConstructionResult<typename Solver::Geometry> built;
  built.stages = stages_;
  set_measured(*input_, built);
  TunnelPictureText text;
  text.title = "Stage " + std::to_string(number) + ": " + stage.name;
  text.shows_whole_model = false;
  if constexpr (Solver::dim == 3) {
    text.axes = {"right", "along", "up"};
    text.from = input_->picture.from;
    text.crown_name = "crown, all that is driven";
    text.strip_width = input_->linings.empty() ? 0.0 : strip_width(*input_);
  } else {
    if (input_->linings.size() == 1) text.lining_thickness = input_->linings.front().thickness;
    text.loads = loads_in_section(*input_, number);
  }
  pictures_.emplace_back(number, draw_tunnel(tunnel, built, text));
  if (pictures_.size() <= most) return;
  stride_ *= 2;
  std::erase_if(pictures_, [&](const auto& picture) { return picture.first % stride_ != 0; });
}

void StagePictures::add(const Tunnel& tunnel, const StageResult& stage) {
  add_picture(tunnel, stage);
}
void StagePictures::add(const SpatialTunnel& tunnel, const StageResult& stage) {
  add_picture(tunnel, stage);
}

std::vector<NamedDocument> StagePictures::finish() {
  std::vector<NamedDocument> files;
  for (auto& [number, picture] : pictures_) {
    if (number == stages_.size()) continue;
    char name[64];
    std::snprintf(name, sizeof name, "history/stage_%03zu.svg", number);
    files.push_back({name, std::move(picture)});
  }
  pictures_.clear();
  return files;
}

}  // namespace voussoir::program
