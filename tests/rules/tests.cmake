# SPDX-License-Identifier: MIT
# What tests must not do. Run by CTest:
#   cmake -DROOT=<.../tests> -P tests.cmake
#
# `doctest::Approx` is absolute below 1: 1e-5 agrees with 2e-5. Numbers are held against each other by
# `near` (support/near.hpp), which is relative.
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE sources RELATIVE "${ROOT}" "${ROOT}/*.cpp" "${ROOT}/*.hpp")
list(LENGTH sources count)
if(count LESS 100)
  message(FATAL_ERROR "${ROOT}: ${count} sources, expected hundreds")
endif()
foreach(source IN LISTS sources)
  if(source STREQUAL "support/near.hpp")
    continue()
  endif()
  file(STRINGS "${ROOT}/${source}" lines REGEX "doctest::Approx|[^a-zA-Z]Approx\\(")
  foreach(line IN LISTS lines)
    message(SEND_ERROR "tests/${source}: ${line}\n  doctest::Approx is absolute below 1: "
                       "use near of support/near.hpp")
  endforeach()
endforeach()
