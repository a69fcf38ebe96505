#!/usr/bin/env bash
# format.sh ROOT: every C++ file is laid out as .clang-format says.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
require clang-format
tracked '*.h' '*.cpp' '*.cu' '*.cuh' | xargs -0 -r -n 20 -P "$(nproc)" clang-format --dry-run -Werror
