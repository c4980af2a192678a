# SPDX-License-Identifier: MIT
# version.hpp, the newest entry of CHANGELOG.md and the CMake project state the same version.
cmake_minimum_required(VERSION 3.25)
file(READ "${ROOT}/include/voussoir/core/version.hpp" header)
file(READ "${ROOT}/CHANGELOG.md" changes)
set(numbers "")
foreach(part MAJOR MINOR PATCH)
  string(REGEX MATCH "#define VOUSSOIR_VERSION_${part} ([0-9]+)" unused "${header}")
  list(APPEND numbers "${CMAKE_MATCH_1}")
endforeach()
list(JOIN numbers "." numbers)
string(REGEX MATCH "#define VOUSSOIR_VERSION_STRING \"([^\"]*)\"" unused "${header}")
set(text "${CMAKE_MATCH_1}")
string(REGEX MATCH "\n## \\[([0-9]+\\.[0-9]+\\.[0-9]+)\\]" unused "${changes}")  # the first is the newest
set(newest "${CMAKE_MATCH_1}")
if(NOT (numbers STREQUAL VERSION AND text STREQUAL VERSION AND newest STREQUAL VERSION))
  message(FATAL_ERROR "CMake project ${VERSION}, version.hpp numbers ${numbers} and text ${text}, CHANGELOG.md ${newest}")
endif()
