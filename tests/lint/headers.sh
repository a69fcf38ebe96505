#!/usr/bin/env bash
# headers.sh ROOT COMPILER: every header compiles by itself. A file that begins by including a header proves this for
# it, because the compiler has seen nothing before it, and so on if that header begins with another. Source files must
# begin with their own header. So only those headers are compiled here that neither a source file nor another
# header begins with. (Where sources are compiled in batches, only the first of a batch is a proof.)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
files=()
vectors=() # headers of vectors of floats: cuda/parallel/floats.h and what is made of it
failed=0
while IFS= read -r -d '' header; do
    case ${header##*/} in floats.h | floats_*.h) vectors+=("$header") && continue ;; esac
    files+=("$header")
    source=${header%.h}.cpp
    [ -f "$source" ] || continue
    files+=("$source")
    if [ "$(grep -m1 '^#include' "$source")" != "#include \"$header\"" ]; then
        echo "$source: its first include must be \"$header\""
        failed=1
    fi
done < <(tracked 'cli/*.h' 'golden/*.h' 'images/*.h' 'ref/*.h' 'scenes/*.h' 'trade/*.h' 'check/*.h' 'extremes/*.h' 'cuda/*.h')
# Vectors need the instructions of AVX2, as in cmake/instruction_sets.cmake. Each is compiled, and is no proof for others.
if [ ${#vectors[@]} -gt 0 ]; then
    case $("$2" -dumpmachine) in
    x86_64-*)
        printf '%s\0' "${vectors[@]}" | xargs -0 -I{} -P "$(nproc)" "$2" -std=c++20 -march=x86-64-v3 -maes -mpclmul \
            -fsyntax-only -Wall -Wextra -I. -include {} -x c++ /dev/null || failed=1
        ;;
    *)
        echo "SKIPPED: not for x86-64, so not compiled: ${vectors[*]}"
        without_vectors=$skipped
        ;;
    esac
fi
[ ${#files[@]} -eq 0 ] && exit $((failed ? failed : ${without_vectors:-0}))
# begins[A] = B: before A's #include "B" there are only comments and #pragma once.
awk '
    FNR == 1 { before = 1; if (FILENAME ~ /\.h$/) headers[FILENAME]; else sources[FILENAME] }
    !before || /^(\/\/.*|#pragma once)?$/ { next }
    { before = 0 }
    /^#include "[^"]+"$/ { split($0, quoted, "\""); begins[FILENAME] = quoted[2]; preceded[quoted[2]] }
    function prove(file) {
        for (; !(file in proved); file = begins[file]) {
            proved[file]
            if (!(file in begins)) break
        }
    }
    function compile(file) {
        printf "%s%c", file, 0
        prove(file)
    }
    END {
        for (file in sources) prove(file)
        for (file in headers) if (!(file in preceded)) compile(file)
        for (file in headers) if (!(file in proved)) compile(file) # those that begin with one another in a circle
    }' "${files[@]}" |
    xargs -0 -r -I{} -P "$(nproc)" "$2" -std=c++20 -fsyntax-only -Wall -Wextra -I. -include {} -x c++ /dev/null || failed=1
exit $((failed ? failed : ${without_vectors:-0}))
