# SPDX-License-Identifier: MIT
# What is made at release and not in the tree; nothing builds these targets by itself.
add_custom_target(
  voussoir_single_header
  COMMAND "${CMAKE_COMMAND}" "-DROOT=${PROJECT_SOURCE_DIR}"
          "-DOUTPUT=${PROJECT_BINARY_DIR}/single/voussoir.hpp" -P
          "${CMAKE_CURRENT_LIST_DIR}/single_header.cmake"
  VERBATIM)
add_custom_target(
  voussoir_debian
  COMMAND "${CMAKE_COMMAND}" "-DROOT=${PROJECT_SOURCE_DIR}" "-DOUTPUT=${PROJECT_BINARY_DIR}/debian"
          "-DVERSION=${PROJECT_VERSION}" -P "${CMAKE_CURRENT_LIST_DIR}/debian.cmake"
  VERBATIM)
