#!/usr/bin/env bash
# day.sh --help: everything to be done on a machine with a GPU, in under 10 minutes, from a build made elsewhere
# (carry.sh). The work is in day.py; this adds the folder of the CUDA tools to the PATH.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
command -v python3 >/dev/null || { echo "day.sh: python3 is not installed" >&2; exit 2; }
export PATH="$PATH:${CUDA_HOME:-/usr/local/cuda}/bin"
exec python3 -B "$here/day.py" "$@"
