# SPDX-License-Identifier: MIT
# A program shown on a page is the program that runs: behind `<!-- program: examples/x.cpp -->` the
# page has that file, without its licence line.
#   cmake -DROOT=<project> -P pages.cmake
cmake_minimum_required(VERSION 3.25)
file(GLOB pages "${ROOT}/docs/*.md")
set(found 0)
foreach(page IN LISTS pages)
  file(READ "${page}" text)
  string(REGEX MATCHALL "<!-- program: [^ ]+ -->" marks "${text}")
  foreach(mark IN LISTS marks)
    math(EXPR found "${found} + 1")
    string(REGEX REPLACE "<!-- program: ([^ ]+) -->" "\\1" name "${mark}")
    file(READ "${ROOT}/${name}" program)
    string(REPLACE "// SPDX-License-Identifier: MIT\n" "" program "${program}")
    string(FIND "${text}" "${mark}\n```cpp\n${program}```\n" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "${page} does not show ${name} as it is")
    endif()
  endforeach()
endforeach()
if(found EQUAL 0)
  message(FATAL_ERROR "no page shows a program: this rule looks at nothing")
endif()
