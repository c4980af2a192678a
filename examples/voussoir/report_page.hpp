// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The page of a report as HTML that is XML, too: nothing in it is fetched from elsewhere. What a
/// section holds is for others; here is what all of them look like.
namespace voussoir::program::html {

/// Text of a result or an input, for the inside of an element or an attribute.
[[nodiscard]] std::string escaped(std::string_view text);
/// <p>text</p>, escaped.
[[nodiscard]] std::string paragraph(std::string_view text);
/// A bulleted list of sentences, escaped; empty: nothing.
[[nodiscard]] std::string list(const std::vector<std::string>& sentences);

/// <pre>text</pre>, escaped.
[[nodiscard]] std::string preformatted(std::string_view text);

/// What stands in a column: a number to the right, text to the left, a name that is not broken.
enum class Kind { number, text, name };
struct Column {
  std::string title, unit = {};  ///< unit in its own line; empty: none
  Kind kind = Kind::number;
};

/// How a row, a card or the verdict is meant, in colour beside its word.
enum class Tone { plain, good, doubtful, bad };

/// A table; cells are plain text and escaped here.
class Table {
 public:
  Table(std::string caption, std::vector<Column> columns);
  void add(const std::vector<std::string>& cells, Tone tone = Tone::plain);
  /// A line above the rows that follow.
  void add_heading(std::string_view title);
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] std::string text() const;  ///< empty without rows

 private:
  std::string caption_, rows_;
  std::vector<Column> columns_;
};

/// One of the numbers at the head.
struct Card {
  std::string name, value, unit, remark;
  Tone tone = Tone::plain;
};

struct Section {
  std::string id, title;
  std::string body;  ///< HTML
};

struct Page {
  std::string title, subtitle;  ///< plain
  Tone tone = Tone::plain;
  std::string word, sentence;  ///< the verdict, plain
  std::vector<Card> cards;
  std::vector<Section> sections;
  std::string foot;  ///< plain

  /// The whole document. Sections without a body are left out.
  [[nodiscard]] std::string text() const;
};

/// See report_style.cpp.
extern const std::string_view style, script;

}  // namespace voussoir::program::html
