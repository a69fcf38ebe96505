#!/usr/bin/env bash
# programs.sh ROOT COMPILER FILE...: the programs that only some words of ./run build compile still. Their syntax and
# names are checked, nothing is linked.
set -euo pipefail
cd "$1"
printf '%s\0' "${@:3}" | xargs -0 -I{} -P "$(nproc)" "$2" -std=c++20 -fsyntax-only -Wall -Wextra -I. \
    -DPLUMBLINE_SOURCE_DIR='""' {}
