#!/usr/bin/env bash
# build.sh CMAKE PREFIX BUILD COMPILER NVCC: configures and builds the examples that are installed in PREFIX. NVCC may be
# empty. Always from the beginning: a package that has lost a file must not be hidden by an earlier build.
set -euo pipefail
cmake=$1 prefix=$2 build=$3 compiler=$4 nvcc=${5:-}
rm -rf "$build"
"$cmake" -S "$prefix/share/plumbline/examples" -B "$build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_CUDA_COMPILER="${nvcc:-NOTFOUND}"
"$cmake" --build "$build" -j 2
