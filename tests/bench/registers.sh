#!/usr/bin/env bash
# registers.sh [FILE.cu...]: registers, stack, spills and occupancy of every kernel of ours, from the compiler's
# report for sm_90. Occupancy: of 2048 threads of a multiprocessor with 65,536 registers, in blocks of 256.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ $# -gt 0 ] || set -- cuda/launch/device_lbvh.cu
report() {
    "${CUDACXX:-nvcc}" -std=c++20 -arch=sm_90 --expt-relaxed-constexpr --fmad=false -I. -Xptxas -v -cubin \
        -o /dev/null "$1" 2>&1 | c++filt
}
echo "| kernel | registers | stack bytes | spilled bytes (stores, loads) | occupancy |"
echo "|---|---|---|---|---|"
for file in "$@"; do
    [ $# -eq 1 ] || echo "| **$file** | | | | |"
    report "$file" | awk '
    /Compiling entry function/ { kernel = ""; if (match($0, /run_kernel<.*>\(/)) kernel = substr($0, RSTART + 11, RLENGTH - 13); sub(/ $/, "", kernel) }
    /stack frame/ { stack = $1; stores = $5; loads = $9 }
    /Used [0-9]+ registers/ && kernel != "" {
        match($0, /Used [0-9]+/); registers = substr($0, RSTART + 5, RLENGTH - 5)
        granted = int((registers + 7) / 8) * 8       # registers are given out by eights
        threads = int(65536 / (granted * 256)) * 256
        if (threads > 2048) threads = 2048
        gsub(/fast::/, "", kernel)
        # Numbers of enumerators, and the Needs that kernels are compiled for (cuda/transport/needs.h), as words.
        gsub(/Needs\{false, false, false, false\}/, "no needs", kernel)
        gsub(/Needs\{true, true, false, false\}/, "spheres, specular", kernel)
        gsub(/Needs\{true, true, true, true\}/, "all needs", kernel)
        gsub(/\(images::Integrator\)0/, "path", kernel)
        gsub(/\(images::Integrator\)1/, "bdpt", kernel)
        gsub(/\(images::Integrator\)2/, "light", kernel)
        gsub(/\(Part\)0/, "whole", kernel); gsub(/\(Part\)1/, "bounce", kernel); gsub(/\(Part\)2/, "joins", kernel)
        printf "| `%s` | %d | %d | %d, %d | %d%% |\n", kernel, registers, stack, stores, loads, 100 * threads / 2048
    }' | sort -u
done
