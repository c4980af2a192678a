# SPDX-License-Identifier: MIT
# The single header is voussoir.hpp: the compiler reads the same from both, blanks aside.
#   cmake -DROOT=<project> -DCOMPILER=<c++> -DOPTIONS=<file> -DWORK=<scratch folder> -P single_header.cmake
cmake_minimum_required(VERSION 3.25)
function(preprocessed line result)
  file(WRITE "${WORK}/both.cpp" "${line}\n")
  execute_process(COMMAND "${COMPILER}" -std=c++20 -E -P "@${OPTIONS}" "${WORK}/both.cpp"
                  OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  foreach(blank IN ITEMS "\n" " " "\t")
    string(REPLACE "${blank}" "" text "${text}")
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(single "${WORK}/single/voussoir.hpp")
execute_process(COMMAND "${CMAKE_COMMAND}" "-DROOT=${ROOT}" "-DOUTPUT=${single}" -P
                        "${ROOT}/cmake/single_header.cmake" COMMAND_ERROR_IS_FATAL ANY)
preprocessed("#include <voussoir/voussoir.hpp>" headers)
preprocessed("#include \"${single}\"" joined)
if(NOT joined STREQUAL headers)
  string(LENGTH "${joined}" joined)
  string(LENGTH "${headers}" headers)
  message(FATAL_ERROR "the compiler reads something else in ${single} than in voussoir.hpp: ${joined} characters that are no blanks, not ${headers}")
endif()
