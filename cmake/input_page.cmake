# SPDX-License-Identifier: MIT
# Writes a source that holds docs/input.md, for `voussoir explain` and the schema of input files.
#   cmake -DPAGE=<docs/input.md> -DOUTPUT=<file.cpp> -P input_page.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${PAGE}" text)
string(REPLACE "\r\n" "\n" text "${text}")
# Compilers need not take a literal of more than 64 KiB: parts that end with a line.
set(part_length 30000)
set(parts "")
string(LENGTH "${text}" length)
while(length GREATER part_length)
  string(SUBSTRING "${text}" ${part_length} -1 rest)
  string(FIND "${rest}" "\n" line_end)
  if(line_end EQUAL -1)
    break()
  endif()
  math(EXPR cut "${part_length} + ${line_end} + 1")
  string(SUBSTRING "${text}" 0 ${cut} part)
  string(SUBSTRING "${text}" ${cut} -1 text)
  string(APPEND parts "    page += R\"page(${part})page\";\n")
  string(LENGTH "${text}" length)
endwhile()
string(APPEND parts "    page += R\"page(${text})page\";\n")
file(WRITE "${OUTPUT}" "// Written by cmake/input_page.cmake.
#include \"input_page.hpp\"
#include <string>
namespace voussoir::program {
std::string_view input_page() {
  static const std::string whole = [] {
    std::string page;
${parts}    return page;
  }();
  return whole;
}
}  // namespace voussoir::program
")
