# SPDX-License-Identifier: MIT
# Contact detection, ours and that of others, on the same pairs; README.md says how they are run.
#   contact_workloads         writes the pairs and the exact answers
#   contact_peers_<library>   prints one line of JSON per query; contact_table makes one table of all
#   contact_<library>_bench   the same queries under Google Benchmark; ours is contact_bench
# Only plain numbers pass between the parts of a program, because the parts that know a library are
# compiled with flags of their own and Eigen's types follow those flags.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=native VOUSSOIR_HAVE_MARCH_NATIVE)
set(contact_native $<${gnu_like}:-O3>)
if(VOUSSOIR_HAVE_MARCH_NATIVE)
  list(APPEND contact_native -march=native)
endif()

add_library(contact_common OBJECT contact_workload.cpp contact_query.cpp)
add_library(contact_peers OBJECT contact_peers.cpp)
add_library(contact_bench_main OBJECT contact_bench.cpp)
foreach(part contact_common contact_peers contact_bench_main)
  target_compile_features(${part} PUBLIC cxx_std_20)
  target_link_libraries(${part} PRIVATE voussoir_own)
endforeach()
target_link_libraries(contact_bench_main PUBLIC benchmark::benchmark)

# The queries of one library, then the programs that ask them.
function(contact_library name source built)
  add_library(contact_${name} OBJECT ${source})
  target_link_libraries(contact_${name} PUBLIC contact_common PRIVATE voussoir_warnings)
  target_compile_definitions(contact_${name} PRIVATE VOUSSOIR_BENCH_BUILD="${built}")
  add_executable(contact_peers_${name})
  target_link_libraries(contact_peers_${name} PRIVATE contact_${name} contact_common contact_peers)
endfunction()
function(contact_google_benchmark name library)
  add_executable(${name})
  target_link_libraries(${name} PRIVATE ${library} contact_common contact_bench_main)
endfunction()

# ---- our own, as fast as this machine can, and as distributions compile ------------------------------
# NDEBUG and the level are set here, so that every build type measures the same; -g0, because the
# tests' build compiles this too and debug information takes a quarter of the time.
contact_library(native contact_detectors.cpp O3-native)
contact_library(plain contact_detectors.cpp O2-${CMAKE_SYSTEM_PROCESSOR})
target_compile_options(contact_native PRIVATE ${contact_native})
target_compile_options(contact_plain PRIVATE $<${gnu_like}:-O2>)
foreach(variant native plain)
  target_compile_options(contact_${variant} PRIVATE "$<${gnu_like}:-ffp-contract=off;-g0>")
  target_compile_definitions(contact_${variant} PRIVATE NDEBUG)
  target_link_libraries(contact_${variant} PRIVATE voussoir::voussoir)
endforeach()
contact_google_benchmark(contact_bench contact_native)
if(CMAKE_BUILD_TYPE STREQUAL "Debug")  # the tests' build need not compile it twice
  set_target_properties(contact_plain contact_peers_plain PROPERTIES EXCLUDE_FROM_ALL ON)
endif()

add_executable(contact_workloads contact_workloads.cpp)
target_include_directories(contact_workloads PRIVATE "${PROJECT_SOURCE_DIR}/tests")
target_link_libraries(contact_workloads PRIVATE contact_common voussoir::voussoir voussoir_own)
target_compile_options(contact_workloads PRIVATE $<${gnu_like}:-g0>)

if(UNIX)  # runs the others through pipes
  add_executable(contact_table contact_table.cpp)
  target_compile_features(contact_table PRIVATE cxx_std_20)
  target_link_libraries(contact_table PRIVATE voussoir_own)
endif()

# ---- others, where they are installed; nothing else is linked with them ------------------------------
# Debian: libbox2d-dev libbullet-dev libccd-dev libfcl-dev libode-dev
function(contact_other name source header folder)
  find_path(VOUSSOIR_${name}_INCLUDE ${header} PATH_SUFFIXES ${folder})
  mark_as_advanced(VOUSSOIR_${name}_INCLUDE)
  set(found ${VOUSSOIR_${name}_INCLUDE})
  set(files "")
  foreach(library IN LISTS ARGN)
    find_library(VOUSSOIR_LIB_${library} ${library})
    mark_as_advanced(VOUSSOIR_LIB_${library})
    list(APPEND files ${VOUSSOIR_LIB_${library}})
    if(NOT VOUSSOIR_LIB_${library})
      set(found FALSE)
    endif()
  endforeach()
  if(found)
    contact_library(${name} ${source} package)
    contact_google_benchmark(contact_${name}_bench contact_${name})
    target_include_directories(contact_${name} SYSTEM PRIVATE ${VOUSSOIR_${name}_INCLUDE})
    target_compile_options(contact_${name} PRIVATE $<${gnu_like}:-O3>)
    target_link_libraries(contact_${name} PUBLIC ${files})
  endif()
endfunction()
contact_other(box2d contact_box2d.cpp box2d/b2_collision.h . box2d)
contact_other(bullet_float contact_bullet.cpp btBulletCollisionCommon.h bullet BulletCollision
              LinearMath)
contact_other(bullet_double contact_bullet.cpp btBulletCollisionCommon.h bullet
              BulletCollision-float64 LinearMath-float64)
if(TARGET contact_bullet_double)
  target_compile_definitions(contact_bullet_double PRIVATE BT_USE_DOUBLE_PRECISION)
endif()
contact_other(ccd contact_ccd.cpp ccd/ccd.h . ccd)
contact_other(fcl contact_fcl.cpp fcl/narrowphase/collision.h . fcl ccd)
if(TARGET contact_fcl)
  target_link_libraries(contact_fcl PRIVATE Eigen3::Eigen)
endif()
contact_other(ode contact_ode.cpp ode/ode.h . ode)
# Not fcl: it takes Eigen's types across its border, and their layout follows this flag.
foreach(name box2d bullet_float bullet_double ccd ode)
  if(TARGET contact_${name})
    target_compile_options(contact_${name} PRIVATE ${contact_native})
  endif()
endforeach()
