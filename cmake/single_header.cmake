# SPDX-License-Identifier: MIT
# Joins voussoir.hpp and the headers it includes into one file, each once, where it is first included.
#   cmake -DROOT=<project> -DOUTPUT=<file> -P single_header.cmake
# The file is for the header-only use: `#if VOUSSOIR_BODIES` is true in it and `#ifdef
# VOUSSOIR_COMPILED` false, so both are resolved here. A header of ours included under any other
# condition, or an #else of these two, is refused rather than guessed at.
cmake_minimum_required(VERSION 3.25)
set(include "${ROOT}/include")

# A list of lines: what would split or join its elements goes by other names meanwhile.
string(ASCII 1 open)
string(ASCII 2 close)
string(ASCII 3 semicolon)
string(ASCII 4 backslash)
macro(read_lines header result)
  file(READ "${include}/${header}" ${result})
  string(REGEX REPLACE "\n$" "" ${result} "${${result}}")
  string(REPLACE "\\" "${backslash}" ${result} "${${result}}")
  string(REPLACE "[" "${open}" ${result} "${${result}}")
  string(REPLACE "]" "${close}" ${result} "${${result}}")
  string(REPLACE ";" "${semicolon}" ${result} "${${result}}")
  string(REPLACE "\n" ";" ${result} "${${result}}")
endmacro()

# join(<header> <text>): a piece of that header, unless it is blank.
function(join header text)
  if(text MATCHES "[^\n]")
    set_property(GLOBAL APPEND_STRING PROPERTY joined "\n// ---- ${header} ----\n${text}")
  endif()
endfunction()

# add(<header>): appends its text to `joined`, with that of the headers it includes.
function(add header)
  get_property(seen GLOBAL PROPERTY joined_headers)
  if(header IN_LIST seen)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY joined_headers "${header}")
  read_lines("${header}" lines)
  set(conditions "")  # those the line is under, innermost first: true, false or kept
  set(text "")
  foreach(line IN LISTS lines)
    set(keep TRUE)
    if(line MATCHES "^ *# *if")
      set(condition kept)
      if(line STREQUAL "#if VOUSSOIR_BODIES")
        set(condition true)
      elseif(line STREQUAL "#ifdef VOUSSOIR_COMPILED")
        set(condition false)
      endif()
      list(PREPEND conditions ${condition})
      if(NOT condition STREQUAL "kept")
        set(keep FALSE)
      endif()
    elseif(line MATCHES "^ *# *(else|elif)")
      list(GET conditions 0 condition)
      if(NOT condition STREQUAL "kept")
        message(FATAL_ERROR "${header}: `${line}` of a condition that is resolved here")
      endif()
    elseif(line MATCHES "^ *# *endif")
      list(POP_FRONT conditions condition)
      if(NOT condition STREQUAL "kept")
        set(keep FALSE)
      endif()
    elseif(line STREQUAL "#pragma once" OR line STREQUAL "// SPDX-License-Identifier: MIT")
      set(keep FALSE)
    elseif(line MATCHES "^ *# *include" AND NOT "false" IN_LIST conditions)
      if(line MATCHES "^#include <(voussoir/[^>]+)>$")
        set(included "${CMAKE_MATCH_1}")
        if("kept" IN_LIST conditions)
          message(FATAL_ERROR "${header}: includes ${included} under a condition that is not resolved here")
        endif()
        set(keep FALSE)
        join("${header}" "${text}")
        set(text "")
        add("${included}")
      elseif(NOT line MATCHES "^ *# *include <[^>]+>$")
        message(FATAL_ERROR "${header}: `${line}` is not the form `#include <...>`")
      elseif(NOT "kept" IN_LIST conditions)
        get_property(seen GLOBAL PROPERTY others_includes)
        if(line IN_LIST seen)
          set(keep FALSE)
        endif()
        set_property(GLOBAL APPEND PROPERTY others_includes "${line}")
      endif()
    endif()
    if(keep AND NOT "false" IN_LIST conditions)
      string(APPEND text "${line}\n")
    endif()
  endforeach()
  if(conditions)
    message(FATAL_ERROR "${header}: an #if without #endif")
  endif()
  join("${header}" "${text}")
endfunction()

set_property(GLOBAL PROPERTY joined "")
add(voussoir/voussoir.hpp)
get_property(joined GLOBAL PROPERTY joined)
string(REPLACE "${semicolon}" ";" joined "${joined}")
string(REPLACE "${open}" "[" joined "${joined}")
string(REPLACE "${close}" "]" joined "${joined}")
string(REPLACE "${backslash}" "\\" joined "${joined}")
string(REGEX REPLACE "\n\n\n+" "\n\n" joined "${joined}")
if(joined MATCHES "# *(include *[<\"]voussoir|pragma once|line )")
  message(FATAL_ERROR "`${CMAKE_MATCH_0}` is left in the joined header")
endif()

if(NOT joined MATCHES "#define VOUSSOIR_VERSION_STRING \"([0-9.]+)\"")
  message(FATAL_ERROR "no VOUSSOIR_VERSION_STRING in the joined header")
endif()
set(version "${CMAKE_MATCH_1}")
file(READ "${ROOT}/LICENSE" licence)
string(STRIP "${licence}" licence)
string(REPLACE "\n" "\n// " licence "// ${licence}")
string(REPLACE "// \n" "//\n" licence "${licence}")
file(
  WRITE "${OUTPUT}"
  "// SPDX-License-Identifier: MIT
//
// Voussoir ${version} in one header: all of <voussoir/voussoir.hpp>. Made from the headers at release,
// not to be edited. Needs C++20, Eigen 3.4 and threads; pictures and files (io/) and statistics/ are
// not in it, and there is no voussoir::compiled for it.
//
${licence}
#pragma once
#ifdef VOUSSOIR_COMPILED
#error \"the single header of Voussoir is header-only: do not define VOUSSOIR_COMPILED\"
#endif
${joined}")
get_property(seen GLOBAL PROPERTY joined_headers)
list(LENGTH seen count)
message(STATUS "voussoir ${version}: ${count} headers joined in ${OUTPUT}")
