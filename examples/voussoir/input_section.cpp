// SPDX-License-Identifier: MIT
#include "input_section.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <tuple>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir::program {

namespace {

std::string plain_number(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::general, 10)
                       .ptr;
  return {buffer.data(), end};
}

std::string join(const std::vector<std::string>& words, const std::string& between) {
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : between) + word;
  return result;
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// A key as TOML wants it: quoted unless it is bare.
std::string shown_key(const std::string& key) {
  const bool bare =
      !key.empty() &&
      key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
          std::string::npos;
  return bare ? key : quoted(printable(key));
}

std::string kind_name(const Node& node) {
  if (node.uncertain) return "a distribution";
  switch (node.kind) {
    case Node::Kind::table:
      return "a table";
    case Node::Kind::array:
      return "a list";
    case Node::Kind::text:
      return "a text";
    case Node::Kind::integer:
    case Node::Kind::real:
      return "a bare number";
    case Node::Kind::boolean:
      return "true or false";
    case Node::Kind::date:
      return "a date";
  }
  return "";
}

std::string value_text(const Node& node) {
  if (!node.written.empty()) return printable(node.written);
  switch (node.kind) {  // inside the value of an override
    case Node::Kind::text:
      return quoted(printable(node.text));
    case Node::Kind::integer:
      return std::to_string(node.integer);
    case Node::Kind::real:
      return plain_number(node.real);
    default:
      return kind_name(node);
  }
}

/// The file first, from its top to its end, then overrides.
std::tuple<bool, int, int> place_order(bool is_override, int line, int column) {
  return {is_override, line, column};
}
bool is_before(const Place& a, const Place& b) {
  return place_order(a.override_index >= 0, a.line, a.column) <
         place_order(b.override_index >= 0, b.line, b.column);
}

}  // namespace

std::string Range::text(const Dimension* dimension) const {
  const auto bound = [&](double value) {
    return dimension == nullptr || value == 0 ? plain_number(value)
                                              : format_quantity(value, *dimension);
  };
  std::string result;
  if (std::isfinite(low) && std::isfinite(high)) {
    if (low_included)
      result = "from " + bound(low) + (high_included ? " to " : " to below ") + bound(high);
    else
      result =
          "above " + bound(low) + (high_included ? " and at most " : " and below ") + bound(high);
  } else if (std::isfinite(low)) {
    result = low_included ? bound(low) + " or more" : "above " + bound(low);
  } else if (std::isfinite(high)) {
    result = high_included ? bound(high) + " or less" : "below " + bound(high);
  }
  return result;
}

std::string quantity_form(const Dimension& dimension, const Range& range, Infinity infinity) {
  const std::string bounds = range.text(&dimension);
  return (bounds.empty() ? "" : bounds + "; ") + accepted_examples(dimension) +
         (dimension == dimension::number ? ", or the bare number 0.4" : "") +
         (infinity == Infinity::allowed ? ", or \"inf\"" : "");
}

std::string number_form(const Range& range) {
  const std::string bounds = range.text(nullptr);
  return "a bare number" + (bounds.empty() ? "" : " " + bounds) + ", without quotes";
}

std::string words_form(const std::vector<std::string>& words) {
  std::vector<std::string> shown;
  for (const std::string& word : words) shown.push_back(quoted(word));
  return join(shown, ", ");
}

std::string integer_form(std::int64_t low, std::int64_t high) {
  std::string form = "a whole number, ";
  if (high == std::numeric_limits<std::int64_t>::max())
    return form.append(std::to_string(low)).append(" or more");
  if (low == high) return form.append(std::to_string(low));
  return form.append("from ")
      .append(std::to_string(low))
      .append(" to ")
      .append(std::to_string(high));
}

KeyForm KeyForm::of_kind(Kind kind, const std::string& accepted) {
  KeyForm form(accepted);
  form.kind = kind;
  return form;
}

KeyForm KeyForm::quantity(const Dimension& dimension, const Range& range, Infinity infinity) {
  KeyForm form = of_kind(Kind::quantity, quantity_form(dimension, range, infinity));
  form.dimension = dimension;
  form.range = range;
  return form;
}

KeyForm KeyForm::number(const Range& range) {
  KeyForm form = of_kind(Kind::number, number_form(range));
  form.range = range;
  return form;
}

KeyForm KeyForm::integer(std::int64_t low, std::int64_t high) {
  KeyForm form = of_kind(Kind::integer, integer_form(low, high));
  form.range = between(static_cast<double>(low), static_cast<double>(high));
  return form;
}

KeyForm KeyForm::word(std::vector<std::string> words) {
  KeyForm form = of_kind(Kind::word, words_form(words));
  form.words = std::move(words);
  return form;
}

void Checker::list(DeclaredKey key) {
  if (declared_ == nullptr) return;
  // Entries of a list are alike.
  for (std::size_t at = 0; (at = key.key.find('[', at)) != std::string::npos; ++at)
    key.key.erase(at + 1, key.key.find(']', at) - at - 1);
  declared_->push_back(std::move(key));
}

void Checker::report(const Place& place, std::string key, std::string message,
                     std::string accepted) {
  errors_.push_back(
      document_.error_at(place, std::move(key), std::move(message), std::move(accepted)));
}

void Checker::report(const std::string& key, const std::string& complaint, std::string accepted) {
  std::string around = key;
  while (true) {
    const auto at = nodes_.find(around);
    if (at != nodes_.end()) {
      std::string message = key + " " + complaint;
      const Node& node = *at->second;
      const bool tables = node.kind == Node::Kind::array && !node.array.empty() &&
                          node.array.front().kind == Node::Kind::table;
      if (around == key && node.kind != Node::Kind::table && !tables)
        message = key + " = " + value_text(node) + " " + complaint;
      return report(node.place, key, std::move(message), std::move(accepted));
    }
    const std::size_t dot = around.find_last_of(".[");
    if (dot == std::string::npos) break;
    around.resize(dot);
  }
  report(document_.root.place, key, key + " " + complaint, std::move(accepted));
}

bool Checker::faulty(std::string_view key) const {
  return std::any_of(errors_.begin(), errors_.end(), [&](const InputError& error) {
    return error.key.starts_with(key) &&
           (error.key.size() == key.size() || error.key[key.size()] == '.' ||
            error.key[key.size()] == '[');
  });
}

void Checker::declare(const std::string& table, std::vector<std::string> known,
                      std::vector<const Entry*> unknown) {
  tables_.push_back({table, std::move(known), std::move(unknown)});
}

void Checker::finish() {
  std::size_t more = 0;
  for (Table& table : tables_) {
    // Each is compared with every key there is, and only the first are shown.
    std::sort(table.unknown.begin(), table.unknown.end(),
              [](const Entry* a, const Entry* b) { return is_before(a->place, b->place); });
    if (table.unknown.size() > InputErrors::most_shown) {
      more += table.unknown.size() - InputErrors::most_shown;
      table.unknown.resize(InputErrors::most_shown);
    }
    for (const Entry* entry : table.unknown) {
      const std::string key = shown_key(entry->key);
      std::string message =
          "unknown key `" + key + "`" + (table.path.empty() ? "" : " in [" + table.path + "]");
      std::string guess = closest(entry->key, table.known);
      // The right key in the wrong table is the other usual slip.
      for (const Table& other : tables_) {
        if (!guess.empty()) break;
        if (std::find(other.known.begin(), other.known.end(), entry->key) != other.known.end())
          guess = (other.path.empty() ? "" : other.path + ".") + entry->key;
      }
      if (!guess.empty()) message += ", did you mean `" + guess + "`?";
      report(entry->place, (table.path.empty() ? "" : table.path + ".") + key, std::move(message),
             join(table.known, ", "));
    }
  }
  if (errors_.empty()) return;
  std::stable_sort(errors_.begin(), errors_.end(), [](const InputError& a, const InputError& b) {
    return place_order(!a.override_text.empty(), a.line, a.column) <
           place_order(!b.override_text.empty(), b.line, b.column);
  });
  throw InputErrors(errors_, more);
}

void Value::refuse(const std::string& complaint, const std::string& accepted) const {
  // A table's place is its header: that is no value to quote.
  const std::string value =
      node_->kind == Node::Kind::table ? std::string() : " = " + value_text(*node_);
  checker_->report(node_->place, key_, key_ + value + " " + complaint, accepted);
}

bool Value::stays_in(const Range& range, const std::string& accepted) const {
  if (!node_->uncertain) return true;
  const UncertainKey& key = *node_->uncertain;
  for (const double end : {key.distribution.low(), key.distribution.high()}) {
    if (range.contains(key.unit.empty() ? end : parse_quantity(key.text_of(end)).value)) continue;
    refuse("reaches " + significant_text(end, 7) + (key.unit.empty() ? "" : " " + key.unit) +
               ", which is outside the accepted range",
           accepted + "; min and max cut a distribution off");
    return false;
  }
  return true;
}

std::optional<double> Value::as_quantity(const Dimension& dimension, const Range& range,
                                         Infinity infinity) const {
  const std::string accepted = quantity_form(dimension, range, infinity);
  double value = 0;
  if (node_->kind == Node::Kind::text) {
    try {
      value = parse_quantity(node_->text, dimension, infinity);
    } catch (const UnitError& error) {
      refuse(error.complaint(), accepted);
      return std::nullopt;
    }
  } else if (node_->kind == Node::Kind::real && std::isinf(node_->real) &&
             infinity == Infinity::allowed) {
    value = node_->real;  // TOML has a word inf of its own, and no unit would change it
  } else if (node_->kind == Node::Kind::integer || node_->kind == Node::Kind::real) {
    const bool pure = dimension == dimension::number;  // a fraction needs no unit
    if (!pure || !std::isfinite(node_->real)) {
      refuse(std::isfinite(node_->real) ? "has no unit" : "is not finite", accepted);
      return std::nullopt;
    }
    value = node_->real;
  } else {
    refuse("is " + kind_name(*node_) + ", not a number with its unit", accepted);
    return std::nullopt;
  }
  if (!stays_in(range, accepted)) return std::nullopt;
  if (!range.contains(value)) {
    refuse("is outside the accepted range", accepted);
    return std::nullopt;
  }
  return value;
}

std::optional<double> Value::as_number(const Range& range) const {
  const std::string accepted = number_form(range);
  if (node_->kind != Node::Kind::integer && node_->kind != Node::Kind::real) {
    refuse("is " + kind_name(*node_) + ", not a bare number", accepted);
    return std::nullopt;
  }
  if (!std::isfinite(node_->real)) {
    refuse("is not finite", accepted);
    return std::nullopt;
  }
  if (!stays_in(range, accepted)) return std::nullopt;
  if (!range.contains(node_->real)) {
    refuse("is outside the accepted range", accepted);
    return std::nullopt;
  }
  return node_->real;
}

std::optional<std::int64_t> Value::as_integer(std::int64_t low, std::int64_t high) const {
  const std::string accepted = integer_form(low, high);
  if (node_->kind != Node::Kind::integer) {
    refuse(node_->kind == Node::Kind::real && !node_->uncertain
               ? std::string("is not a whole number")
               : "is " + kind_name(*node_) + ", not a whole number",
           accepted);
    return std::nullopt;
  }
  if (node_->integer < low || node_->integer > high) {
    refuse("is outside the accepted range", accepted);
    return std::nullopt;
  }
  return node_->integer;
}

std::optional<std::string> Value::as_text() const {
  if (node_->kind == Node::Kind::text && !node_->uncertain) return node_->text;
  refuse("is " + kind_name(*node_) + ", not a text", "a text in quotes");
  return std::nullopt;
}

std::optional<bool> Value::as_flag() const {
  if (node_->kind == Node::Kind::boolean) return node_->text == "true";
  refuse("is " + kind_name(*node_) + ", not true or false", "true or false, without quotes");
  return std::nullopt;
}

std::optional<std::size_t> Value::as_word(const std::vector<std::string>& words) const {
  const std::string accepted = words_form(words);
  if (node_->kind != Node::Kind::text || node_->uncertain) {
    refuse("is " + kind_name(*node_) + ", not one of its words", accepted);
    return std::nullopt;
  }
  const auto at = std::find(words.begin(), words.end(), node_->text);
  if (at == words.end()) {
    const std::string guess = closest(node_->text, words);
    refuse("is not one of its words" +
               (guess.empty() ? std::string() : ", did you mean " + quoted(guess) + "?"),
           accepted);
    return std::nullopt;
  }
  return static_cast<std::size_t>(at - words.begin());
}

std::optional<std::vector<Value>> Value::as_list(std::size_t least, std::size_t most,
                                                 const std::string& form) const {
  if (node_->kind != Node::Kind::array) {
    refuse("is " + kind_name(*node_) + ", not a list", form);
    return std::nullopt;
  }
  if (node_->array.size() < least || node_->array.size() > most) {
    refuse("has " + std::to_string(node_->array.size()) +
               (node_->array.size() == 1 ? " entry" : " entries"),
           form);
    return std::nullopt;
  }
  std::vector<Value> values;
  for (std::size_t i = 0; i < node_->array.size(); ++i)
    values.emplace_back(*checker_, node_->array[i], key_ + "[" + std::to_string(i) + "]");
  return values;
}

std::optional<Point> Value::as_point() const {
  const auto pair = as_list(2, 2, point_form);
  if (!pair) return std::nullopt;
  const auto x = pair->at(0).as_quantity(dimension::length, any_value);
  const auto y = pair->at(1).as_quantity(dimension::length, any_value);
  if (!x || !y) return std::nullopt;
  return Point{*x, *y};
}

std::string Section::full(std::string_view key) const {
  return (path_.empty() ? "" : path_ + ".") + std::string(key);
}

std::optional<Value> Section::find(std::string_view key, Need need, const KeyForm& form) {
  known_.emplace_back(key);
  if (checker_.lists_keys() && mode_ != Mode::unread)
    checker_.list({full(key), form, need == Need::required, condition_,
                   node_ != nullptr && mode_ == Mode::active});
  const Node* node = node_ == nullptr ? nullptr : node_->find(key);
  if (mode_ == Mode::unread) return std::nullopt;
  if (mode_ == Mode::refused) {
    if (node != nullptr) {
      checker_.report(node->place, full(key), full(key) + " belongs to " + condition_ + " only",
                      "leave it out, or set " + condition_);
    }
    return std::nullopt;
  }
  if (node == nullptr) {
    if (need == Need::required) missing_.emplace_back(key, form.accepted);
    return std::nullopt;
  }
  checker_.found(full(key), *node);
  return Value(checker_, *node, full(key));
}

void Section::quantity(std::string_view key, double& out, const Dimension& dimension,
                       const Range& range, Need need, Infinity infinity) {
  KeyForm form = KeyForm::quantity(dimension, range, infinity);
  if (need == Need::optional) form.otherwise = format_quantity(out, dimension);
  if (const auto value = find(key, need, form))
    out = value->as_quantity(dimension, range, infinity).value_or(out);
}

void Section::quantity(std::string_view key, std::optional<double>& out, const Dimension& dimension,
                       const Range& range) {
  if (const auto value = find(key, Need::optional, KeyForm::quantity(dimension, range)))
    out = value->as_quantity(dimension, range);
}

void Section::number(std::string_view key, double& out, const Range& range, Need need) {
  KeyForm form = KeyForm::number(range);
  if (need == Need::optional) form.otherwise = plain_number(out);
  if (const auto value = find(key, need, form)) out = value->as_number(range).value_or(out);
}

void Section::number(std::string_view key, std::optional<double>& out, const Range& range) {
  if (const auto value = find(key, Need::optional, KeyForm::number(range)))
    out = value->as_number(range);
}

void Section::text(std::string_view key, std::string& out) {
  if (const auto value = find(key, Need::optional, KeyForm::of_kind(KeyForm::Kind::text)))
    out = value->as_text().value_or(out);
}

void Section::flag(std::string_view key, bool& out) {
  KeyForm form = KeyForm::of_kind(KeyForm::Kind::flag);
  form.otherwise = out ? "true" : "false";
  if (const auto value = find(key, Need::optional, form)) out = value->as_flag().value_or(out);
}

void Section::in_mode(Mode mode, const std::string& condition,
                      const std::function<void()>& declare) {
  if (mode_ != Mode::active) return declare();  // inside another, which says more
  const std::string around = std::exchange(condition_, condition);
  mode_ = mode;
  declare();
  mode_ = Mode::active;
  condition_ = around;
}

void Section::only_with(bool active, const std::string& condition,
                        const std::function<void()>& declare) {
  in_mode(active ? Mode::active : Mode::refused, condition, declare);
}

void Section::unread(const std::function<void()>& declare) { in_mode(Mode::unread, "", declare); }

void Section::table(std::string_view key, const std::function<void(Section&)>& read) {
  const auto value = find(key, Need::optional, KeyForm::of_kind(KeyForm::Kind::table));
  const Node* node = nullptr;
  if (value) {
    if (value->node().kind != Node::Kind::table) {
      const bool repeated = value->node().kind == Node::Kind::array;
      checker_.report(value->node().place, full(key),
                      full(key) + (repeated ? " is a list" : " = " + value_text(value->node())) +
                          ", not one table",
                      "one table [" + full(key) + "]");
      return;
    }
    node = &value->node();
  }
  Section section(checker_, node, full(key));
  read(section);
  section.finish();
}

void Section::optional_table(std::string_view key, const std::function<void(Section&)>& read) {
  if (has(key) || checker_.lists_keys()) {
    table(key, read);
  } else {
    known_.emplace_back(key);
  }
}

void Section::tables(std::string_view key, const std::function<void(Section&, std::size_t)>& read) {
  const auto value = find(key, Need::optional, KeyForm::of_kind(KeyForm::Kind::tables));
  if (!value) {
    if (!checker_.lists_keys()) return;
    Section none(checker_, nullptr, full(key) + "[]");
    return read(none, 0);
  }
  const std::string form = "tables [[" + full(key) + "]], one for each";
  if (value->node().kind == Node::Kind::table) {
    checker_.report(value->node().place, full(key), full(key) + " is one table, not a list of them",
                    form);
    return;
  }
  const auto entries = value->as_list(0, 1000, form);
  if (!entries) return;
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const Value& entry = entries->at(i);
    if (entry.node().kind != Node::Kind::table) {
      entry.refuse("is not a table", form);
      continue;
    }
    checker_.found(entry.key(), entry.node());
    Section section(checker_, &entry.node(), entry.key());
    read(section, i);
    section.finish();
  }
}

void Section::table_or_tables(std::string_view key,
                              const std::function<void(Section&, std::size_t)>& read) {
  if (checker_.lists_keys())
    checker_.list({full(key), KeyForm::of_kind(KeyForm::Kind::one_or_more), false, "", false});
  if (has_list(key)) return tables(key, read);
  optional_table(key, [&](Section& s) { read(s, 0); });
}

void Section::finish() {
  if (node_ == nullptr) {
    if (!missing_.empty()) {
      std::vector<std::string> keys;
      for (const auto& [key, accepted] : missing_) keys.push_back(key);
      checker_.report(checker_.document().root.place, path_, "[" + path_ + "] is missing",
                      "a table [" + path_ + "] with " + join(keys, ", "));
    }
    checker_.declare(path_, known_, {});
    return;
  }
  for (const auto& [key, accepted] : missing_)
    checker_.report(node_->place, full(key), full(key) + " is missing", accepted);
  std::vector<const Entry*> unknown;
  for (const Entry& entry : node_->table)
    if (std::find(known_.begin(), known_.end(), entry.key) == known_.end())
      unknown.push_back(&entry);
  checker_.declare(path_, known_, std::move(unknown));
}

}  // namespace voussoir::program
