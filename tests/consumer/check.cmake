# SPDX-License-Identifier: MIT
# Configures, builds and runs the consumer in tests/consumer/<WAY> with one compiler.
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${WORK}")
set(consumer "${SOURCE}/tests/consumer/${WAY}")
set(prefix "${WORK}/prefix")
if(WAY STREQUAL "find_package" OR WAY STREQUAL "pkg_config")
  # What is installed must bear to be moved.
  run("${CMAKE_COMMAND}" --install "${BUILD}" --component voussoir_headers --prefix "${WORK}/before")
  file(RENAME "${WORK}/before" "${prefix}")
endif()

if(WAY STREQUAL "pkg_config")
  file(MAKE_DIRECTORY "${WORK}/build")
  set(ENV{PKG_CONFIG_PATH} "${prefix}/share/pkgconfig:$ENV{PKG_CONFIG_PATH}")
  run(pkg-config --validate voussoir)
  run(pkg-config "voussoir = ${VERSION}")
  run(make -f "${consumer}/Makefile" -C "${WORK}/build" -j2 "CXX=${COMPILER}")
else()
  if(WAY STREQUAL "find_package")
    set(how "-Dvoussoir_ROOT=${prefix}" "-DVOUSSOIR_VERSION=${VERSION}"
            "-DWITH_COMPILED=${WITH_COMPILED}")
  elseif(WAY STREQUAL "subdirectory")
    set(how "-DVOUSSOIR_SOURCE=${SOURCE}")
  elseif(WAY STREQUAL "fetch_content")
    set(how "-DFETCHCONTENT_SOURCE_DIR_VOUSSOIR=${SOURCE}")
  elseif(WAY STREQUAL "single_header")
    run("${CMAKE_COMMAND}" "-DROOT=${SOURCE}" "-DOUTPUT=${WORK}/single/voussoir/voussoir.hpp" -P
        "${SOURCE}/cmake/single_header.cmake")
    set(how "-DSINGLE_HEADER=${WORK}/single")
  endif()
  run("${CMAKE_COMMAND}"
      -S "${consumer}"
      -B "${WORK}/build"
      -G "${GENERATOR}"
      "-DCMAKE_CXX_COMPILER=${COMPILER}"
      -DCMAKE_BUILD_TYPE=Debug
      -DCMAKE_CXX_FLAGS_DEBUG=-O0 # without -g, which doubles the time
      -DFETCHCONTENT_FULLY_DISCONNECTED=ON
      ${how})
  file(GLOB fetched "${WORK}/build/_deps/*-src" "${WORK}/build/_deps/*-subbuild")
  if(fetched)
    message(FATAL_ERROR "fetched: ${fetched}")
  endif()
  run("${CMAKE_COMMAND}" --build "${WORK}/build" --parallel 2)
endif()
run("${WORK}/build/consumer")
if(WITH_COMPILED)
  run("${WORK}/build/consumer_compiled")
endif()
