// SPDX-License-Identifier: MIT
#include "report_page.hpp"

#include <voussoir/drawing/xml_text.hpp>

namespace voussoir::program::html {

namespace {

const char* class_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::doubtful:
      return "doubtful";
    case Tone::bad:
      return "bad";
    case Tone::plain:
      break;
  }
  return "plain";
}

const char* class_of(Kind kind) {
  switch (kind) {
    case Kind::text:
      return " class=\"text\"";
    case Kind::name:
      return " class=\"text name\"";
    case Kind::number:
      break;
  }
  return "";
}

}  // namespace

std::string escaped(std::string_view text) { return xml_escaped(text); }

std::string paragraph(std::string_view text) {
  return text.empty() ? "" : "<p>" + escaped(text) + "</p>\n";
}

std::string list(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return "";
  std::string out = "<ul>\n";
  for (const std::string& sentence : sentences) out += "<li>" + escaped(sentence) + "</li>\n";
  return out + "</ul>\n";
}

std::string preformatted(std::string_view text) { return "<pre>" + escaped(text) + "</pre>\n"; }

Table::Table(std::string caption, std::vector<Column> columns)
    : caption_(std::move(caption)), columns_(std::move(columns)) {}

void Table::add(const std::vector<std::string>& cells, Tone tone) {
  rows_ += "<tr";
  if (tone != Tone::plain) rows_ += std::string(" class=\"") + class_of(tone) + "\"";
  rows_ += ">";
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    rows_ += std::string("<td") + class_of(columns_[k].kind) + ">";
    if (k < cells.size()) rows_ += escaped(cells[k]);
    rows_ += "</td>";
  }
  rows_ += "</tr>\n";
}

void Table::add_heading(std::string_view title) {
  rows_ += "<tr class=\"group\"><th colspan=\"" + std::to_string(columns_.size()) +
           "\" scope=\"rowgroup\">" + escaped(title) + "</th></tr>\n";
}

std::string Table::text() const {
  if (rows_.empty()) return "";
  std::string out = "<div class=\"wide\"><table>\n";
  if (!caption_.empty()) out += "<caption>" + escaped(caption_) + "</caption>\n";
  out += "<thead><tr>";
  for (const Column& column : columns_) {
    out += std::string("<th scope=\"col\"") + class_of(column.kind) + ">";
    out += escaped(column.title);
    if (!column.unit.empty()) out += " <span class=\"unit\">" + escaped(column.unit) + "</span>";
    out += "</th>";
  }
  return out + "</tr></thead>\n<tbody>\n" + rows_ + "</tbody></table></div>\n";
}

std::string Page::text() const {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light dark\"/>\n";
  out += "<title>" + escaped(title) + "</title>\n";
  out += "<style>\n" + std::string(style) + "</style>\n</head>\n<body>\n";
  out += "<header>\n<h1>" + escaped(title) + "</h1>\n<p class=\"subtitle\">" + escaped(subtitle) +
         "</p>\n</header>\n<main>\n";
  out += std::string("<section id=\"verdict\" class=\"verdict ") + class_of(tone) +
         "\">\n<h2 class=\"word\">" + escaped(word) + "</h2>\n<p class=\"sentence\">" +
         escaped(sentence) + "</p>\n";
  if (!cards.empty()) {
    out += "<div class=\"cards\">\n";
    for (const Card& card : cards) {
      out += std::string("<div class=\"card ") + class_of(card.tone) + "\"><span class=\"name\">" +
             escaped(card.name) + "</span><span class=\"value\">" + escaped(card.value);
      if (!card.unit.empty()) out += " <span class=\"unit\">" + escaped(card.unit) + "</span>";
      out += "</span><span class=\"remark\">" + escaped(card.remark) + "</span></div>\n";
    }
    out += "</div>\n";
  }
  out += "</section>\n<nav aria-label=\"Sections\"><ol>\n";
  for (const Section& section : sections)
    if (!section.body.empty())
      out += "<li><a href=\"#" + section.id + "\">" + escaped(section.title) + "</a></li>\n";
  out += "</ol></nav>\n";
  for (const Section& section : sections)
    if (!section.body.empty())
      out += "<section id=\"" + section.id + "\">\n<h2>" + escaped(section.title) + "</h2>\n" +
             section.body + "</section>\n";
  out += "</main>\n<footer>" + escaped(foot) + "</footer>\n<script>\n" + std::string(script) +
         "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace voussoir::program::html
