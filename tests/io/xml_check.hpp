// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/drawing/xml_text.hpp>

/// Is this well-formed XML, as far as our writers go (no CDATA, no DOCTYPE)? Tags nest, attributes
/// are quoted and named once, `&` begins an entity, ids are unique, bytes are allowed.
/// @return  empty if so, else what is wrong
inline std::string xml_fault(std::string_view text) {
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = voussoir::xml_character_length(rest);
    if (length == 0) return "forbidden byte";
    rest.remove_prefix(length);
  }
  const auto check_entities = [](std::string_view s) {
    for (std::size_t i = s.find('&'); i != std::string_view::npos; i = s.find('&', i + 1)) {
      bool is_known = false;
      for (const std::string_view entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) {
        is_known = is_known || s.substr(i).starts_with(entity);
      }
      if (!is_known) return false;
    }
    return true;
  };
  std::vector<std::string> open, ids;
  std::size_t root_count = 0;
  while (!text.empty()) {
    const std::size_t begin = text.find('<');
    const std::string_view between = text.substr(0, begin);
    if (!check_entities(between)) return "bare & in text";
    if (open.empty() && between.find_first_not_of(" \r\n\t") != std::string_view::npos) {
      return "text outside the root";
    }
    if (begin == std::string_view::npos) break;
    const std::size_t end = text.find('>', begin);
    if (end == std::string_view::npos) return "tag without end";
    std::string_view tag = text.substr(begin + 1, end - begin - 1);
    text.remove_prefix(end + 1);
    if (tag.starts_with("?")) continue;
    if (tag.starts_with("/")) {
      if (open.empty() || open.back() != tag.substr(1)) return "wrong end tag " + std::string(tag);
      open.pop_back();
      continue;
    }
    const bool is_single = tag.ends_with("/");
    if (is_single) tag.remove_suffix(1);
    const std::string name(tag.substr(0, tag.find(' ')));
    tag.remove_prefix(name.size());
    std::vector<std::string> attributes;
    while (!tag.empty()) {
      const std::size_t equals = tag.find("=\"");
      if (!tag.starts_with(" ") || equals == std::string_view::npos) return "attribute in " + name;
      const std::size_t close = tag.find('"', equals + 2);
      if (close == std::string_view::npos) return "attribute not closed in " + name;
      const std::string key(tag.substr(1, equals - 1));
      const std::string_view value = tag.substr(equals + 2, close - equals - 2);
      if (!check_entities(value) || value.find('<') != std::string_view::npos)
        return "value of " + key;
      for (const std::string& other : attributes) {
        if (other == key) return "attribute twice: " + key;
      }
      attributes.push_back(key);
      if (key == "id") {
        for (const std::string& other : ids) {
          if (other == value) return "id twice: " + other;
        }
        ids.emplace_back(value);
      }
      tag.remove_prefix(close + 1);
    }
    if (open.empty() && ++root_count > 1) return "two roots";
    if (!is_single) open.push_back(name);
  }
  if (!open.empty()) return "not closed: " + open.back();
  return root_count == 1 ? "" : "no root";
}
