# SPDX-License-Identifier: MIT
# Toolchain file: the program for Windows as one file without companions, made on Debian by
# g++-mingw-w64-x86-64-posix. `cmake --preset windows && cmake --build --preset windows`.
#
# The packages are headers, and this machine's serve Windows as well; the folder they are in,
# /usr/include, does not: it has the headers of this machine's C library, too. So the packages are
# linked into a folder of their own in the build tree, and their package files, which find their
# headers from where they are, copied there. A package that is not here is fetched, as always.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(prefix x86_64-w64-mingw32)
set(CMAKE_CXX_COMPILER ${prefix}-g++-posix)
# Not guessed from a compiler of such a name.
find_program(CMAKE_AR ${prefix}-ar)
find_program(CMAKE_RANLIB ${prefix}-ranlib)
find_program(CMAKE_RC_COMPILER ${prefix}-windres)

# Objects of some thousand templates have more sections than the old format can count.
set(CMAKE_CXX_FLAGS_INIT "-Wa,-mbig-obj")
# A stack as on Linux instead of 2 MB.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -static-libgcc -static-libstdc++ -Wl,--stack,8388608")

get_property(is_trial GLOBAL PROPERTY IN_TRY_COMPILE)
set(headers "${CMAKE_BINARY_DIR}/headers")
if(NOT is_trial)
  file(MAKE_DIRECTORY "${headers}/include")
  foreach(package eigen3 boost CLI toml++ nlohmann)
    if(EXISTS "/usr/include/${package}")
      file(CREATE_LINK "/usr/include/${package}" "${headers}/include/${package}" SYMBOLIC)
    endif()
  endforeach()
  foreach(package Eigen3 Boost boost_headers CLI11 tomlplusplus nlohmann_json)
    file(
      GLOB files RELATIVE /usr
      "/usr/share/cmake/${package}/*.cmake" "/usr/share/eigen3/cmake/${package}*.cmake"
      "/usr/lib/*/cmake/${package}/*.cmake" "/usr/lib/*/cmake/${package}-[0-9]*/*.cmake")
    foreach(file IN LISTS files)
      cmake_path(GET file PARENT_PATH folder)
      file(COPY "/usr/${file}" DESTINATION "${headers}/${folder}")
      set(${package}_DIR "${headers}/${folder}")
    endforeach()
  endforeach()
endif()
# On the path of every compilation, as /usr/include is elsewhere.
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES "${headers}/include")

set(CMAKE_FIND_ROOT_PATH "${headers}" /usr/${prefix})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
