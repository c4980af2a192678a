// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis.hpp"
#include "input.hpp"

/// Long work as a list of cases: each is one tunnel, depends on no other, and is named by what is
/// computed in it.
namespace voussoir::program {

/// A key of the input and the values that it takes in turn.
struct VariedKey {
  std::string key;                  ///< "support.bolts.spacing"
  std::vector<std::string> values;  ///< as behind --set
};

/// From `key=10 cm, 20 cm` (a list) or `key=10..30 cm:5` (five values at equal steps, ends among
/// them).
/// @throws InvalidInput  neither of these, or a value twice
[[nodiscard]] VariedKey varied_key(const std::string& text);

/// How the values of keys with a distribution are drawn, see `GrowingLatinHypercube`.
enum class Sampling { latin, random };
[[nodiscard]] const char* word_of(Sampling sampling);

enum class PlanVerb { diagram, realisations, sweep };
[[nodiscard]] const char* to_string(PlanVerb verb);

/// What a plan is made of.
struct PlanParts {
  PlanVerb verb = PlanVerb::sweep;
  std::string file;                    ///< name of the input file, for messages
  std::string text;                    ///< content of the input file
  std::filesystem::path directory;     ///< where paths in it are relative to
  std::vector<std::string> overrides;  ///< as behind --set
  std::vector<VariedKey> varied = {};  ///< of a sweep alone
  int realisations = 1;                ///< the seeds count on from model.seed
  Sampling sampling = Sampling::latin;
  /// Of a plan that has travelled: where its copies of mapped joints lie, by the line of content
  /// that names the file, `joints.file = "north.csv"`.
  std::map<std::string, std::filesystem::path> copies = {};
};

/// A file of mapped joints that cases of a plan read.
struct PlannedFile {
  std::string line;            ///< of content that names it
  std::string name;            ///< as it is written there: what messages of a case call it
  std::filesystem::path path;  ///< where it lies
  std::string hash;            ///< of what it holds
};

/// One tunnel of a plan.
struct Case {
  std::size_t index = 0;               ///< in the plan
  std::vector<std::string> overrides;  ///< on top of those of the plan
  std::vector<double> drawn;           ///< of `CasePlan::uncertain()`, in the units of the keys
  std::uint64_t seed = 1;
  /// Of a diagram: its place on the axes, spacing and thickness.
  std::optional<std::array<std::size_t, 2>> place;
};

/// All tunnels of a sweep, of realisations or of a diagram.
///
/// A realisation is a seed of the rock, and with it a point of the Latin hypercube over the keys
/// with a distribution. Neither depends on how many realisations there are.
///
/// Cases are counted with the keys in the order they were given, the first running slowest, then
/// the seed; in a diagram spacing, thickness, seed.
class CasePlan {
 public:
  static constexpr std::size_t most_cases = 1000000;
  static constexpr int most_realisations = 10000;

  /// Checks the input of every case.
  /// @throws InputErrors   the file or an override is wrong
  /// @throws InvalidInput  the input of one case is wrong, names a file that cannot be read, or
  ///                       there are too many; a key is both set and varied; a diagram without
  ///                       [diagram]
  explicit CasePlan(PlanParts parts);

  [[nodiscard]] const PlanParts& parts() const { return parts_; }
  [[nodiscard]] const Input& input() const { return input_; }  ///< without what varies
  /// Keys whose values are drawn for every realisation: those with a distribution, but for those
  /// that are varied. One realisation of a sweep or a diagram has the medians: none.
  [[nodiscard]] const std::vector<UncertainKey>& uncertain() const { return uncertain_; }
  [[nodiscard]] std::size_t size() const { return names_.size(); }
  [[nodiscard]] Case at(std::size_t index) const;
  /// Hash of version, program, input, the mapped joints of this case, seed and supports: 16 digits.
  [[nodiscard]] const std::string& name(std::size_t index) const { return names_[index]; }
  [[nodiscard]] Input input_of(const Case& the_case) const;
  [[nodiscard]] SupportChoice supports_of(const Case& the_case, const Input& input) const;
  /// "support.bolts.spacing=15 deg, seed 3"
  [[nodiscard]] std::string label(const Case& the_case) const;

  /// All cases in the order of work: those in the same rock together, for it is made once, and of
  /// these the least supported first, which take longest.
  [[nodiscard]] std::vector<std::size_t> work_order() const;

  /// Everything that decides the results, a line each: "stress.K0 = 1", "version = 0.1.0".
  [[nodiscard]] const std::vector<std::string>& content() const { return content_; }
  /// Hash of the content, but for the program: of input, version and seeds.
  [[nodiscard]] const std::string& run_id() const { return run_id_; }
  /// Hash of the content, but for the number of realisations: of which cases a journal may hold.
  [[nodiscard]] const std::string& work_id() const { return work_id_; }

  /// As a file that another machine goes on from: input, overrides and content in it.
  [[nodiscard]] std::string json() const;
  /// @param path  of the file, for messages; copies of mapped joints lie beside it
  /// @throws std::runtime_error  no plan, of another form, or made by another version or program
  [[nodiscard]] static CasePlan from_json(const std::string& text,
                                          const std::filesystem::path& path);
  /// Those that its cases read, in the order of the cases.
  [[nodiscard]] const std::vector<PlannedFile>& files() const { return files_; }
  /// "sweep.joints.csv", "sweep.joints-2.csv": where a plan keeps its copies of `files()`.
  [[nodiscard]] static std::string copy_name(PlanVerb verb, std::size_t file);

 private:
  [[nodiscard]] std::size_t combinations() const;  ///< of keys, or of places in a diagram
  [[nodiscard]] Input read(const std::vector<std::string>& overrides) const;
  /// Hash of the mapped joints of a case, which are then among `files_`; empty: it has none.
  [[nodiscard]] std::string joints_of(const Input& input);

  PlanParts parts_;
  Input input_;
  std::vector<UncertainKey> uncertain_;
  std::vector<PlannedFile> files_;
  std::vector<std::string> names_, content_;
  std::string run_id_, work_id_;
};

/// Of the content of a plan: how many realisations it has, which may grow in the same folder.
inline constexpr std::string_view realisations_line = "realisations = ";

/// A line of the content by which results are judged, and which changes none of them: criteria,
/// costs.
[[nodiscard]] bool is_of_choice(std::string_view line);

/// Whether the rock, its stress and its boundary do not depend on a key.
/// @param key  or a line of an input's content that begins with one
[[nodiscard]] bool is_of_support(std::string_view key);

/// Lines that one of two sorted lists has and the other has not, as "stress.K0 = 2, was 1".
[[nodiscard]] std::vector<std::string> differences(const std::vector<std::string>& now,
                                                   const std::vector<std::string>& before);

/// Of the sources that this program was built from, 16 digits: two programs of one version that
/// compute other numbers are told apart.
extern const char* const sources_hash;

}  // namespace voussoir::program
