#!/usr/bin/env bash
# tidy.sh ROOT BUILD: clang-tidy finds no fault in the sources of the libraries and the program, and in the
# headers that they include. Tests are left out: gtest and RapidCheck in every file would take minutes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
build=$2
cd "$1"
require clang-tidy
# One file per folder that includes all its sources (cmake/tidy.cmake): every check looks
# through all system headers, and this way it does so once per folder.
shopt -s nullglob
folders=("$build"/tidy/*.cpp)
[ ${#folders[@]} -gt 0 ] || { echo "no files in $build/tidy: was CMake run?"; exit 1; }
ls -S "${folders[@]}" | xargs -n 1 -P "$(nproc)" clang-tidy -quiet -p "$build" 2> >(grep -v 'warnings generated' >&2)
