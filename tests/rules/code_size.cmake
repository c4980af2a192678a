# SPDX-License-Identifier: MIT
# What a program costs to compile, by what comes of it: the bytes of code (`size`, text) of a file
# compiled with -O2, headers alone or with voussoir::compiled. The time of a compiler depends on the
# machine, the amount of code it makes only on the compiler, and the two go together: header_sizes
# sees what is read, not what is instantiated. Fails where a file is 15 % off what
# tests/data/code-sizes.csv has; less fails too, so that the gain is written down. Seconds:
# bench/compile_table.sh.
cmake_minimum_required(VERSION 3.25)
file(STRINGS "${DATA}" lines)
list(POP_FRONT lines)  # file,how,kB
set(wrong "")
foreach(line IN LISTS lines)
  string(REPLACE "," ";" fields "${line}")
  list(GET fields 0 name)
  list(GET fields 1 how)
  list(GET fields 2 expected)
  if(NOT how STREQUAL HOW)
    continue()
  endif()
  set(flags "")
  if(how STREQUAL "compiled")
    set(flags -DVOUSSOIR_COMPILED=1)
  endif()
  execute_process(COMMAND "${COMPILER}" -std=c++20 -O2 -DNDEBUG ${flags} "@${OPTIONS}" -c
                          "${ROOT}/${name}" -o "${WORK}/code_size_${how}.o" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${SIZE}" "${WORK}/code_size_${how}.o" OUTPUT_VARIABLE text
                                                          COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE "${WORK}/code_size_${how}.o")
  if(NOT text MATCHES "\n *([0-9]+)")
    message(FATAL_ERROR "no size in '${text}'")
  endif()
  math(EXPR size "${CMAKE_MATCH_1} / 1000")
  math(EXPR low "${expected} * 85 / 100")
  math(EXPR high "${expected} * 115 / 100")
  message(STATUS "${name}, ${how}: ${size} kB of code, written down: ${expected} kB")
  if(size LESS low OR size GREATER high)
    string(APPEND wrong "\n  ${name}, ${how}: ${size} kB instead of ${expected} kB")
  endif()
endforeach()
if(wrong)
  message(FATAL_ERROR "the amount of code has changed by more than 15 %:${wrong}\nIf this is meant, "
                      "write the new figure into ${DATA}.")
endif()
