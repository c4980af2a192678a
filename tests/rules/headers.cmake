# SPDX-License-Identifier: MIT
# Two targets for CI and on demand; they are no part of the tests' build.
# voussoir_headers_alone  every header compiles as the only one, and twice in one file
# voussoir_headers_twice  all of them in two files of one program: the linker finds a function
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

set(stamps "")
set(everything "// SPDX-License-Identifier: MIT\n")
foreach(header IN LISTS voussoir_headers)
  cmake_path(RELATIVE_PATH header BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/include" OUTPUT_VARIABLE path)
  string(REGEX REPLACE "\\.hpp$" ".cpp" file "${generated}/${path}")
  file(CONFIGURE OUTPUT "${file}" CONTENT "#include <@path@>\n#include <@path@>\n" @ONLY)
  add_custom_command(
    OUTPUT "${file}.stamp"
    COMMAND "${CMAKE_CXX_COMPILER}" "@${options_file}" -fsyntax-only "${file}"
    COMMAND "${CMAKE_COMMAND}" -E touch "${file}.stamp"
    DEPENDS ${voussoir_headers} "${options_file}"
    COMMENT "${path} alone"
    VERBATIM)
  list(APPEND stamps "${file}.stamp")
  string(APPEND everything "#include <${path}>\n")
endforeach()
add_custom_target(voussoir_headers_alone DEPENDS ${stamps})

file(CONFIGURE OUTPUT "${generated}/everything.hpp" CONTENT "${everything}" @ONLY)
file(CONFIGURE OUTPUT "${generated}/first.cpp" @ONLY
     CONTENT "#include \"everything.hpp\"\nint second();\nint main() { return second(); }\n")
file(CONFIGURE OUTPUT "${generated}/second.cpp" @ONLY
     CONTENT "#include \"everything.hpp\"\nint second();\nint second() { return 0; }\n")
add_executable(voussoir_headers_twice EXCLUDE_FROM_ALL "${generated}/first.cpp"
                                                       "${generated}/second.cpp")
target_link_libraries(voussoir_headers_twice PRIVATE voussoir::voussoir voussoir_own Boost::headers)
target_compile_definitions(voussoir_headers_twice PRIVATE NDEBUG)
target_compile_options(voussoir_headers_twice PRIVATE "$<${gnu_like}:-O0;-g0;-fno-sanitize=all>")
