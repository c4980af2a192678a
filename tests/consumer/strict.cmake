# SPDX-License-Identifier: MIT
# What the consumers that use CMake have in common.

# nothing_is_built(<folder>): refuses targets, there and below, that the project builds by itself.
function(nothing_is_built folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    get_target_property(on_demand ${target} EXCLUDE_FROM_ALL)
    if(NOT type STREQUAL "INTERFACE_LIBRARY" AND NOT on_demand)
      message(FATAL_ERROR "${target} of ${folder} is built although voussoir is not the top-level project")
    endif()
  endforeach()
  get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    nothing_is_built("${below}")
  endforeach()
endfunction()

function(add_strict_executable name)
  add_executable(${name} ${ARGN})
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
endfunction()
