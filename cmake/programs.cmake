# SPDX-License-Identifier: MIT
# voussoir_check_programs(<folder> <pattern> <name>...): the programs of a folder are named where
# they are made; a source that is in no list would never be built, and nobody would notice.
function(voussoir_check_programs folder pattern)
  file(GLOB sources CONFIGURE_DEPENDS "${folder}/${pattern}")
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    if(NOT name IN_LIST ARGN)
      message(FATAL_ERROR "voussoir: ${source} is in no list of programs: add ${name} to one in "
                          "${folder}/CMakeLists.txt")
    endif()
  endforeach()
endfunction()
