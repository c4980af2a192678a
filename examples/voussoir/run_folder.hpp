// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/operating_system.hpp>

#include "input.hpp"

/// Where results go: one run at a time in a folder, and every file says which run wrote it.
namespace voussoir::program {

/// A name for what decides the results: equal for two runs of one version that were given the same
/// numbers, however those were written down.
///
///   const std::string id = RunId("run").add(input).text();  // "3f1c09d2a47b6e58"
///
/// See `text_hash`.
class RunId {
 public:
  /// The version of the program is always a part.
  /// @param what  is computed; runs and diagrams of one input share the name "tunnel"
  explicit RunId(std::string_view what);
  RunId& add(std::string_view part);
  RunId& add(double part);
  /// Every key and value of the file and its overrides, the seed, and the mapped joints.
  RunId& add(const Input& input);
  /// The same without the mapped joints: see `joints_hash`.
  RunId& add_keys(const Input& input);
  [[nodiscard]] std::string text() const;  ///< 16 hexadecimal digits

 private:
  std::string text_;
};
/// Of the file of mapped joints; empty if there is none that can be read twice.
[[nodiscard]] std::string joints_hash(const Input& input);

/// The content of a file with the run's id in it: a key of JSON, a last column of CSV, a comment in
/// SVG, VTU, VTM, PVD, HTML, Markdown and gnuplot scripts. Other files stay as they are.
[[nodiscard]] std::string with_run_id(const std::string& file_name, std::string text,
                                      const std::string& run_id);

/// A folder for results, held by this run until it ends.
///
/// Made if missing, and removed again if it was made here and nothing was published. While it is
/// held it contains `.voussoir.lock`, a file locked by the operating system, which lets go of it
/// when its process ends in whatever way: the file of a dead process is taken over.
class RunFolder {
 public:
  /// Clears the hidden part files of dead processes.
  /// @param option  that named the folder, for messages
  /// @param mode    shared: with other processes that share it, but with none that holds it alone
  /// @throws InvalidInput        `folder` is empty
  /// @throws std::runtime_error  not a folder, no permission, or held by another process
  explicit RunFolder(const std::string& folder, const std::string& option = "--out",
                     LockedFile::Mode mode = LockedFile::Mode::exclusive);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// @param name  of the file; "history/stage_001.vtm" lies in a folder of its own, made if missing
  /// @throws std::runtime_error  see `StagedFile`; or the folder cannot be made
  void add(const std::string& name, const std::string& text, const std::string& run_id);
  /// A folder of this folder that will take files: clears the hidden part files of dead processes.
  /// @throws std::runtime_error  it is a file
  void expect_folder(const std::string& name) const;
  /// What another run has left under this name does not outlast this run: unless a file of the name
  /// is added, `publish` removes it. Files that do not say that the program wrote them stay.
  /// @param name  of an SVG, VTU, VTM or PVD file
  void replace(const std::string& name) { replaced_.insert(name); }
  /// The same of all files in a folder of this folder, and of that folder if none is left.
  void replace_all_in(const std::string& folder);
  void publish();
  /// The folder stays, whatever becomes of the run: something in it is worth keeping.
  void keep() { made_.clear(); }

 private:
  void take_lock(const std::string& option, LockedFile::Mode mode);
  void let_go() noexcept;

  std::filesystem::path path_;
  std::optional<LockedFile> lock_;
  std::vector<std::filesystem::path> made_;  ///< folders made here, the innermost last
  OutputSet outputs_;
  std::set<std::string> added_, replaced_, emptied_;  ///< names of files; of folders
};

}  // namespace voussoir::program
