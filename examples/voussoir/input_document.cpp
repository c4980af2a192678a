// SPDX-License-Identifier: MIT
#include "input_document.hpp"

#ifndef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1  // NOLINT(readability-identifier-naming)
#endif
// Some assertions of toml++ 3.3 are wrong: `a = [}` fails one, and the program would end there, or
// in a release build of clang rely on it. Without them such a text meets the error it should.
#define TOML_ASSERT(expr) static_assert(true)  // NOLINT(readability-identifier-naming)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/operating_system.hpp>

#include "distribution_input.hpp"

namespace voussoir::program {

namespace {

constexpr std::size_t largest_file = 16U << 20U;  // an input is a page; this is somebody's mesh
constexpr std::size_t longest_shown_line = 400;
/// The parser calls itself for every level; the deepest key of an input has four names and the
/// deepest list two brackets.
constexpr int deepest_nesting = 16;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }
bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

/// The place in bytes of a column, which counts characters from 1.
std::size_t byte_of_column(std::string_view line, int column) {
  std::size_t byte = 0;
  for (int at = 1; byte < line.size() && at < column; ++at) {
    ++byte;
    while (byte < line.size() && !starts_character(line[byte])) ++byte;
  }
  return byte;
}

std::vector<std::string> split_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.emplace_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::string nesting_limit() {
  const std::string most = "at most " + std::to_string(deepest_nesting);
  return most + " names in a dotted key, " + most + " brackets inside each other";
}

/// What must not reach toml++ 3.3, whose behaviour is undefined at letters beyond ASCII outside
/// texts (`is_non_ascii_horizontal_whitespace`). They are an error in TOML, and a usual one: quotes
/// pasted from a word processor. Texts of several lines are TOML, but no key has a use for them.
/// Keys and brackets nested without end would overflow its stack.
struct Stray {
  Place place;
  std::string message, accepted;
};

std::optional<Stray> find_stray(std::string_view text) {
  Place place{.line = 1, .column = 1};
  std::size_t at = 0;
  const auto step = [&] {  // one character on, within the text
    if (text[at] == '\n') {
      ++place.line;
      place.column = 0;
    }
    ++at;
    while (at < text.size() && !starts_character(text[at])) ++at;
    ++place.column;
  };
  char before = '\n';  // the last character that is no blank
  int names = 1;       // of the dotted key so far
  int brackets = 0;    // open
  while (at < text.size()) {
    const char c = text[at];
    if (c == '.') {
      if (++names > deepest_nesting)
        return Stray{place, "a key of more than " + std::to_string(deepest_nesting) + " names",
                     nesting_limit()};
    } else if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
      names = 1;
    }
    if (c == '[' || c == '{') {
      if (++brackets > deepest_nesting)
        return Stray{place,
                     "more than " + std::to_string(deepest_nesting) + " brackets inside each other",
                     nesting_limit()};
    } else if ((c == ']' || c == '}') && brackets > 0) {
      --brackets;
    }
    if (c == '#') {
      while (at < text.size() && text[at] != '\n') step();
    } else if (c == '"' || c == '\'') {
      if (text.substr(at).starts_with(c == '"' ? "\"\"\"" : "\'\'\'"))
        return Stray{place, "a text of several lines", "texts in one pair of quotes on one line"};
      // The parser reads on through `9"ü` as one word.
      if (std::string_view("\n=[,{").find(before) == std::string_view::npos)
        return Stray{place, "a quote where none can be", "key = \"text\""};
      step();
      while (at < text.size() && text[at] != c) {
        if (text[at] == '\n') return std::nullopt;  // unclosed: the parser goes no further
        if (text[at] == '\\' && c == '"' && at + 1 < text.size() && text[at + 1] != '\n') step();
        step();
      }
      if (at < text.size()) step();
      before = c;
    } else if (static_cast<unsigned char>(c) >= 0x80U) {
      std::size_t end = at + 1;
      while (end < text.size() && !starts_character(text[end])) ++end;
      return Stray{place, "`" + std::string(text.substr(at, end - at)) + "` outside of quotes",
                   R"(texts and quantities stand in plain quotes, such as width = "70 m")"};
    } else {
      if (c != ' ' && c != '\t') before = c;
      step();
    }
  }
  return std::nullopt;
}

/// Whether a line has a quote that it does not close; what follows # outside of quotes is a
/// comment.
bool is_cut_text(std::string_view line) {
  bool is_open = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '#' && !is_open) return false;
    if (line[k] == '"' && (k == 0 || line[k - 1] != '\\')) is_open = !is_open;
  }
  return is_open;
}

/// Whether a bare value is a number with a comma: K0 = 0,8.
bool has_decimal_comma(std::string_view line) {
  const std::size_t value = line.find_first_not_of(" \t", line.find('=') + 1);
  if (line.find('=') == std::string_view::npos || value == std::string_view::npos) return false;
  const std::size_t sign = line.find_first_not_of("0123456789", value);
  return sign != std::string_view::npos && sign > value && line[sign] == ',' &&
         sign + 1 < line.size() && line[sign + 1] >= '0' && line[sign + 1] <= '9';
}

Place place_of(const toml::source_region& region) {
  Place place;
  place.line = static_cast<int>(region.begin.line);
  place.column = static_cast<int>(region.begin.column);
  if (region.end.line == region.begin.line && region.end.column > region.begin.column)
    place.width = static_cast<int>(region.end.column - region.begin.column);
  return place;
}

/// Whether a table is a distribution in place of a value. No key of an input has one of these names
/// (`sd` alone is one of [[joint_set]]). A table with a header of its own may hold nothing else.
bool is_distribution(const Node& node, bool is_inline) {
  if (node.kind != Node::Kind::table) return false;
  const auto is_named = [](const Entry& entry) {
    const auto& names = UncertainKey::names();
    return std::find(names.begin(), names.end(), entry.key) != names.end();
  };
  const auto tells = [&](const Entry& entry) { return is_named(entry) && entry.key != "sd"; };
  return std::any_of(node.table.begin(), node.table.end(), tells) &&
         (is_inline || std::all_of(node.table.begin(), node.table.end(), is_named));
}

/// The library's node as ours. `lines` are those that its source positions count.
Node convert(const toml::node& source, const std::vector<std::string>& lines) {
  Node node;
  node.place = place_of(source.source());
  if (node.place.line >= 1 && static_cast<std::size_t>(node.place.line) <= lines.size()) {
    const std::string& line = lines[static_cast<std::size_t>(node.place.line) - 1];
    const std::size_t begin = byte_of_column(line, node.place.column);
    const std::size_t end = byte_of_column(line, node.place.column + node.place.width);
    node.written = line.substr(begin, end - begin);
    if (source.source().end.line != source.source().begin.line)
      node.written = line.substr(begin) + " ...";
  }
  if (const toml::table* table = source.as_table()) {
    node.kind = Node::Kind::table;
    node.is_inline = table->is_inline();
    for (const auto& [key, value] : *table)
      node.table.push_back({std::string(key.str()), place_of(key.source()), convert(value, lines)});
  } else if (const toml::array* array = source.as_array()) {
    node.kind = Node::Kind::array;
    for (const toml::node& value : *array) node.array.push_back(convert(value, lines));
  } else if (const auto* text = source.as_string()) {
    node.kind = Node::Kind::text;
    node.text = text->get();
  } else if (const auto* integer = source.as_integer()) {
    node.kind = Node::Kind::integer;
    node.integer = integer->get();
    node.real = static_cast<double>(node.integer);
  } else if (const auto* real = source.as_floating_point()) {
    node.kind = Node::Kind::real;
    node.real = real->get();
  } else if (const auto* flag = source.as_boolean()) {
    node.kind = Node::Kind::boolean;
    node.text = flag->get() ? "true" : "false";
  } else {
    node.kind = Node::Kind::date;
  }
  return node;
}

void set_override(Node& node, int index) {
  node.place = Place{.override_index = index};
  for (Entry& entry : node.table) {
    entry.place = node.place;
    set_override(entry.value, index);
  }
  for (Node& child : node.array) set_override(child, index);
}

/// Whether a list or table that an override holds is nested too deep.
bool nests_too_deep(const std::string& text) {
  if (!text.starts_with('[') && !text.starts_with('{')) return false;
  const std::optional<Stray> stray = find_stray("value = " + text);
  return stray && stray->accepted == nesting_limit();
}

/// The value of an override: TOML if it is that, otherwise the text itself, so that the shell's
/// quotes are enough around `5 GPa/m`.
Node override_value(const std::string& text, int index) {
  std::optional<Node> node;
  try {
    const std::string line = "value = " + text;
    const bool readable = !find_stray(line);
    const toml::table table = readable ? toml::parse(line) : toml::table{};
    // A line break could bring keys of its own.
    if (table.size() == 1 && text.find_first_of("\r\n") == std::string::npos)
      node = convert(*table.get("value"), {});
  } catch (const toml::parse_error&) {  // then it is text
  }
  if (!node) {
    node.emplace();
    node->kind = Node::Kind::text;
    node->text = text;
  }
  set_override(*node, index);
  node->written = text;
  return *std::move(node);
}

/// One step of a dotted key: a key, or the index behind it.
struct Step {
  std::string key;
  std::optional<std::size_t> index;
};

/// @return  nothing if `key` is not of the form a.b[0].c
std::optional<std::vector<Step>> split_key(std::string_view key) {
  std::vector<Step> steps;
  std::size_t at = 0;
  while (true) {
    const std::size_t begin = at;
    while (at < key.size() && (std::isalnum(static_cast<unsigned char>(key[at])) != 0 ||
                               key[at] == '_' || key[at] == '-'))
      ++at;
    if (at == begin) return std::nullopt;
    steps.push_back({std::string(key.substr(begin, at - begin)), std::nullopt});
    while (at < key.size() && key[at] == '[') {
      const std::size_t close = key.find(']', at);
      if (close == std::string_view::npos) return std::nullopt;
      const std::string_view digits = key.substr(at + 1, close - at - 1);
      if (digits.empty() || digits.size() > 6 ||
          digits.find_first_not_of("0123456789") != std::string_view::npos)
        return std::nullopt;
      steps.push_back({"", std::stoul(std::string(digits))});
      at = close + 1;
    }
    if (at == key.size()) return steps;
    if (key[at] != '.') return std::nullopt;
    ++at;
  }
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

/// Takes a key, a table or an entry of a list away.
/// @return  false if it is not there
bool remove(Node& root, const std::vector<Step>& steps) {
  Node* holder = &root;
  for (const Step& step : steps) {
    const bool is_last = &step == &steps.back();
    if (step.index) {
      if (holder->kind != Node::Kind::array || *step.index >= holder->array.size()) return false;
      if (is_last) {
        holder->array.erase(holder->array.begin() + static_cast<std::ptrdiff_t>(*step.index));
        return true;
      }
      holder = &holder->array[*step.index];
    } else {
      if (holder->kind != Node::Kind::table || holder->find(step.key) == nullptr) return false;
      if (is_last) {
        std::erase_if(holder->table, [&](const Entry& entry) { return entry.key == step.key; });
        return true;
      }
      holder = holder->find(step.key);
    }
  }
  return false;
}

/// Lays one override over the tree.
void apply_override(Document& document, int index) {
  const std::string& text = document.overrides[static_cast<std::size_t>(index)];
  const Place place{.override_index = index};
  const bool removes = text.starts_with('!');
  const std::size_t equals = removes ? std::string::npos : text.find('=');
  const std::string key = trimmed(std::string_view(text).substr(removes ? 1 : 0, equals));
  const auto refuse = [&](const std::string& message, const std::string& accepted) {
    document.errors.push_back(document.error_at(place, key, message, accepted));
  };
  const std::string form = "--set key=value, such as --set joint_set[0].dip=\"75 deg\"";
  if (equals == std::string::npos && !removes) return refuse("override without `=`", form);
  const std::optional<std::vector<Step>> steps = split_key(key);
  if (!steps) return refuse("\"" + printable(key) + "\" is not a key", form);
  if (removes) {
    if (!remove(document.root, *steps))
      refuse(key + " is to be taken away, and is not there", "--unset with a key of the file");
    return;
  }
  if (steps->size() > static_cast<std::size_t>(deepest_nesting))
    return refuse("a key of " + std::to_string(steps->size()) + " names and indices",
                  nesting_limit());
  const std::string value = trimmed(std::string_view(text).substr(equals + 1));
  if (nests_too_deep(value))
    return refuse("a value nested more than " + std::to_string(deepest_nesting) + " deep",
                  nesting_limit());

  Node* node = &document.root;
  std::string path;
  for (const Step& step : *steps) {
    const Node::Kind wanted = step.index ? Node::Kind::array : Node::Kind::table;
    if (node->kind != wanted) {
      return refuse(path + " is no " + (step.index ? "array" : "table") + " that could hold " + key,
                    "");
    }
    Node fresh;
    fresh.place = place;
    const bool last = &step == &steps->back();
    if (!last && (&step + 1)->index) fresh.kind = Node::Kind::array;
    if (step.index) {
      if (*step.index > node->array.size()) {
        return refuse(
            path + " has " + std::to_string(node->array.size()) +
                (node->array.size() == 1 ? " entry" : " entries") + ", counted from 0",
            "an index up to " + std::to_string(node->array.size()) + ", which adds an entry");
      }
      if (*step.index == node->array.size()) node->array.push_back(fresh);
      node = &node->array[*step.index];
      path += "[" + std::to_string(*step.index) + "]";
    } else {
      Node* child = node->find(step.key);
      if (child == nullptr) {
        node->table.push_back({step.key, place, fresh});
        child = &node->table.back().value;
      }
      node = child;
      path += (path.empty() ? "" : ".") + step.key;
    }
  }
  *node = override_value(value, index);
}

[[noreturn]] void refuse_file(const std::string& name, const std::string& message,
                              const std::string& accepted) {
  InputError error;
  error.file = name;
  error.message = message;
  error.accepted = accepted;
  throw InputErrors({error});
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  for (const Entry& entry : table)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

Node* Node::find(std::string_view key) {
  return const_cast<Node*>(static_cast<const Node*>(this)->find(key));
}

namespace {
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

void append_lines(const Node& node, const std::string& key, std::vector<std::string>& lines) {
  const auto line = [&](const std::string& value) { lines.push_back(key + " = " + value); };
  if (node.uncertain) {
    for (const Entry& entry : node.table) append_lines(entry.value, key + "." + entry.key, lines);
    return;
  }
  switch (node.kind) {
    case Node::Kind::table:
      if (node.table.empty()) line("{}");
      for (const Entry& entry : node.table)
        append_lines(entry.value, key.empty() ? entry.key : key + "." + entry.key, lines);
      break;
    case Node::Kind::array:
      if (node.array.empty()) line("[]");
      for (std::size_t k = 0; k < node.array.size(); ++k)
        append_lines(node.array[k], key + "[" + std::to_string(k) + "]", lines);
      break;
    case Node::Kind::text:
      line(quoted(node.text));
      break;
    case Node::Kind::integer:
      line(std::to_string(node.integer));
      break;
    case Node::Kind::real:
      line(shortest_text(node.real));
      break;
    case Node::Kind::boolean:
      line(node.text);
      break;
    case Node::Kind::date:  // no key takes one
      line(node.written);
      break;
  }
}
}  // namespace

std::vector<std::string> canonical_lines(const Document& document) {
  std::vector<std::string> lines;
  append_lines(document.root, "", lines);
  std::sort(lines.begin(), lines.end());
  return lines;
}

namespace {

/// Goes through the tree with the dotted key of every node.
template <class Visit>
void visit_nodes(Node& node, const std::string& key, const Visit& visit) {
  if (!visit(node, key)) return;
  for (Entry& entry : node.table)
    visit_nodes(entry.value, key.empty() ? entry.key : key + "." + entry.key, visit);
  for (std::size_t k = 0; k < node.array.size(); ++k)
    visit_nodes(node.array[k], key + "[" + std::to_string(k) + "]", visit);
}

/// Puts medians in the place of distributions.
/// @throws InputErrors  a table is meant for one and is none
void take_medians(Document& document) {
  const std::size_t before = document.errors.size();
  visit_nodes(document.root, "", [&](Node& node, const std::string& key) {
    if (key.empty() || !is_distribution(node, node.is_inline)) return true;
    const std::optional<UncertainKey> read = uncertain_key(
        node, key,
        [&](const Place& place, const std::string& what, const std::string& complaint,
            const std::string& accepted) {
          document.errors.push_back(document.error_at(place, what, complaint, accepted));
        });
    if (!read) return false;
    node.uncertain = std::make_shared<const UncertainKey>(*read);
    if (read->unit.empty()) {
      node.kind = Node::Kind::real;
      node.real = read->value_at(0.5);
    } else {
      node.kind = Node::Kind::text;
      node.text = read->text_at(0.5);
    }
    return false;
  });
  if (document.errors.size() > before) throw InputErrors(document.errors);
}

}  // namespace

std::vector<UncertainKey> uncertain_keys(const Document& document) {
  std::vector<UncertainKey> keys;
  Document copy = document;
  visit_nodes(copy.root, "", [&](const Node& node, const std::string&) {
    if (node.uncertain) keys.push_back(*node.uncertain);
    return !node.uncertain;
  });
  return keys;
}

InputError Document::error_at(const Place& place, std::string key, std::string message,
                              std::string accepted) const {
  InputError error;
  error.file = name;
  error.key = std::move(key);
  error.message = std::move(message);
  error.accepted = std::move(accepted);
  if (place.override_index >= 0) {
    error.override_text = overrides[static_cast<std::size_t>(place.override_index)];
  } else if (place.line > 0) {
    error.line = place.line;
    error.column = place.column;
    error.width = place.width;
    if (static_cast<std::size_t>(place.line) <= lines.size())
      error.source_line = lines[static_cast<std::size_t>(place.line) - 1];
  }
  return error;
}

std::string InputError::text() const {
  std::string result = "error: " + message + "\n";
  if (!override_text.empty()) {
    result += "  --> --set " + printable(override_text) + "\n";
  } else if (line == 0) {
    result += "  --> " + file + "\n";
  } else {
    const std::string number = std::to_string(line);
    const std::string margin(number.size(), ' ');
    result += margin + " --> " + file + ":" + number + ":" + std::to_string(column) + "\n";
    if (source_line.size() <= longest_shown_line) {
      // Tabs stay tabs under the line, so that the caret lands where the terminal puts the key.
      std::string shown = source_line, indent;
      for (char& c : shown)
        if (is_control(c) && c != '\t') c = '?';
      for (const char c : shown.substr(0, byte_of_column(shown, column)))
        if (starts_character(c)) indent += c == '\t' ? '\t' : ' ';
      result += margin + " |\n" + number + " | " + shown + "\n" + margin + " | " + indent +
                std::string(static_cast<std::size_t>(std::max(width, 1)), '^') + "\n";
    }
  }
  if (!accepted.empty()) result += "   = accepted: " + accepted + "\n";
  return result;
}

namespace {
std::string all_texts(const std::vector<InputError>& errors, std::size_t more) {
  std::string result;
  const std::size_t count = errors.size() + more,
                    shown = std::min(errors.size(), InputErrors::most_shown);
  for (std::size_t k = 0; k < shown; ++k) result += errors[k].text() + "\n";
  return result + (count == 1 ? "1 error" : std::to_string(count) + " errors") + " in the input" +
         (shown < count ? ", of which the first " + std::to_string(shown) + " are shown" : "");
}
}  // namespace

InputErrors::InputErrors(std::vector<InputError> errors, std::size_t more)
    : std::runtime_error(all_texts(errors, more)), errors_(std::move(errors)), more_(more) {}

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (result.size() >= 80 && starts_character(c)) return result + "...";
    result += is_control(c) ? '?' : c;
  }
  return result;
}

std::string closest(std::string_view word, const std::vector<std::string>& candidates) {
  const auto lower = [](std::string_view text) {
    std::string result(text);
    for (char& c : result)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
  };
  // Edit distance with neighbours exchanged counted once (optimal string alignment).
  const auto distance = [](const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
      for (std::size_t j = 0; j <= b.size(); ++j) {
        if (i == 0 || j == 0) {
          d[i][j] = i + j;
          continue;
        }
        d[i][j] = std::min(
            {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
    return d[a.size()][b.size()];
  };
  if (word.size() > 60) return "";
  // A word of several, as "direction" for "dip_direction", says more than letters do.
  std::string best;
  int holding = 0;
  for (const std::string& candidate : candidates)
    if (('_' + lower(candidate) + '_').find('_' + lower(word) + '_') != std::string::npos &&
        candidate.size() > word.size()) {
      best = candidate;
      ++holding;
    }
  if (holding == 1) return best;
  best.clear();
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t d = distance(lower(word), lower(candidate));
    if (d < least) {
      least = d;
      best = candidate;
    }
  }
  return best;
}

std::string read_text(const std::filesystem::path& file) {
  const std::string name = utf8_text(file);
  std::error_code status;
  if (name.empty()) refuse_file("\"\"", "the input file has no name", "an input file in TOML");
  if (std::filesystem::is_directory(file, status))
    refuse_file(name, name + " is a folder", "an input file in TOML");
  if (!std::filesystem::exists(file, status))
    refuse_file(name, "there is no file " + name, "an input file in TOML");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse_file(name, "cannot open " + name, "a file you may read");
  std::string text;
  std::array<char, 65536> buffer{};
  while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest_file)
      refuse_file(name, name + " is larger than 16 MB", "an input file in TOML");
  }
  if (stream.bad()) refuse_file(name, "cannot read " + name, "");
  return text;
}

Document read_document(std::string_view text, const std::string& name,
                       const std::vector<std::string>& overrides) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    refuse_file(name, name + " is UTF-16 text", "UTF-8: save it again in that encoding");
  if (text.find('\0') != std::string_view::npos)
    refuse_file(name, name + " is not a text file (it holds a zero byte)", "an input file in TOML");
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // some editors' mark of UTF-8

  Document document;
  document.name = name;
  document.lines = split_lines(text);
  document.overrides = overrides;
  if (const std::optional<Stray> stray = find_stray(text))
    throw InputErrors({document.error_at(stray->place, "", stray->message, stray->accepted)});
  try {
    const toml::table table = toml::parse(text);
    if (table.empty() && overrides.empty()) {
      refuse_file(name, name + (text.empty() ? " is empty" : " holds no keys"),
                  "an input file in TOML, such as examples/paper/tunnel.toml");
    }
    document.root = convert(table, document.lines);
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source());
    InputError refusal = document.error_at(place, "", std::string(error.description()), "");
    const std::string& line = refusal.source_line;
    if (refusal.message.find("cannot redefine") != std::string::npos) {
      refusal.message += ": it is given twice";
      refusal.accepted =
          "each key and each table once; lists of tables, in double brackets, repeat: "
          "[[joint_set]], [[round]], [[stage]], [[opening]], [[support.bolts]], [[support.lining]]";
    } else if (is_cut_text(line)) {
      refusal.message = "a text has no closing quote in its line";
      refusal.accepted = R"(a pair of quotes, such as width = "70 m")";
    } else if (has_decimal_comma(line)) {
      refusal.accepted = "a decimal point, such as K0 = 0.8";
    } else if (line.find('=') != std::string::npos && line.find('"') == std::string::npos) {
      refusal.accepted = R"(texts and quantities stand in quotes, such as width = "70 m")";
    } else {
      refusal.accepted = "TOML (https://toml.io): lines `key = value` under [tables]";
    }
    throw InputErrors({refusal});
  }
  // The library places the root at the first line; a missing table belongs to no line.
  document.root.place = Place{};
  for (std::size_t i = 0; i < overrides.size(); ++i) apply_override(document, static_cast<int>(i));
  take_medians(document);
  return document;
}

}  // namespace voussoir::program
