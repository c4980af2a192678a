# SPDX-License-Identifier: MIT
# Compiles one misuse. It must fail, and the compiler must print the sentence of the file's first line:
#   // expect: <sentence>      or, for a control that proves the set-up,      // expect-success
# Source lines are kept out of the compiler's output: a sentence quoted from the header does not count.
cmake_minimum_required(VERSION 3.25)
file(READ "${SOURCE}" text)
set(ENV{LC_ALL} C)
set(first "")
if(FIRST_FOLDER)
  set(first "-I${FIRST_FOLDER}" -include "${COMMON}")
endif()
set(no_source_lines -fno-diagnostics-show-caret)
if(COMPILER_ID MATCHES "Clang")
  set(no_source_lines -fno-caret-diagnostics)
endif()
execute_process(
  COMMAND "${COMPILER}" -std=c++20 -fsyntax-only ${no_source_lines} -fmessage-length=0
          -fdiagnostics-color=never ${first} "@${OPTIONS}" "${SOURCE}"
  RESULT_VARIABLE failed
  OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
if(text MATCHES "^// expect-success *\n")
  if(failed)
    message(FATAL_ERROR "must compile, but:\n${output}")
  endif()
elseif(text MATCHES "^// expect: ([^\n]+)\n")
  string(STRIP "${CMAKE_MATCH_1}" sentence)
  string(FIND "${output}" "${sentence}" at)
  if(NOT failed)
    message(FATAL_ERROR "compiles, but must be refused with: ${sentence}")
  elseif(at EQUAL -1)
    message(FATAL_ERROR "refused, but without the sentence: ${sentence}\n${output}")
  endif()
else()
  message(FATAL_ERROR "${SOURCE}: first line must be `// expect: <sentence>` or `// expect-success`")
endif()
