#!/usr/bin/env bash
# tidy.sh ROOT BUILD: clang-tidy finds nothing in the sources of the library and the program, nor in the
# headers that they include. Tests are left out: gtest and RapidCheck in every file would take minutes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
build=$2
cd "$1"
require clang-tidy
# The longest first, so that no processor is idle at the end.
tracked 'cli/*.cpp' 'golden/*.cpp' 'ref/*.cpp' 'scenes/*.cpp' 'cuda/*.cpp' | tr '\0' '\n' |
    while read -r file; do
        # What this configuration does not compile (device_none.cpp beside nvcc) has no command line.
        if grep -qF "/$file\"" "$build/compile_commands.json"; then echo "$file"; fi
    done |
    xargs -n 1 -P "$(nproc)" clang-tidy -quiet -p "$build" 2> >(grep -v 'warnings generated' >&2)
