#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What examples/first_picture.sh and tests/run do on machines of several kinds. Nothing is installed
# or built: apt-get, sudo, cmake and the compiler are stand-ins that only say how they were called.
#   setup.sh <project> <scratch folder>
# shellcheck disable=SC2016  # the stand-ins expand what stands in quotes, not this script
set -euo pipefail
root=$1 bin=$2

stand_in() { printf '#!/bin/bash\n%s\n' "$2" >"$bin/$1" && chmod +x "$bin/$1"; }
machine() {  # without apt-get; CMake 3.25 that builds nothing, and a compiler
  rm -rf "$bin" && mkdir -p "$bin"
  local tool
  for tool in bash env dirname basename sed; do ln -s "$(command -v $tool)" "$bin/$tool"; done
  stand_in cmake '[[ $1 == --version ]] && { echo "cmake version 3.25.1"; exit; }
echo "cmake $*"; [[ $* != *build* && $* != *workflow* ]]'
  stand_in c++ ''
  stand_in gnuplot ''
}
debian() {  # with apt-get, where all but g++ is installed
  machine
  stand_in apt-get 'echo "apt-get $*"; exit "${APT:-0}"'
  stand_in dpkg-query '[[ $3 == g++ ]] || echo -n installed'
  stand_in id 'echo "${USER_ID:-0}"'
}

failed=0
# expect <exit status> <sentence that must be said> <sentence that must not> <command>...
expect() {
  local code=0 said status=$1 must=$2 must_not=$3
  shift 3
  said=$(cd / && PATH="$bin" "$@" 2>&1) || code=$?
  if [[ $code != "$status" || $said != *"$must"* || (-n $must_not && $said == *"$must_not"*) ]]; then
    printf 'expected exit status %s and "%s" (not "%s"), got %s and\n%s\n\n' "$status" "$must" \
      "$must_not" "$code" "$said"
    failed=1
  fi
}
picture=$root/examples/first_picture.sh tests=$root/tests/run

machine
expect 1 'names on Debian: g++ cmake' '' "$picture"
expect 1 'the program did not compile' 'could not set up' "$picture"
expect 1 'did not compile or did not pass' '' "$tests"
rm "$bin/gnuplot"
expect 1 '`gnuplot` is not found' 'cmake --' "$tests"
rm "$bin/c++"
expect 1 'no C++ compiler is found' 'cmake --' "$picture"
stand_in cmake 'echo "cmake version 3.22.1"'
stand_in c++ ''
expect 1 'CMake 3.22 is found, 3.25 or newer is needed' '' "$picture"
rm "$bin/cmake"
expect 1 '`cmake` is not found' '' "$picture"

debian  # as root, on an image without sudo
expect 1 'apt-get update' 'sudo' "$picture"
expect 1 'installing g++ and' 'installing g++ cmake' "$picture"
expect 1 'apt-get update failed' 'apt-get install' env APT=100 "$picture"
stand_in dpkg-query 'echo -n installed'
expect 1 'all packages are present' 'apt-get ' "$picture"

debian  # as another user: with sudo, and without
expect 1 'packages missing: g++; only root' 'apt-get install' env USER_ID=1000 "$picture"
stand_in sudo 'echo "sudo $*"; "$@"'
expect 1 'sudo apt-get update' 'only root' env USER_ID=1000 "$picture"

rm -rf "$bin"
exit $failed
