#!/usr/bin/env bash
# instruction_sets.sh BUILD NM: the kernels of one instruction set show the linker nothing but their functions
# plumbline_kernels_SET_..., by the program nm. A function that several files emit must not be among them: the linker
# keeps one copy for the whole program, and that one may have instructions that the processor lacks
# (cmake/instruction_sets.cmake).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
build=$1 nm=$2
require "$nm"
shopt -s nullglob
objects=("$build"/cuda/plumbline_cuda_*.o)
[ ${#objects[@]} -gt 0 ] || { echo "SKIPPED: no kernels in $build/cuda: they are not built"; exit "$skipped"; }
status=0
for object in "${objects[@]}"; do
    name=$(basename "$object" .o)
    prefix=plumbline_kernels_${name#plumbline_cuda_}_
    symbols=$("$nm" --extern-only --defined-only --format=posix "$object" | cut -d ' ' -f 1)
    others=$(grep -v "^$prefix" <<<"$symbols" || true)
    if [ -z "$symbols" ]; then
        echo "$object: no function $prefix... is visible to other files"
        status=1
    elif [ -n "$others" ]; then
        echo "$object: visible to other files without the name $prefix...:"
        sed 's/^/    /' <<<"$others"
        status=1
    fi
done
exit "$status"
