// SPDX-License-Identifier: MIT
#include "report_pictures.hpp"

#include <algorithm>
#include <string>

#include "report_page.hpp"

namespace voussoir::program::html {

namespace {

/// The value of an attribute of a tag, as it is written; empty: it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  std::string before(1, ' ');
  before.append(name).append("=\"");
  const std::size_t at = tag.find(before);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + before.size(), to = tag.find('"', from);
  return to == std::string_view::npos ? std::string_view() : tag.substr(from, to - from);
}

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// A tag with names that are the page's own; what is for drawing programs becomes what the script
/// looks for.
std::string tag_in_page(std::string_view tag, std::string_view prefix) {
  std::string text(tag);
  replace_all(text, " id=\"", " id=\"" + std::string(prefix));
  replace_all(text, "url(#", "url(#" + std::string(prefix));
  replace_all(text, " inkscape:groupmode=\"layer\"", "");
  if (const std::string_view layer = attribute(tag, "inkscape:label"); !layer.empty()) {
    std::string name(layer);
    std::replace(name.begin(), name.end(), '-', ' ');
    const bool is_furniture =
        layer == "header" || layer == "legend" || layer == "key" || layer == "banner";
    replace_all(text, " inkscape:label=\"" + std::string(layer) + "\"",
                layer == "spots" ? " class=\"spots\""
                : is_furniture   ? ""
                                 : " data-layer=\"" + name + "\"");
  }
  return text;
}

}  // namespace

std::string inline_svg(std::string_view document, std::string_view prefix) {
  const std::size_t begin = document.find("<svg ");
  const std::size_t head_end = document.find('>', begin);
  if (begin == std::string_view::npos || head_end == std::string_view::npos ||
      document.find("</svg>", head_end) == std::string_view::npos)
    return "";
  const std::string_view head = document.substr(begin, head_end + 1 - begin);
  std::string out = R"(<svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox=")" +
                    std::string(attribute(head, "viewBox")) +
                    R"(" font-family="sans-serif" stroke-linejoin="round")";
  std::string_view rest = document.substr(head_end + 1);
  // The title would be shown wherever the pointer rests.
  if (const std::size_t at = rest.find_first_not_of(" \n\r");
      at != std::string_view::npos && rest.substr(at).starts_with("<title>")) {
    const std::size_t from = at + 7, to = rest.find("</title>", from);
    if (to == std::string_view::npos) return "";
    out += " aria-label=\"" + std::string(rest.substr(from, to - from)) + "\"";
    rest.remove_prefix(to + 8);
  }
  out += ">";
  while (!rest.empty()) {
    const std::size_t open = std::min(rest.find('<'), rest.size());
    out += rest.substr(0, open);
    rest.remove_prefix(open);
    if (rest.empty()) break;
    const bool is_comment = rest.starts_with("<!--");
    const std::size_t close = is_comment ? rest.find("-->") : rest.find('>');
    if (close == std::string_view::npos) return "";
    if (!is_comment) out += tag_in_page(rest.substr(0, close + 1), prefix);
    rest.remove_prefix(close + (is_comment ? 3 : 1));
  }
  return out;
}

std::string figure(std::string_view document, const std::string& id, std::string_view caption,
                   bool with_layers) {
  const std::string picture = inline_svg(document, id + "-");
  if (picture.empty()) return "";
  std::string out = "<figure id=\"" + id + "\"";
  if (with_layers) out += " data-layers=\"1\"";
  out += ">\n";
  if (with_layers) out += "<div class=\"layers\"></div>\n";
  return out + "<div class=\"sheet\">" + picture + "</div>\n<figcaption>" + escaped(caption) +
         "</figcaption>\n</figure>\n";
}

}  // namespace voussoir::program::html
