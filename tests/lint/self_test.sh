#!/usr/bin/env bash
# self_test.sh: the checks beside this file fail on the faults that they must find, and pass correct files.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root"/{ref/trees,cuda/trees,scenes,images,golden,trade,check,extremes,cli,tests}
failures=0

# expect pass|fail CHECK FILE CONTENT: CHECK on a tree that holds only this file
expect() {
    printf '%s\n' "$4" >"$root/$3"
    local verdict=pass
    bash "$here/$2" "$root" c++ >/dev/null 2>&1 || verdict=fail
    if [ "$verdict" != "$1" ]; then
        echo "$2 should $1 on $3 with: $4"
        failures=$((failures + 1))
    fi
    rm "$root/$3"
}

expect pass includes.sh ref/trees/a.h '#include "scenes/scene.h"'
expect pass includes.sh cuda/trees/a.cuh '#include "cuda/launch/device.h"'
expect pass includes.sh tests/a.cpp '#include "ref/trees/ray.h"'
expect fail includes.sh ref/trees/a.h '#include "cuda/launch/device.h"'
expect fail includes.sh cuda/trees/a.cu '# include "ref/trees/ray.h"'
expect fail includes.sh scenes/a.h '#include "images/image.h"'
expect fail includes.sh golden/a.h '#include "scenes/scene.h"'
expect pass includes.sh golden/a.h '#include "images/image.h"'
expect pass includes.sh trade/a.h '#include "golden/statistics.h"'
expect fail includes.sh trade/a.h '#include "ref/trees/ray.h"'
expect fail includes.sh golden/a.h '#include "trade/page.h"'
expect pass includes.sh extremes/a.cpp '#include "ref/trees/ray.h"'
expect pass includes.sh extremes/a.cpp '#include "cuda/trees/ray.h"'
expect fail includes.sh extremes/a.h '#include "cli/command.h"'
expect fail includes.sh ref/a.h '#include "extremes/axis.h"'
expect pass includes.sh check/a.cpp '#include "golden/golden.h"'
expect fail includes.sh check/a.h '#include "cli/command.h"'
expect fail includes.sh images/a.h '#include "golden/golden.h"'
expect fail includes.sh ref/a.h '#include "golden/golden.h"'
expect fail includes.sh ref/trees/a.cpp '#include "cli/command.h"'
expect fail includes.sh ref/trees/a.cpp '#include "../../cuda/launch/device.h"'
expect fail includes.sh ref/trees/a.cpp '#include "ray.h"'
expect fail includes.sh cli/a.cpp '#include "tests/a.h"'
somebody=/home
expect fail paths.sh cli/a.cpp "// see $somebody/me/notes"
expect fail paths.sh tests/a.txt "\"$somebody/me\""
expect pass paths.sh tests/a.txt "https://example.org$somebody/page"
expect pass headers.sh golden/a.h 'inline int f() { return 1; }'
expect fail headers.sh golden/a.h 'std::string f();'
printf '#include <string>\n#include "golden/a.h"\n' >"$root/golden/a.cpp"
expect fail headers.sh golden/a.h 'std::string f();'
rm "$root/golden/a.cpp"
# Another header is no proof if anything comes before its #include, and nor are two that begin with each other.
for before in '#include <string>' '#define GIVEN'; do
    printf '%s\n#include "golden/a.h"\n' "$before" >"$root/golden/b.h"
    expect fail headers.sh golden/a.h $'#ifndef GIVEN\nstd::string f();\n#endif'
done
printf '// A comment.\n#pragma once\n\n#include "golden/a.h"\n' >"$root/golden/b.h"
expect pass headers.sh golden/a.h 'inline int f() { return 1; }'
expect fail headers.sh golden/a.h 'std::string f();'
expect pass headers.sh golden/a.h $'#pragma once\n#include "golden/b.h"'
expect fail headers.sh golden/a.h $'#pragma once\n#include "golden/b.h"\nstd::string f();'
rm "$root/golden/b.h"
# The program to compile is named.
printf 'int main() { return 0; }\n' >"$root/tests/a.cpp"
bash "$here/programs.sh" "$root" c++ tests/a.cpp >/dev/null 2>&1 || { echo 'programs.sh should pass'; failures=$((failures + 1)); }
printf 'int main() { return f(); }\n' >"$root/tests/a.cpp"
! bash "$here/programs.sh" "$root" c++ tests/a.cpp >/dev/null 2>&1 || { echo 'programs.sh should fail'; failures=$((failures + 1)); }
rm "$root/tests/a.cpp"
if command -v clang-format >/dev/null; then
    expect pass format.sh golden/a.h 'int f();'
    expect fail format.sh golden/a.h 'int   f( ) ;'
fi
if command -v clang-tidy >/dev/null; then
    # expect_tidy VERDICT CONFIGURATION CONTENT: tidy.sh on one file of this content
    expect_tidy() {
        local verdict=pass
        printf '%s\n' "$2" >"$root/.clang-tidy"
        printf '%s\n' "$3" >"$root/tidy/a.cpp"
        bash "$here/tidy.sh" "$root" "$root" a >/dev/null 2>&1 || verdict=fail
        if [ "$verdict" != "$1" ]; then
            echo "tidy.sh should $1 with the configuration: $2, on: $3"
            failures=$((failures + 1))
        fi
    }
    mkdir "$root/tidy"
    printf '[{"directory": "%s", "file": "tidy/a.cpp", "command": "c++ -c tidy/a.cpp"}]\n' "$root" >"$root/compile_commands.json"
    checked=$'Checks: "-*,modernize-use-nullptr"\nWarningsAsErrors: "*"'
    expect_tidy pass "$checked" 'int* p = nullptr;'
    expect_tidy fail "$checked" 'int* p = 0;'
    expect_tidy fail "no comment"$'\n'"$checked" 'int* p = nullptr;'
    expect_tidy fail "$checked" 'typedef int number;'
    rm -r "$root/tidy" "$root/compile_commands.json" "$root/.clang-tidy"
fi
if command -v nvcc >/dev/null; then
    # Its own compiler instead of the c++ that expect passes.
    printf '#pragma once\n__device__ inline int f() { return threadIdx.x; }\n' >"$root/cuda/a.cuh"
    bash "$here/device_headers.sh" "$root" nvcc >/dev/null 2>&1 || { echo 'device_headers.sh should pass'; failures=$((failures + 1)); }
    printf '#pragma once\n__device__ std::string f();\n' >"$root/cuda/a.cuh"
    ! bash "$here/device_headers.sh" "$root" nvcc >/dev/null 2>&1 || { echo 'device_headers.sh should fail'; failures=$((failures + 1)); }
    rm "$root/cuda/a.cuh"
fi
# expect_kernels VERDICT WHAT: instruction_sets.sh on the file of one instruction set
expect_kernels() {
    local verdict=pass
    bash "$here/instruction_sets.sh" "$root" nm >/dev/null 2>&1 || verdict="status $?"
    if [ "$verdict" != "$1" ]; then
        echo "instruction_sets.sh should give \"$1\" for $2, not \"$verdict\""
        failures=$((failures + 1))
    fi
}
kernels=$root/cuda/plumbline_cuda_avx2.o
expect_kernels 'status 77' 'a build without kernels'
echo 'inline int in_many_files() { return 1; } extern "C" int plumbline_kernels_avx2_path() { return in_many_files(); }' |
    c++ -O0 -x c++ -c -o "$kernels.all" -
cp "$kernels.all" "$kernels"
expect_kernels 'status 1' 'an inline function that is a weak symbol'
objcopy --wildcard --keep-global-symbol='plumbline_kernels_avx2_*' "$kernels.all" "$kernels"
expect_kernels pass 'an inline function that is a local symbol'
objcopy --globalize-symbol=_Z13in_many_filesv "$kernels"
expect_kernels 'status 1' 'an inline function that is a global symbol'
objcopy --wildcard --keep-global-symbol='nothing' "$kernels.all" "$kernels"
expect_kernels 'status 1' 'kernels that are not visible'
rm "$kernels"
objcopy --wildcard --keep-global-symbol='plumbline_kernels_avx2_*' "$kernels.all" "$root/cuda/plumbline_cuda_avx512.o"
expect_kernels 'status 1' 'the name of another instruction set'
rm "$root"/cuda/plumbline_cuda_*
exit $((failures > 0))
