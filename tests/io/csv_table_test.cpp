// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>
#include <voussoir/io/csv_table.hpp>

namespace csv_table_test {

using namespace voussoir;

namespace {

/// A second opinion: RFC 4180 read by its grammar, cell by cell.
std::vector<std::vector<std::string>> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& cell = rows.back().back();
    if (is_quoted) {
      if (text[i] != '"') {
        cell += text[i];
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else {
        is_quoted = false;
      }
    } else if (text[i] == '"') {
      is_quoted = true;
    } else if (text[i] == ',') {
      rows.back().emplace_back();
    } else if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') {
      ++i;
      rows.emplace_back(1);
    } else {
      cell += text[i];
    }
  }
  rows.pop_back();  // after the last line
  return rows;
}

}  // namespace

TEST_SUITE("io/csv_table") {
  TEST_CASE("what is written is read back cell by cell") {
    const std::vector<std::string> difficult = {"plain",
                                                "a,b",
                                                "say \"no\"",
                                                "two\r\nlines",
                                                "",
                                                " padded ",
                                                "\"",
                                                "Stra\xC3\x9F"
                                                "e, 2"};
    CsvTable table({"text", "axial_force_kN"});
    for (const std::string& cell : difficult) table.add_row(cell, 0.1);
    const auto rows = read_csv(table.text());
    REQUIRE(rows.size() == difficult.size() + 1);
    CHECK(rows[0] == std::vector<std::string>{"text", "axial_force_kN"});
    for (std::size_t i = 0; i < difficult.size(); ++i) {
      CHECK(rows[i + 1] == std::vector<std::string>{difficult[i], "0.1"});
    }
    CHECK(table.row_count() == difficult.size());
  }

  TEST_CASE("cells are quoted only where they must be") {
    CHECK(CsvTable::quoted("a;b") == "a;b");
    CHECK(CsvTable::quoted("a,b") == "\"a,b\"");
    CHECK(CsvTable::quoted("5\" bolt") == "\"5\"\" bolt\"");
  }

  TEST_CASE("numbers are shortest, or of the digits asked for") {
    CsvTable exact({"a", "b", "c", "d"});
    exact.add_row(1.0 / 3, 12, true, std::nan(""));
    CHECK(exact.text() == "a,b,c,d\r\n0.3333333333333333,12,1,nan\r\n");
    CsvTable rounded({"a", "b"}, 4);
    rounded.add_row(1.0 / 3, 123456789);  // whole numbers are kept
    CHECK(rounded.text() == "a,b\r\n0.3333,123456789\r\n");
  }

  TEST_CASE("a column of empty texts keeps its rows") {
    CsvTable table({"note"});
    table.add_row("");
    CHECK(read_csv(table.text()).size() == 2);
    CHECK(table.text() == "note\r\n\"\"\r\n");
  }

  TEST_CASE("a row of the wrong length is refused with its number") {
    CsvTable table({"a", "b"});
    table.add_row(1, 2);
    CHECK_THROWS_WITH_AS(table.add_row(1), "CsvTable: row 2 has 1 values for 2 columns",
                         InvalidInput);
    CHECK_THROWS_AS(CsvTable({}), InvalidInput);
    CHECK_THROWS_AS(CsvTable({"a", ""}), InvalidInput);
  }
}

}  // namespace csv_table_test
