# SPDX-License-Identifier: MIT
# Every header compiles alone (and twice in one file); all of them twice in one program, so that a
# function without `inline` is found by the linker. -O0 and no sanitizer: only the compiler's word
# counts. NDEBUG here, because the tests themselves compile the headers with assertions.
set(generated "${CMAKE_CURRENT_BINARY_DIR}/headers")
set(header_options "$<${gnu_like}:-O0;-g0;-fno-sanitize=all>")

set(alone "")
set(everything "// SPDX-License-Identifier: MIT\n")
foreach(header IN LISTS voussoir_headers)
  cmake_path(RELATIVE_PATH header BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/include" OUTPUT_VARIABLE path)
  string(REGEX REPLACE "\\.hpp$" ".cpp" file "${generated}/${path}")
  file(CONFIGURE OUTPUT "${file}" CONTENT "#include <@path@>\n#include <@path@>\n" @ONLY)
  list(APPEND alone "${file}")
  string(APPEND everything "#include <${path}>\n")
endforeach()
file(CONFIGURE OUTPUT "${generated}/everything.hpp" CONTENT "${everything}" @ONLY)
file(CONFIGURE OUTPUT "${generated}/first.cpp" @ONLY
     CONTENT "#include \"everything.hpp\"\nint second();\nint main() { return second(); }\n")
file(CONFIGURE OUTPUT "${generated}/second.cpp" @ONLY
     CONTENT "#include \"everything.hpp\"\nint second();\nint second() { return 0; }\n")

add_library(voussoir_headers_alone OBJECT ${alone})
add_executable(voussoir_headers_twice "${generated}/first.cpp" "${generated}/second.cpp")
foreach(target voussoir_headers_alone voussoir_headers_twice)
  target_link_libraries(${target} PRIVATE voussoir::voussoir voussoir_own Boost::headers)
  target_compile_definitions(${target} PRIVATE NDEBUG)
  target_compile_options(${target} PRIVATE "${header_options}")
endforeach()
add_test(NAME rules/headers_twice_in_one_program COMMAND voussoir_headers_twice)
