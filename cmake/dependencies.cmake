# SPDX-License-Identifier: MIT
# What the project uses from others. An installed package is taken first; only what is missing is
# fetched, and nothing is with -DFETCHCONTENT_FULLY_DISCONNECTED=ON.
include(FetchContent)

FetchContent_Declare(
  Eigen3 SYSTEM
  URL https://gitlab.com/libeigen/eigen/-/archive/3.4.0/eigen-3.4.0.tar.gz
  DOWNLOAD_EXTRACT_TIMESTAMP OFF
  FIND_PACKAGE_ARGS 3.4)
FetchContent_Declare(
  doctest SYSTEM
  URL https://github.com/doctest/doctest/archive/refs/tags/v2.4.9.tar.gz
  DOWNLOAD_EXTRACT_TIMESTAMP OFF
  FIND_PACKAGE_ARGS 2.4)
FetchContent_Declare(
  CLI11 SYSTEM
  URL https://github.com/CLIUtils/CLI11/archive/refs/tags/v2.1.2.tar.gz
  DOWNLOAD_EXTRACT_TIMESTAMP OFF
  FIND_PACKAGE_ARGS 2.1)
FetchContent_Declare(
  tomlplusplus SYSTEM
  URL https://github.com/marzer/tomlplusplus/archive/refs/tags/v3.3.0.tar.gz
  DOWNLOAD_EXTRACT_TIMESTAMP OFF
  FIND_PACKAGE_ARGS 3.3)
FetchContent_Declare(
  nlohmann_json SYSTEM
  URL https://github.com/nlohmann/json/releases/download/v3.11.2/json.tar.xz
  DOWNLOAD_EXTRACT_TIMESTAMP OFF
  FIND_PACKAGE_ARGS 3.11)

# voussoir_need(<package>): its targets exist afterwards, wherever they came from. A function, so that
# the settings for a fetched project stay in here; the targets are global, so that a project that
# takes voussoir by add_subdirectory sees them.
function(voussoir_need name)
  set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)
  if(name STREQUAL "Threads")
    set(THREADS_PREFER_PTHREAD_FLAG ON)
    find_package(Threads REQUIRED)
  elseif(name STREQUAL "Boost")
    find_package(Boost 1.74 REQUIRED)  # headers only
  else()
    set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)  # the next lines win over option() of a fetched project
    set(BUILD_TESTING OFF)
    set(EIGEN_BUILD_DOC OFF)
    set(EIGEN_BUILD_PKGCONFIG OFF)
    set(DOCTEST_WITH_TESTS OFF)
    set(CLI11_BUILD_TESTS OFF)
    set(CLI11_BUILD_EXAMPLES OFF)
    set(CLI11_BUILD_DOCS OFF)
    set(JSON_BuildTests OFF)
    FetchContent_MakeAvailable(${name})
  endif()
endfunction()

# toml++ with its parser compiled into the caller. Debian's package target asks for a shared library
# instead; taking only its include folder gives the same program on every machine.
function(voussoir_need_toml)
  if(TARGET voussoir_toml)
    return()
  endif()
  voussoir_need(tomlplusplus)
  add_library(voussoir_toml INTERFACE)
  target_include_directories(
    voussoir_toml SYSTEM
    INTERFACE $<TARGET_PROPERTY:tomlplusplus::tomlplusplus,INTERFACE_INCLUDE_DIRECTORIES>)
  target_compile_definitions(voussoir_toml INTERFACE TOML_HEADER_ONLY=1)
endfunction()
