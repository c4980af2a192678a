// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/vtu.hpp>

#include "analysis.hpp"

/// What the program writes: tables, JSON and pictures, units in every name.
namespace voussoir::program {

/// Everything about a run that is a number or a sentence (schema 1).
[[nodiscard]] std::string run_json(const Input& input, const RunResult& run);
/// One row per bolt and joint crossed.
[[nodiscard]] std::string bolts_csv(const Input& input, const RunResult& run);
/// One row per lining node.
[[nodiscard]] std::string lining_csv(const Input& input, const RunResult& run);
/// The rock around the tunnel with its supports.
[[nodiscard]] std::string blocks_svg(const Input& input, const RunResult& run);

/// The results in a few lines for a terminal.
[[nodiscard]] std::string run_summary(const Input& input, const RunResult& run);

/// Outputs in 3-D: volumes in place of areas, and forces of a lining over the width of its strips.
[[nodiscard]] std::string run_json(const Input& input, const SpatialRunResult& run);
[[nodiscard]] std::string bolts_csv(const Input& input, const SpatialRunResult& run);
/// One row per member.
[[nodiscard]] std::string lining_csv(const Input& input, const SpatialRunResult& run);
/// The tunnel cut open along its axis.
[[nodiscard]] std::string blocks_svg(const Input& input, const SpatialRunResult& run);
/// All files for ParaView with their names, `blocks.vtu` among them; `tunnel.vtm` opens them.
[[nodiscard]] std::vector<NamedDocument> paraview_files(const Input& input,
                                                        const SpatialRunResult& run);
/// How the tunnel was at the end of each stage, for ParaView: files of its stages and one that
/// opens them in time. Of one stage nothing is written: `blocks.vtu` and the files beside it are
/// its end.
class HistoryFiles {
 public:
  static constexpr const char* folder = "history";
  static constexpr const char* collection = "history.pvd";

  /// @param write  takes a file as soon as there is a second stage: no more than the files of one
  ///               stage are kept
  HistoryFiles(const Input& input, std::function<void(const NamedDocument&)> write);
  /// A stage has ended.
  void add(const SpatialTunnel& tunnel);
  /// Writes the collection.
  /// @return  false: there is nothing to be written
  bool finish();

 private:
  const Input* input_;
  std::function<void(const NamedDocument&)> write_;
  std::vector<TimedFile> stages_;
  std::vector<NamedDocument> first_;
};
[[nodiscard]] std::string run_summary(const Input& input, const SpatialRunResult& run);

}  // namespace voussoir::program
