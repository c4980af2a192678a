#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What including the headers costs: time of the compiler's own process (user seconds, best of three, or of REPEATS)
# its peak memory, and the code it makes (`size`, text). The floor is what the headers stand on; `-fsyntax-only` is what every file
# pays, `-O2 -c` a whole small program. For another checkout: bench/compile_table.sh FOLDER
set -euo pipefail
project=$(cd "$(dirname "$0")/.." && pwd)
checkout=${1:-$project}
compiler=${CXX:-g++}
[[ -d $checkout/include/voussoir ]] || { echo "compile_table: no headers in '$checkout'"; exit 1; }
[[ -x /usr/bin/time ]] || { echo "compile_table: needs GNU time (Debian: apt-get install time)"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
flags=(-std=c++20 -DNDEBUG "-I$checkout/include" -isystem "${EIGEN:-/usr/include/eigen3}")

row() {  # row NAME ARGUMENTS...
  local name=$1 best="" line
  shift
  for ((k = 0; k < ${REPEATS:-3}; ++k)); do
    rm -f "$folder/file.o"
    if ! line=$(/usr/bin/time -f '%U %M' "$compiler" "${flags[@]}" "$@" 2>&1 | tail -n 1); then
      printf '| %s | does not compile | | |\n' "$name"
      return
    fi
    best=$(printf '%s\n%s\n' "$best" "$line" | grep . | sort -n | head -n 1)
  done
  local code=""
  [[ -f $folder/file.o ]] && code=$(size "$folder/file.o" | awk 'NR == 2 { print int($1 / 1000) }')
  printf '| %s | %.1f | %d | %s |\n' "$name" "${best% *}" $((${best#* } / 1024)) "$code"
}
including() {  # including HEADER...: a file that includes them
  printf '#include <%s>\n' "$@" >"$folder/file.cpp"
  echo "$folder/file.cpp"
}

printf '| %s, one file | s | MB | kB of code |\n| --- | --- | --- | --- |\n' "$compiler"
row 'floor: Eigen/Core' -fsyntax-only "$(including Eigen/Core)"
row 'voussoir.hpp' -fsyntax-only "$(including voussoir/voussoir.hpp)"
for header in tunnel/measurements solver/solver dynamics/dynamics; do
  row "$header.hpp" -fsyntax-only "$(including "voussoir/$header.hpp")"
done
row 'contact detection alone, 2-D and 3-D' -fsyntax-only \
  "$(including voussoir/geometry/{planar,spatial}.hpp voussoir/detection/face_contacts.hpp)"
row 'examples/minimal.cpp, -O2' -O2 -c "$checkout/examples/minimal.cpp" -o "$folder/file.o"
if [[ -f $checkout/include/voussoir/solver/compiled.hpp ]]; then
  row 'the same with voussoir::compiled' -DVOUSSOIR_COMPILED=1 -O2 -c \
    "$checkout/examples/minimal.cpp" -o "$folder/file.o"
  for unit in examples/custom_joint_law tests/rules/own_law; do
    row "$unit.cpp, -O2, with voussoir::compiled" -DVOUSSOIR_COMPILED=1 -O2 -c \
      "$project/$unit.cpp" -o "$folder/file.o"
  done
fi
