# SPDX-License-Identifier: MIT
# What the headers make a compiler read: the preprocessed size of some, as multiples of that of
# Eigen/Core, so that it hardly depends on the compiler. Fails where one is 15 % off what
# tests/data/header-sizes.csv has: an include that pulls in half a library costs every user seconds.
# Smaller ones fail too, so that the gain is written down.
cmake_minimum_required(VERSION 3.25)
function(preprocessed_size header result)
  file(WRITE "${WORK}/size.cpp" "#include <${header}>\n")
  execute_process(
    COMMAND "${COMPILER}" -std=c++20 -DNDEBUG -E -P "@${OPTIONS}" "${WORK}/size.cpp"
    OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(LENGTH "${text}" size)
  set(${result} ${size} PARENT_SCOPE)
endfunction()

file(STRINGS "${DATA}" lines)
list(POP_FRONT lines)  # header,percent_of_eigen_core
preprocessed_size(Eigen/Core unit)
set(wrong "")
foreach(line IN LISTS lines)
  string(REPLACE "," ";" fields "${line}")
  list(GET fields 0 header)
  list(GET fields 1 expected)
  preprocessed_size("${header}" size)
  math(EXPR percent "100 * ${size} / ${unit}")
  math(EXPR low "${expected} * 85 / 100")
  math(EXPR high "${expected} * 115 / 100")
  message(STATUS "${header}: ${percent} % of Eigen/Core, written down: ${expected} %")
  if(percent LESS low OR percent GREATER high)
    string(APPEND wrong "\n  ${header}: ${percent} % of Eigen/Core instead of ${expected} %")
  endif()
endforeach()
if(wrong)
  message(FATAL_ERROR "preprocessed sizes have changed by more than 15 %:${wrong}\nIf this is meant, "
                      "write the new figure into ${DATA}.")
endif()
