# SPDX-License-Identifier: MIT
# Two targets for CI and on demand; they are no part of the tests' build.
# voussoir_headers_alone  every header compiles as the only one, and twice in one file
# voussoir_headers_twice  all of them linked twice into one program: the linker finds a function
#                         without `inline`
# The former write no object, only a stamp: the compiler's word is what counts. With NDEBUG, because
# the tests themselves compile the headers with assertions.
set(generated "${CMAKE_CURRENT_BINARY_DIR}/headers")
add_library(voussoir_headers_flags OBJECT EXCLUDE_FROM_ALL support/main.cpp)
target_link_libraries(voussoir_headers_flags PRIVATE voussoir::voussoir Boost::headers)
set(folders "$<TARGET_PROPERTY:voussoir_headers_flags,INCLUDE_DIRECTORIES>")
# Not the compiler's own folder, where packages may lie: named again, it hides the C headers.
set(others
    "$<FILTER:$<REMOVE_DUPLICATES:${folders}>,EXCLUDE,^(${PROJECT_SOURCE_DIR}/.*|/usr/include)$>")
set(options_file "${CMAKE_CURRENT_BINARY_DIR}/headers_$<CONFIG>.options")
set(warnings "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror")
file(GENERATE OUTPUT "${options_file}"
     CONTENT "-std=c++20 -DNDEBUG ${warnings} -I\"${PROJECT_SOURCE_DIR}/include\"
$<$<BOOL:${others}>:-isystem \"$<JOIN:${others},\"\n-isystem \">\">\n")

# Most headers include one of these, some way down, and half of their time is what that includes. It
# may come precompiled, which hides nothing: it would be there anyway. A header takes the last that
# it includes.
set(commons voussoir/core/vec.hpp voussoir/geometry/convex_polyhedron.hpp
            voussoir/model/contact_tracker.hpp)
set(paths "")
foreach(header IN LISTS voussoir_headers)
  cmake_path(RELATIVE_PATH header BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/include" OUTPUT_VARIABLE path)
  list(APPEND paths "${path}")
  file(STRINGS "${header}" lines REGEX "^#include <voussoir/")
  string(REGEX REPLACE "#include <([^>]*)>" "\\1" "includes_of_${path}" "${lines}")
endforeach()
set(precompiled "")
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(commons "")
endif()
foreach(common IN LISTS commons)
  set(first "${generated}/precompiled/${common}")  # where g++ finds <common>.gch before <common>
  cmake_path(GET common PARENT_PATH folder)
  file(MAKE_DIRECTORY "${first}/${folder}")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/include/${common}" "${first}/${common}" COPY_ON_ERROR
       SYMBOLIC)
  add_custom_command(
    OUTPUT "${first}/${common}.gch"
    COMMAND "${CMAKE_CXX_COMPILER}" "@${options_file}" -w -x c++-header "${first}/${common}" -o
            "${first}/${common}.gch"
    DEPENDS ${voussoir_headers} "${options_file}"
    COMMENT "${common} precompiled"
    VERBATIM)
  list(APPEND precompiled "${first}/${common}.gch")
  set(with_common "${common}")
  set(before "")
  while(NOT with_common STREQUAL before)
    set(before "${with_common}")
    foreach(path IN LISTS paths)
      foreach(included IN LISTS "includes_of_${path}")
        if(included IN_LIST with_common AND NOT path IN_LIST with_common)
          list(APPEND with_common "${path}")
          set("common_of_${path}" "${common}")
        endif()
      endforeach()
    endforeach()
  endwhile()
endforeach()

set(stamps "")
set(everything "// SPDX-License-Identifier: MIT\n")
foreach(path IN LISTS paths)
  string(REGEX REPLACE "\\.hpp$" ".cpp" file "${generated}/${path}")
  set(content "#include <${path}>\n#include <${path}>\n")
  set(use "")
  if(DEFINED "common_of_${path}")
    set(common "${common_of_${path}}")
    string(PREPEND content "#include <${common}>\n")
    set(use "-I${generated}/precompiled/${common}")
  endif()
  file(CONFIGURE OUTPUT "${file}" CONTENT "${content}" @ONLY)
  add_custom_command(
    OUTPUT "${file}.stamp"
    COMMAND "${CMAKE_CXX_COMPILER}" ${use} "@${options_file}" -fsyntax-only "${file}"
    COMMAND "${CMAKE_COMMAND}" -E touch "${file}.stamp"
    DEPENDS ${voussoir_headers} ${precompiled} "${options_file}"
    COMMENT "${path} alone"
    VERBATIM)
  list(APPEND stamps "${file}.stamp")
  string(APPEND everything "#include <${path}>\n")
endforeach()
add_custom_target(voussoir_headers_alone DEPENDS ${stamps})

# One object does for two files: linked with itself, it has twice what no `inline` allows.
file(CONFIGURE OUTPUT "${generated}/everything.cpp" CONTENT "${everything}" @ONLY)
add_library(voussoir_everything OBJECT EXCLUDE_FROM_ALL "${generated}/everything.cpp")
target_link_libraries(voussoir_everything PRIVATE voussoir::voussoir voussoir_own Boost::headers)
target_compile_definitions(voussoir_everything PRIVATE NDEBUG)
target_compile_options(voussoir_everything PRIVATE "$<${gnu_like}:-O0;-g0;-fno-sanitize=all>")
set(object "$<TARGET_OBJECTS:voussoir_everything>")
add_custom_target(
  voussoir_headers_twice
  COMMAND "${CMAKE_CXX_COMPILER}" -r "${object}" "${object}" -o "${generated}/twice.o"
  DEPENDS voussoir_everything
  VERBATIM)
