// SPDX-License-Identifier: MIT
#include "input_page.hpp"

#include <algorithm>
#include <voussoir/core/errors.hpp>

#include "input_document.hpp"
#include "key_catalogue.hpp"

namespace voussoir::program {

namespace {

std::string trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return std::string(text);
}

/// What stands between backquotes.
std::vector<std::string> code_spans(std::string_view text) {
  std::vector<std::string> spans;
  for (std::size_t from = text.find('`'); from != std::string_view::npos;) {
    const std::size_t to = text.find('`', from + 1);
    if (to == std::string_view::npos) break;
    spans.emplace_back(text.substr(from + 1, to - from - 1));
    from = text.find('`', to + 1);
  }
  return spans;
}

/// Bars part cells, but for those in code.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells{""};
  bool is_code = false;
  for (const char c : line.substr(1)) {
    if (c == '`') is_code = !is_code;
    if (c == '|' && !is_code)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  cells.pop_back();  // behind the last bar
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// "[support.bolts]" and "[[joint_set]]" of a heading.
std::vector<std::string> tables_of(std::string_view heading) {
  std::vector<std::string> tables;
  for (std::string span : code_spans(heading)) {
    if (span.starts_with("law = ")) return {"joint", "joint_set"};
    std::erase(span, '[');
    std::erase(span, ']');
    tables.push_back(span);
  }
  return tables;
}

std::string without_lists(std::string_view key) {
  std::string text(key);
  for (std::size_t at; (at = text.find("[]")) != std::string::npos;) text.erase(at, 2);
  return text;
}

}  // namespace

std::string PageRow::cell(std::string_view column) const {
  for (std::size_t k = 0; k < std::min(columns.size(), cells.size()); ++k)
    if (columns[k] == column) return cells[k];
  return "";
}

bool PageRow::is_of(std::string_view key) const {
  const std::string wanted = without_lists(key);
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::any_of(tables.begin(), tables.end(),
                       [&](const std::string& table) { return wanted == table + "." + name; }) ||
           (wanted == name && (name.find('.') != std::string::npos || tables.empty()));
  });
}

const std::vector<PageRow>& page_rows() {
  static const std::vector<PageRow> rows = [] {
    std::vector<PageRow> found;
    std::string heading;
    std::vector<std::string> tables, columns;
    bool is_table = false;
    for (std::string_view rest = input_page(); !rest.empty();) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (line.starts_with("#")) {
        heading = trimmed(line.substr(line.find_first_not_of('#')));
        tables = tables_of(heading);
      }
      if (!line.starts_with("|")) {
        is_table = false;
      } else if (!is_table) {
        columns = cells_of(line);
        is_table = true;
      } else if (!line.starts_with("| ---")) {
        PageRow row{heading, {}, tables, columns, cells_of(line)};
        row.names = code_spans(row.cells.front());
        found.push_back(std::move(row));
      }
    }
    return found;
  }();
  return rows;
}

std::optional<PageRow> page_row_of(std::string_view key) {
  for (const PageRow& row : page_rows())
    if (row.is_of(key)) return row;
  return std::nullopt;
}

std::string plain_cell(std::string_view cell) {
  std::string text;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    if (cell[k] == '`') continue;
    const std::size_t close = cell[k] == '[' ? cell.find("](", k) : std::string_view::npos,
                      end = close != std::string_view::npos ? cell.find(')', close)
                                                            : std::string_view::npos;
    const bool is_link = end != std::string_view::npos &&
                         cell.substr(k, close - k).find('`') == std::string_view::npos;
    if (is_link) {
      text += cell.substr(k + 1, close - k - 1);
      k = end;
    } else {
      text += cell[k];
    }
  }
  return text;
}

std::string explanation(std::string_view name) {
  std::string text;
  for (const PageRow& row : page_rows()) {
    const bool is_named =
        row.is_of(name) || std::find(row.names.begin(), row.names.end(), name) != row.names.end();
    if (!is_named) continue;
    text.append(text.empty() ? "" : "\n").append(plain_cell(row.heading)).append("\n");
    for (std::size_t k = 0; k < std::min(row.cells.size(), row.columns.size()); ++k)
      if (!row.cells[k].empty()) {
        std::string head = "  " + row.columns[k];
        head.resize(std::max<std::size_t>(head.size() + 2, 12), ' ');
        text.append(head).append(plain_cell(row.cells[k])).append("\n");
      }
  }
  for (const DeclaredKey& key : key_catalogue()) {
    if (without_lists(key.key) != without_lists(name)) continue;
    if (!key.form.accepted.empty())
      text.append("  accepted  ").append(key.form.accepted).append("\n");
    if (!key.condition.empty()) text.append("  with      ").append(key.condition).append("\n");
  }
  if (!text.empty()) return text;
  std::vector<std::string> names;
  for (const PageRow& row : page_rows())
    names.insert(names.end(), row.names.begin(), row.names.end());
  const std::string guess = closest(name, names);
  std::string message = "nothing is called `";
  message.append(printable(name)).append("`");
  if (!guess.empty()) message.append(", did you mean `").append(guess).append("`?");
  throw InvalidInput(
      message +
      "\n   = accepted: a key (stress.K0, dip), a verdict (collapse), an exit status "
      "(6), a file of results (run.json)");
}

}  // namespace voussoir::program
