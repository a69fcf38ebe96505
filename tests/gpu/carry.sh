#!/usr/bin/env bash
# carry.sh [-o FILE.tar.gz] [--build FOLDER]: makes what day.sh needs on a machine with a GPU. Without --build it builds
# the preset cuda first (nvcc, sm_90). The archive holds the programs, the shared libraries that a machine with a
# compiler may still lack (in FOLDER/lib, which day.sh adds to LD_LIBRARY_PATH), scenes, goldens and tests/gpu.
set -euo pipefail
die() { echo "carry.sh: $1" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
archive=$root/out/gpu_carry.tar.gz
build=
while [ $# -gt 0 ]; do
    case $1 in
    -o | --build) [ $# -ge 2 ] || die "$1 needs a value" ;;&
    -o) archive=$(realpath -m "$2") && shift 2 ;;
    --build) build=$(realpath -m "$2") && shift 2 ;;
    *) die "expected [-o FILE.tar.gz] [--build FOLDER], not $1" ;;
    esac
done
cd "$root"
programs=(plumbline tests/test_cuda tests/test_renders tests/test_extremes)
if [ -z "$build" ]; then
    build=$root/build/cuda
    cmake --preset cuda -DPLUMBLINE_TESTS=ON
    for program in "${programs[@]}"; do cmake --build "$build" --target "${program##*/}" -j "$(nproc)"; done
fi
for program in "${programs[@]}"; do [ -x "$build/$program" ] || die "$build lacks $program"; done

staged=$(mktemp -d)
trap 'rm -rf "$staged"' EXIT
place=$staged/plumbline/build/cuda
mkdir -p "$place/tests" "$place/lib" "$staged/plumbline/golden" "$staged/plumbline/tests" "$(dirname "$archive")"
for program in "${programs[@]}"; do cp "$build/$program" "$place/$program"; done
if [ -f "$build/CMakeCache.txt" ]; then cp "$build/CMakeCache.txt" "$place"; fi
# The C and C++ libraries and the loader must be the machine's own.
ldd "${programs[@]/#/$build/}" |
    awk '$2 == "=>" && $3 ~ /^\// && $1 !~ /^(libc|libm|libdl|librt|libpthread|libstdc[+][+]|libgcc_s)[.]so/ { print $3 }' |
    sort -u | xargs -r cp -L -t "$place/lib"
mkdir "$staged/plumbline/scenes"
cp scenes/*.dae "$staged/plumbline/scenes"
cp -r golden/renders "$staged/plumbline/golden"
cp -r tests/gpu "$staged/plumbline/tests"
tar -C "$staged" -c plumbline | gzip -1 >"$archive" # the goldens are compressed already
echo "$archive ($(du -h "$archive" | cut -f1)): unpack it there and run plumbline/tests/gpu/day.sh"
