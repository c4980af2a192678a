// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/units.hpp>

#include "input_document.hpp"

/// Readers for the parts of an input file. Reading a key declares it: its name, unit, range and
/// whether it must be there stand in one call, and what no call asked for is an unknown key.
///
/// None of these throws for what a file may hold. A fault is noted in the Checker, the value keeps
/// its default, and reading goes on, so that a user sees all faults at once.
namespace voussoir::program {

/// Accepted values in SI. Written so that NaN is outside.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;

  [[nodiscard]] bool contains(double value) const {
    return (low_included ? value >= low : value > low) &&
           (high_included ? value <= high : value < high);
  }
  /// "above 0", "from 0 to below 90 deg"; empty without bounds
  /// @param dimension  of the bounds; null: bare numbers
  [[nodiscard]] std::string text(const Dimension* dimension) const;
};

/// An angle as a quantity read from a text is rounded, so that "90 deg" equals its bound [rad].
inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }
inline Range angle_below_90() { return {.low = 0, .high = radians(90), .high_included = false}; }

inline constexpr Range any_value{};
inline constexpr Range gravity_range{.low = 1, .high = 1000};  // [m/s^2]; a centrifuge has 1000
inline Range above(double low) { return {.low = low, .low_included = false}; }
inline Range at_least(double low) { return {.low = low}; }
inline Range between(double low, double high) { return {.low = low, .high = high}; }

enum class Need { required, optional };

/// What to write, as messages say it: `above 0; a length, such as "4 m"`.
[[nodiscard]] std::string quantity_form(const Dimension& dimension, const Range& range,
                                        Infinity infinity = Infinity::refused);
[[nodiscard]] std::string number_form(const Range& range);
[[nodiscard]] std::string integer_form(std::int64_t low, std::int64_t high);
[[nodiscard]] std::string words_form(const std::vector<std::string>& words);

inline constexpr const char* point_form = R"(two lengths, such as ["0 m", "-2.5 m"])";

/// What a key may hold, as its reader declares it.
struct KeyForm {
  enum class Kind {
    other,
    quantity,
    number,
    integer,
    word,
    text,
    flag,
    table,
    tables,
    one_or_more
  };
  Kind kind = Kind::other;
  std::string accepted;  ///< what to write, in words
  Dimension dimension{};
  Range range{};
  std::vector<std::string> words{};
  std::string otherwise{};  ///< what holds where it is left out, as the file would have it

  KeyForm() = default;
  KeyForm(std::string text) : accepted(std::move(text)) {}  // NOLINT(google-explicit-constructor)
  KeyForm(const char* text) : accepted(text) {}             // NOLINT(google-explicit-constructor)
  [[nodiscard]] static KeyForm quantity(const Dimension& dimension, const Range& range,
                                        Infinity infinity = Infinity::refused);
  [[nodiscard]] static KeyForm number(const Range& range);
  [[nodiscard]] static KeyForm integer(std::int64_t low, std::int64_t high);
  [[nodiscard]] static KeyForm word(std::vector<std::string> words);
  [[nodiscard]] static KeyForm of_kind(Kind kind, const std::string& accepted = "");
};

/// A key that a reader asked for, whether the file has it or not.
struct DeclaredKey {
  std::string key;  ///< dotted; entries of lists without their number: "joint_set[].dip"
  KeyForm form;
  bool is_required = false;  ///< where its table is, under its condition
  std::string condition;     ///< `shape = "circle"`; empty: always
  bool is_open = false;      ///< the document has its table, and the condition is met
};

/// The words of a choice and what they stand for.
template <class Enum>
using Words = std::initializer_list<std::pair<std::string_view, Enum>>;

/// The document being read, and what was found wrong with it.
class Checker {
 public:
  /// @param declared  takes every key that is asked for: tables that the document lacks are then
  ///                  read as well, as if they were empty; null: none of this
  explicit Checker(const Document& document, std::vector<DeclaredKey>* declared = nullptr)
      : document_(document), errors_(document.errors), declared_(declared) {}

  [[nodiscard]] const Document& document() const { return document_; }

  void report(const Place& place, std::string key, std::string message, std::string accepted);
  /// Reports at the value of a key that was read, "support.bolts.arc", or failing that at the
  /// nearest table around it.
  void report(const std::string& key, const std::string& complaint, std::string accepted);

  /// Whether a key, or one below it, was found wrong: checks between keys then have no ground.
  [[nodiscard]] bool faulty(std::string_view key) const;

  void found(const std::string& key, const Node& node) { nodes_[key] = &node; }

  /// Whether keys are taken down.
  [[nodiscard]] bool lists_keys() const { return declared_ != nullptr; }
  void list(DeclaredKey key);

  /// Remembers what keys a table may have, and which it has besides.
  void declare(const std::string& table, std::vector<std::string> known,
               std::vector<const Entry*> unknown);

  /// Reports the unknown keys, then throws if there was any error. Unknown keys come last because
  /// only now is it known which table the key would belong to.
  /// @throws InputErrors
  void finish();

 private:
  struct Table {
    std::string path;
    std::vector<std::string> known;
    std::vector<const Entry*> unknown;
  };
  const Document& document_;
  std::vector<InputError> errors_;
  std::vector<DeclaredKey>* declared_;
  std::map<std::string, const Node*> nodes_;
  std::vector<Table> tables_;
};

/// One value of the file and its key. Each `as_` reports and returns nothing if it is not that.
class Value {
 public:
  Value(Checker& checker, const Node& node, std::string key)
      : checker_(&checker), node_(&node), key_(std::move(key)) {}

  [[nodiscard]] const Node& node() const { return *node_; }
  [[nodiscard]] const std::string& key() const { return key_; }

  std::optional<double> as_quantity(const Dimension& dimension, const Range& range,
                                    Infinity infinity = Infinity::refused) const;
  std::optional<double> as_number(const Range& range) const;
  std::optional<std::int64_t> as_integer(std::int64_t low, std::int64_t high) const;
  std::optional<std::string> as_text() const;
  std::optional<bool> as_flag() const;
  /// @return  place of the word in `words`
  std::optional<std::size_t> as_word(const std::vector<std::string>& words) const;
  /// @param form  what the list looks like, for the message
  std::optional<std::vector<Value>> as_list(std::size_t least, std::size_t most,
                                            const std::string& form) const;
  /// Two lengths.
  std::optional<Point> as_point() const;

  /// Of a distribution: whether all of its values are accepted, and reports if not. True of others.
  bool stays_in(const Range& range, const std::string& accepted) const;

  /// "joint.kn = 5e9" and the complaint
  void refuse(const std::string& complaint, const std::string& accepted) const;

 private:
  Checker* checker_;
  const Node* node_;
  std::string key_;
};

/// One table of the file, or the lack of it.
///
/// A missing table is read like an empty one, except that its required keys make one error
/// together.
class Section {
 public:
  /// @param node  the table; null if the file has none
  Section(Checker& checker, const Node* node, std::string path)
      : checker_(checker), node_(node), path_(std::move(path)) {}

  [[nodiscard]] bool present() const { return node_ != nullptr; }
  [[nodiscard]] Checker& checker() { return checker_; }

  /// Declares a key.
  /// @param form  what to write, should it be missing
  /// @return  its value if it is there and belongs here
  std::optional<Value> find(std::string_view key, Need need, const KeyForm& form = {});
  /// Whether the file has the key (no declaration).
  [[nodiscard]] bool has(std::string_view key) const {
    return node_ != nullptr && node_->find(key) != nullptr;
  }

  /// Whether a table of it has a key (no declaration).
  [[nodiscard]] bool has(std::string_view table, std::string_view key) const {
    const Node* const inner = node_ != nullptr ? node_->find(table) : nullptr;
    return inner != nullptr && inner->kind == Node::Kind::table && inner->find(key) != nullptr;
  }

  /// The dotted path of a key.
  [[nodiscard]] std::string full(std::string_view key) const;

  /// See `Checker::faulty`.
  [[nodiscard]] bool faulty(std::string_view key) const { return checker_.faulty(full(key)); }

  /// Reports at a key of this table, or at the table if the key is not there.
  void complain(std::string_view key, const std::string& complaint, std::string accepted) {
    checker_.report(full(key), complaint, std::move(accepted));
  }

  void quantity(std::string_view key, double& out, const Dimension& dimension, const Range& range,
                Need need, Infinity infinity = Infinity::refused);
  void quantity(std::string_view key, std::optional<double>& out, const Dimension& dimension,
                const Range& range);
  void number(std::string_view key, double& out, const Range& range, Need need);
  void number(std::string_view key, std::optional<double>& out, const Range& range);
  void text(std::string_view key, std::string& out);
  void flag(std::string_view key, bool& out);
  template <class Integer>
  void integer(std::string_view key, Integer& out, std::int64_t low, std::int64_t high) {
    KeyForm form = KeyForm::integer(low, high);
    if constexpr (std::is_integral_v<Integer>) form.otherwise = std::to_string(out);
    if (const auto value = find(key, Need::optional, form))
      if (const auto read = value->as_integer(low, high)) out = static_cast<Integer>(*read);
  }
  /// @return  whether `out` is known: the key was left out or is one of the words
  template <class Enum>
  bool choice(std::string_view key, Enum& out, Words<Enum> words, Need need) {
    std::vector<std::string> names;
    std::string otherwise;
    for (const auto& [name, meaning] : words) {
      names.emplace_back(name);
      if (need == Need::optional && meaning == out) otherwise = name;
    }
    KeyForm form = KeyForm::word(names);
    form.otherwise = otherwise;
    const auto value = find(key, need, form);
    if (!value) return need == Need::optional;
    const auto at = value->as_word(names);
    if (at) out = (words.begin() + *at)->second;
    return at.has_value();
  }

  /// Keys declared inside belong to the table only if `active`; otherwise they are refused.
  /// @param condition  "shape = "circle"", for the message
  void only_with(bool active, const std::string& condition, const std::function<void()>& declare);
  /// Keys declared inside are left unread: whether they belong here is not known.
  void unread(const std::function<void()>& declare);

  /// A table inside this one, which may be missing.
  void table(std::string_view key, const std::function<void(Section&)>& read);
  /// A table inside this one that stands for something: `read` runs only if it is there.
  void optional_table(std::string_view key, const std::function<void(Section&)>& read);
  /// The [[tables]] of that name, in order.
  void tables(std::string_view key, const std::function<void(Section&, std::size_t)>& read);

  /// Whether the file has a list of that name (no declaration).
  [[nodiscard]] bool has_list(std::string_view key) const {
    const Node* const node = node_ != nullptr ? node_->find(key) : nullptr;
    return node != nullptr && node->kind == Node::Kind::array;
  }
  /// One table of that name, or [[tables]].
  void table_or_tables(std::string_view key,
                       const std::function<void(Section&, std::size_t)>& read);

  /// Reports what is missing and leaves the unknown keys with the checker. Once, after reading.
  void finish();

 private:
  enum class Mode { active, refused, unread };
  void in_mode(Mode mode, const std::string& condition, const std::function<void()>& declare);

  Checker& checker_;
  const Node* node_;
  std::string path_;
  std::vector<std::string> known_;
  std::vector<std::pair<std::string, std::string>> missing_;  // key, what to write
  Mode mode_ = Mode::active;
  std::string condition_;  ///< under which keys belong to the table; empty: always
};

/// Takes note of a key that is there, and has a meaning in the other dimension only.
inline void note_unused(Input& input, const Section& s, std::string_view key) {
  if (s.has(key)) input.unused.push_back(s.full(key));
}

}  // namespace voussoir::program
