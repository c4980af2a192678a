# SPDX-License-Identifier: MIT
# What was compiled before with the same flags is taken from ccache, where that is installed and no
# other launcher is asked for. Precompiled headers need three things: ccache must not look at what
# they define and when they were made, g++ must name them in what it preprocesses, and clang++ must
# leave the time of the headers out of them.
if(VOUSSOIR_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(VOUSSOIR_CCACHE_PROGRAM ccache)
  mark_as_advanced(VOUSSOIR_CCACHE_PROGRAM)
  if(VOUSSOIR_CCACHE_PROGRAM)
    set(CMAKE_CXX_COMPILER_LAUNCHER
        "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros
        "${VOUSSOIR_CCACHE_PROGRAM}")
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      add_compile_options(-fpch-preprocess)
    elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
      add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
    endif()
  endif()
endif()
