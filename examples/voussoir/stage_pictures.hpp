// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>
#include <voussoir/io/vtu.hpp>

#include "analysis.hpp"

/// The tunnel at the end of each stage, as its report shows it.
namespace voussoir::program {

/// Pictures of the stages before the last, whose picture is that of the run:
/// "history/stage_001.svg". Of many stages some are left out, evenly.
class StagePictures {
 public:
  static constexpr std::size_t most = 12;

  explicit StagePictures(const Input& input) : input_(&input) {}
  /// A stage has ended.
  void add(const Tunnel& tunnel, const StageResult& stage);
  void add(const SpatialTunnel& tunnel, const StageResult& stage);
  /// All of them; none of a single stage, or where `picture.history` is false.
  [[nodiscard]] std::vector<NamedDocument> finish();

 private:
  template <class Solver>
  void add_picture(const Solver& tunnel, const StageResult& stage);

  const Input* input_;
  std::vector<StageResult> stages_;
  std::vector<std::pair<std::size_t, std::string>> pictures_;  ///< by the number of the stage
  std::size_t stride_ = 1;
};

}  // namespace voussoir::program
