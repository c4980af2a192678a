// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/io/view_from.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>

#include "input_errors.hpp"
#include "laid_blocks.hpp"
#include "uncertain_key.hpp"

/// The input file of the program: what it has besides the analysis that it describes, and how to
/// read it. The keys of the file are declared in rock_input.cpp, support_input.cpp, joint_laws.cpp
/// and input.cpp, one line each.
namespace voussoir::program {

using namespace design;

/// [joint] The mechanics of all joints whose set does not say otherwise: a contact law by its word
/// and its parameters, see joint_laws.cpp.
struct JointLawInput {
  std::string law = "coulomb";
  std::map<std::string, double, std::less<>> values;  ///< by their keys, in SI
  std::vector<std::string> given;                     ///< keys that the file has
  bool is_sound = false;  ///< all of its parameters are there, and fit together

  /// @pre the law has such a parameter
  [[nodiscard]] double at(std::string_view key) const;
};

/// Of a [[joint_set]], besides what it says of the rock.
struct JointSetFile {
  std::optional<JointLawInput> law;  ///< of its own; none: that of [joint]
  /// Says nothing of its orientation, which `joints.orientations` has.
  bool wants_survey = false;
  int surveyed = -1;  ///< set of the survey from which that was taken; -1: none
};

/// [joints] orientations: what was measured with a compass, by sets.
struct SurveyInput {
  std::filesystem::path file;           ///< resolved
  double declination = 0;               ///< added to its azimuths [rad], -pi/2 to pi/2
  bool strike_is_right_handed = false;  ///< a column of strikes that says nothing of its rule
  std::string name;                     ///< of the file, for messages
  std::vector<SurveyedPlane> planes;
  std::vector<std::string> set_names;  ///< empty: the file names none
  bool has_one_set = false;            ///< for that
  std::vector<FittedSet> fits;         ///< one for each set
  std::string layout;                  ///< how it was read, in words
  std::vector<std::string> notes;      ///< what was not taken as it stands
  std::vector<std::string> left_out;   ///< sets that no joint set takes
};

/// [joints] file, how it is to be read.
struct TraceFileInput {
  std::optional<int> first_set;  ///< number of the first set in the file, 0 or 1; none: what fits
  double unit = 0;               ///< of a drawing [m]; 0: as it says itself
};

/// [picture] Of a run.
struct PictureInput {
  ViewFrom from = ViewFrom::axis;  ///< 3-D
  bool history = true;             ///< 3-D: files of every stage are written
};

/// [diagram] The axes of the interaction diagram, each rising, with two or more entries.
struct DiagramInput {
  std::vector<std::optional<BoltSpacing>> spacing;  ///< none: no bolts, always last
  std::vector<double> thickness;                    ///< 0: no lining; otherwise 1e-3 to 10 [m]
};

/// [criteria] What a design has to comply with, each if it is given.
struct CriteriaInput {
  std::optional<double> convergence;       ///< largest of the crown, > 0 [m]
  std::optional<double> utilisation;       ///< largest of a lining, > 0 [-]
  std::optional<double> bolt_utilisation;  ///< largest force of a bolt over its strength, > 0 [-]
  /// Largest probability that rock falls, that the tunnel collapses or that one of the others is
  /// exceeded, above 0 and below 1 [-].
  std::optional<double> probability;
};

/// Where an input came from, for whoever has to find it again. Nothing of it decides the results.
struct InputSource {
  /// Another file that it names.
  struct File {
    std::string key;   ///< `joints.file`
    std::string name;  ///< as the file has it
    std::string hash;  ///< of its content, see `text_hash`; empty: a pipe or a device
  };
  std::string name;                    ///< of the file, without its folder
  std::string hash;                    ///< of its text
  std::vector<std::string> overrides;  ///< see `read_input`
  std::vector<File> files;
};

/// A whole input file, checked: every number is in its range, and they fit together.
struct Input : AnalysisInput {
  std::string title;
  InputSource source;
  std::filesystem::path joints_file;  ///< measured traces, resolved, not opened; empty: none
  TraceFileInput trace_file;
  std::optional<SurveyInput> survey;
  JointLawInput joint_law;
  std::vector<JointSetFile> set_files;    ///< of each joint set
  std::vector<std::size_t> drawn_rounds;  ///< stages whose outline is from a drawing
  bool lists_bolts = false;               ///< as [[support.bolts]]
  bool lists_linings = false;             ///< as [[support.lining]]
  PictureInput picture;
  std::optional<DiagramInput> diagram;
  CriteriaInput criteria;
  std::optional<CostsInput> costs;  ///< of supports, for `design`
  /// Keys with a distribution; the values above are those of their medians.
  std::vector<UncertainKey> uncertain;
  /// Blocks in place of a tunnel: of the others model.gravity, rock, joint and run are then given.
  std::optional<LaidInput> laid;
  /// Keys of the file that have a meaning in the other dimension alone.
  std::vector<std::string> unused;
  /// Names them, and says why; empty: there are none.
  [[nodiscard]] std::string unused_text() const;
  /// Says that keys with a distribution are at their medians; empty: there are none.
  [[nodiscard]] std::string uncertain_text() const;
  /// Every key with its value, `stress.K0 = 1`, overrides included, sorted: for the run id.
  std::vector<std::string> content;

  /// The table of a lining: "support.lining", or "support.lining[1]" of several.
  [[nodiscard]] std::string lining_key(std::size_t lining) const;
  /// The table of a pattern: "support.bolts", or "support.bolts[1]" of several.
  [[nodiscard]] std::string bolts_key(std::size_t pattern) const;
};

/// The table of an opening: "tunnel", "opening[0]", ...
[[nodiscard]] std::string opening_key(std::size_t opening);

/// Whether a line of `Input::content` names a file: what that holds decides the results, wherever
/// it lies and whatever it is called.
[[nodiscard]] bool names_a_file(std::string_view line);

/// Reads a file and checks all of it.
///
/// @param overrides  "key=value" as given behind --set: dotted keys with indices from 0
///                   (`joint_set[0].dip=75 deg`), the value as in the file, quotes optional.
///                   Later ones win. They may add keys, tables and, at the end, array entries;
///                   "!key" takes a key, a table or an array entry away.
/// @throws InputErrors  the file cannot be read or is no TOML, a key is unknown, missing, of the
///                      wrong kind or out of range, or the parts do not fit together
[[nodiscard]] Input read_input(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides = {});

/// The same from a text already read, for pipes and tests.
///
/// @param name       what to call the text in messages
/// @param directory  where paths in the text are relative to
[[nodiscard]] Input read_input_text(std::string_view text, const std::string& name,
                                    const std::filesystem::path& directory,
                                    const std::vector<std::string>& overrides = {});

}  // namespace voussoir::program
