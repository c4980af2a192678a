# SPDX-License-Identifier: MIT
# A Debian source tree with its tar file: what git has, with a debian/ made from the templates in
# packaging/debian. `dpkg-buildpackage -us -uc` in it makes the packages.
#   cmake -DROOT=<project> -DOUTPUT=<folder> -DVERSION=<version> -P debian.cmake
cmake_minimum_required(VERSION 3.25)
set(version "${VERSION}")
set(tree "${OUTPUT}/voussoir-${version}")

function(git result)
  execute_process(COMMAND git -C "${ROOT}" ${ARGN} OUTPUT_VARIABLE text
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()
# The day and the name of the last commit, so that a commit always gives the same files.
git(date log -1 --format=%cD)
git(seconds log -1 --format=%ct)
git(maintainer log -1 "--format=%cn <%ce>")
if(NOT "$ENV{DEBFULLNAME}" STREQUAL "" AND NOT "$ENV{DEBEMAIL}" STREQUAL "")
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")  # as Debian's own tools have it
endif()
git(files ls-files)
string(REPLACE "\n" ";" files "${files}")

file(REMOVE_RECURSE "${OUTPUT}")
foreach(file IN LISTS files)
  cmake_path(GET file PARENT_PATH folder)
  file(COPY "${ROOT}/${file}" DESTINATION "${tree}/${folder}")
endforeach()
execute_process(
  COMMAND tar --create --xz --sort=name "--mtime=@${seconds}" --owner=0 --group=0 --numeric-owner
          --file "voussoir_${version}.orig.tar.xz" "voussoir-${version}"
  WORKING_DIRECTORY "${OUTPUT}" COMMAND_ERROR_IS_FATAL ANY)

# The licence as Debian's copyright files have texts: indented, a dot for a blank line.
file(READ "${ROOT}/LICENSE" licence)
string(REGEX REPLACE "^.*\n(Permission is)" "\\1" licence "${licence}")
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence " ${licence}")
foreach(name IN ITEMS changelog control copyright rules voussoir.1)
  configure_file("${ROOT}/cmake/packaging/debian/${name}.in" "${tree}/debian/${name}" @ONLY)
endforeach()
file(CHMOD "${tree}/debian/rules" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
                                              GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
file(WRITE "${tree}/debian/source/format" "3.0 (quilt)\n")
file(WRITE "${tree}/debian/voussoir.manpages" "debian/voussoir.1\n")
message(STATUS "in ${tree}: dpkg-buildpackage -us -uc")
