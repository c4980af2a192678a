#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a bare machine to the first picture: packages, the program `voussoir`, the design case of
# Boon, Houlsby and Utili (2015) and its interaction diagram. May be run again; works from any folder.
set -euo pipefail
cd "$(dirname "$0")/.." || exit 1
# shellcheck source=SCRIPTDIR/../cmake/packages.sh
source cmake/packages.sh

say "builds the program in build/program and writes the design case and its diagram to results;"
say "two to three minutes on two cores, packages included; some seconds when it has run before"
take_packages g++ cmake make libeigen3-dev libboost-dev libcli11-dev libtomlplusplus-dev \
  nlohmann-json3-dev
need_tools cmake

say "building the program (about two minutes the first time)"
cmake --preset program || stop "CMake could not set up the build; its message stands above"
cmake --build --preset program || stop "the program did not compile; the message stands above"

program=build/program/voussoir
input=examples/paper/tunnel.toml
say "one tunnel with bolts and lining (a second): $program run $input --out results"
"$program" run "$input" --out results || stop "the design case did not end well (exit status $?)"
say "its interaction diagram, 36 tunnels (half a minute): $program diagram $input --out results"
"$program" diagram "$input" --out results || stop "the diagram did not end well (exit status $?)"
say "both as one page: $program report results"
"$program" report results || stop "the report did not end well (exit status $?)"

say "the report and the pictures, to be opened in a browser:"
for picture in results/report.html results/*.svg; do printf '  %s\n' "$PWD/$picture"; done
