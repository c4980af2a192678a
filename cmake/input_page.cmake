# SPDX-License-Identifier: MIT
# Writes a source that holds docs/input.md, for `voussoir explain` and the schema of input files.
#   cmake -DPAGE=<docs/input.md> -DOUTPUT=<file.cpp> -P input_page.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${PAGE}" text)
string(REPLACE "\r\n" "\n" text "${text}")
file(WRITE "${OUTPUT}" "// Written by cmake/input_page.cmake.
#include \"input_page.hpp\"
namespace voussoir::program {
std::string_view input_page() {
  return R\"page(${text})page\";
}
}  // namespace voussoir::program
")
