#!/usr/bin/env bash
# device_headers.sh ROOT [NVCC]: every .cuh compiles by itself as device code, without a warning.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
if [ -z "${2:-}" ]; then
    echo "built without nvcc: device headers are not checked"
    exit "$skipped"
fi
tracked '*.cuh' | xargs -0 -r -I{} -P "$(nproc)" "$2" -std=c++20 --expt-relaxed-constexpr -arch=sm_90 \
    -Werror all-warnings -I. -include {} -x cu -ptx -o /dev/null /dev/null
