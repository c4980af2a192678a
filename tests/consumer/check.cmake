# SPDX-License-Identifier: MIT
# Configures, builds and runs the consumer, with voussoir installed (WAY=installed) or as a subdirectory.
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${WORK}")
if(WAY STREQUAL "installed")
  run("${CMAKE_COMMAND}" --install "${BUILD}" --component voussoir_headers --prefix "${WORK}/prefix")
  set(how "-Dvoussoir_ROOT=${WORK}/prefix" "-DVOUSSOIR_VERSION=${VERSION}")
else()
  set(how "-DVOUSSOIR_SOURCE=${SOURCE}")
endif()
run("${CMAKE_COMMAND}"
    -S "${SOURCE}/tests/consumer"
    -B "${WORK}/build"
    -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}"
    -DCMAKE_BUILD_TYPE=Debug
    -DCMAKE_CXX_FLAGS_DEBUG=-O0 # without -g, which doubles the time
    -DFETCHCONTENT_FULLY_DISCONNECTED=ON
    ${how})
run("${CMAKE_COMMAND}" --build "${WORK}/build" --parallel 2)
run("${WORK}/build/consumer")
if(WAY STREQUAL "installed")
  run("${WORK}/build/consumer_compiled")
endif()
