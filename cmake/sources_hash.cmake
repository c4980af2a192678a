# SPDX-License-Identifier: MIT
# Writes a source with a hash of everything that the program computes with; leaves it alone if it is
# up to date. Line ends do not count: the same from a checkout with either.
#   cmake -DROOT=<project> -DOUTPUT=<file.cpp> -P sources_hash.cmake
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/include/voussoir/*.hpp"
     "${ROOT}/examples/voussoir/*.hpp" "${ROOT}/examples/voussoir/*.cpp" "${ROOT}/examples/paper/*.hpp" "${ROOT}/examples/paper/*.cpp")
list(SORT files)
set(all "")
foreach(name IN LISTS files)
  file(READ "${ROOT}/${name}" text)
  string(REPLACE "\r\n" "\n" text "${text}")
  string(SHA256 hash "${text}")
  string(APPEND all "${name} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING "${hash}" 0 16 hash)
set(text "// Written by cmake/sources_hash.cmake.
namespace voussoir::program {
extern const char* const sources_hash;
const char* const sources_hash = \"${hash}\";
}  // namespace voussoir::program
")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" before)
endif()
if(NOT before STREQUAL text)
  file(WRITE "${OUTPUT}" "${text}")
endif()
