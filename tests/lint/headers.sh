#!/usr/bin/env bash
# headers.sh ROOT COMPILER: every header compiles by itself. If it has a source file, that file proves this
# by including the header first; only headers without a source file are compiled here.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
alone=()
failed=0
while IFS= read -r -d '' header; do
    source=${header%.h}.cpp
    if [ ! -f "$source" ]; then
        alone+=("$header")
    elif [ "$(grep -m1 '^#include' "$source")" != "#include \"$header\"" ]; then
        echo "$source: its first include must be \"$header\""
        failed=1
    fi
done < <(tracked 'cli/*.h' 'golden/*.h' 'images/*.h' 'ref/*.h' 'scenes/*.h' 'cuda/*.h')
printf '%s\0' "${alone[@]}" |
    xargs -0 -r -I{} -P "$(nproc)" "$2" -std=c++20 -fsyntax-only -Wall -Wextra -I. -include {} -x c++ /dev/null || failed=1
exit $failed
