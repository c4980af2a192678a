# SPDX-License-Identifier: MIT
# `cmake --install` puts the headers and a package file for find_package(voussoir) in place.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/voussoir")  # share: nothing depends on the machine
install(
  TARGETS voussoir
  EXPORT voussoirTargets
  FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT voussoir_headers)
install(
  EXPORT voussoirTargets
  NAMESPACE voussoir::
  DESTINATION "${package_dir}"
  COMPONENT voussoir_headers)
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/voussoirConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/cmake/voussoirConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/cmake/voussoirConfigVersion.cmake"
                                 COMPATIBILITY SameMajorVersion ARCH_INDEPENDENT)
install(
  FILES "${PROJECT_BINARY_DIR}/cmake/voussoirConfig.cmake"
        "${PROJECT_BINARY_DIR}/cmake/voussoirConfigVersion.cmake"
  DESTINATION "${package_dir}"
  COMPONENT voussoir_headers)
# For pkg-config; the prefix is counted from where the file lies, so that a package can be moved.
if(IS_ABSOLUTE "${CMAKE_INSTALL_DATADIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(pc_prefix "${CMAKE_INSTALL_PREFIX}")
  set(pc_includedir "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
  file(RELATIVE_PATH up "/${CMAKE_INSTALL_DATADIR}/pkgconfig" "/")
  string(REGEX REPLACE "/$" "" up "${up}")
  set(pc_prefix "\${pcfiledir}/${up}")
  set(pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
configure_file("${CMAKE_CURRENT_LIST_DIR}/voussoir.pc.in" "${PROJECT_BINARY_DIR}/cmake/voussoir.pc"
               @ONLY)
install(
  FILES "${PROJECT_BINARY_DIR}/cmake/voussoir.pc"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/pkgconfig"
  COMPONENT voussoir_headers)
install(
  FILES "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT voussoir_headers)
# voussoir::compiled and voussoir::design go along as sources: the project that links them compiles
# them, with its own compiler and flags, and the package stays the same for every machine.
install(
  FILES ${voussoir_compiled_sources} ${voussoir_design_sources}
  DESTINATION "${package_dir}/compiled"
  COMPONENT voussoir_headers)
if(TARGET voussoir_cli)
  install(TARGETS voussoir_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
                                       COMPONENT voussoir_program)
endif()
