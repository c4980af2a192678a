# SPDX-License-Identifier: MIT
# The joints of a seed are the same to the last bit with every compiler and set of flags: joints.cpp
# is compiled with several of both, and all must print the line below. Whoever changes what is drawn
# from a seed changes the line, and says "results change" in CHANGELOG.md.
#
#   cmake -DCOMPILER=... -DOPTIONS=<file of include folders> -DSOURCE=... -DWORK=... -DALL=ON
#         -P check.cmake
# With -DALL=OFF COMPILER alone compiles it, once, for what a change of the drawing shows at once.
cmake_minimum_required(VERSION 3.25)
set(expected "2-D 14911 77495dd4164cdd76, 3-D 8018 b4b3623161c82ab4")

set(compilers "${COMPILER}")
set(names "")
set(all_flags "-O2 -ffp-contract=off")
if(ALL)
  set(names g++ clang++)
  set(all_flags "-O0" "-O2 -ffp-contract=off" "-O3 -march=native -ffp-contract=fast")
endif()
foreach(name IN LISTS names)
  find_program(found_${name} ${name})
  if(found_${name})
    list(APPEND compilers "${found_${name}}")
  endif()
endforeach()
set(different)
set(files)
foreach(compiler IN LISTS compilers)  # c++ and g++ are often one; clang++ must be called by its name
  file(REAL_PATH "${compiler}" real)
  if(NOT real IN_LIST files)
    list(APPEND files "${real}")
    list(APPEND different "${compiler}")
  endif()
endforeach()
file(MAKE_DIRECTORY "${WORK}")

foreach(compiler IN LISTS different)
  foreach(flags IN LISTS all_flags)
    separate_arguments(list UNIX_COMMAND "${flags}")
    execute_process(
      COMMAND "${compiler}" -std=c++20 ${list} "@${OPTIONS}" "${SOURCE}" -o "${WORK}/joints"
      RESULT_VARIABLE status ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
      message(FATAL_ERROR "${compiler} ${flags} does not compile ${SOURCE}:\n${errors}")
    endif()
    execute_process(COMMAND "${WORK}/joints" OUTPUT_VARIABLE line OUTPUT_STRIP_TRAILING_WHITESPACE)
    message(STATUS "${compiler} ${flags}: ${line}")
    if(NOT line STREQUAL expected)
      message(FATAL_ERROR "${compiler} ${flags} draws other joints:\n  ${line}\nexpected\n  ${expected}")
    endif()
  endforeach()
endforeach()
