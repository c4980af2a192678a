# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by examples/first_picture.sh, tests/run and .ci/run; `me` is the name they speak under.
me=${me:-${0##*/}}

say() { printf '%s: %s\n' "$me" "$*"; }
stop() {
  printf '%s: %s\n' "$me" "$*" >&2
  exit 1
}

# take_packages <Debian package>...: installs those that are missing, where that is possible. Where
# it is not (no apt-get, or neither root nor sudo), it names them and leaves the rest to need_tools.
take_packages() {
  if command -v apt-get >/dev/null; then
    local missing=() package as_root=()
    for package in "$@"; do
      [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
        missing+=("$package")
    done
    if [[ ${#missing[@]} == 0 ]]; then
      say "all packages are present"
      return
    fi
    if [[ $(id -u) != 0 ]]; then
      if ! command -v sudo >/dev/null; then
        say "packages missing: ${missing[*]}; only root can install them, and there is no sudo"
        return
      fi
      as_root=(sudo)
    fi
    say "installing ${missing[*]} and what they depend on (about 30 s)"
    "${as_root[@]}" apt-get update -qq -o Acquire::Retries=3 ||
      stop "apt-get update failed: is there a network, and may you install packages?"
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
      --no-install-recommends -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 "${missing[@]}" >/dev/null ||
      stop "apt-get could not install ${missing[*]}"
  else
    say "there is no apt-get here; the packages needed have these names on Debian: $*"
  fi
}

# need_tools <command>...: stops with a sentence where one is missing or CMake is too old.
need_tools() {
  local tool version
  for tool in "$@"; do
    command -v "$tool" >/dev/null || stop "\`$tool\` is not found; install it and try again"
  done
  [[ -n ${CXX:-} ]] || command -v c++ >/dev/null || command -v g++ >/dev/null ||
    command -v clang++ >/dev/null ||
    stop "no C++ compiler is found; install g++ 12 or clang++ 14, or newer, and try again"
  version=$(cmake --version | sed -n '1s/[^0-9]*\([0-9]*\.[0-9]*\).*/\1/p')
  if ((${version%.*} < 3 || (${version%.*} == 3 && ${version#*.} < 25))); then
    stop "CMake $version is found, 3.25 or newer is needed"
  fi
}
