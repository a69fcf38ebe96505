#!/usr/bin/env bash
# tidy.sh ROOT BUILD NAME: clang-tidy finds no fault in the sources that BUILD/tidy/NAME.cpp includes, and in the
# headers that they include. Those are all sources of several folders (cmake/tidy.cmake): every check looks through all
# system headers, and this way it does so once.
# Tests are left out: gtest and RapidCheck in every file would take minutes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
require clang-tidy
# With a .clang-tidy that it cannot read, clang-tidy checks something else and ends as if all were well.
if unread=$(clang-tidy --dump-config 2>&1 >/dev/null | grep -B 1 -A 1 'error:'); then
    echo "$unread" >&2
    exit 1
fi
clang-tidy -quiet -p "$2" "$2/tidy/$3.cpp" 2> >(grep -v 'warnings generated' >&2)
! tracked '*.h' '*.cuh' '*.cpp' '*.cu' | xargs -0 grep -nE '^ *typedef ' # modernize-use-using
