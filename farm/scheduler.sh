#!/usr/bin/env bash
# scheduler.sh [option of `dask scheduler`...]: a scheduler for ./run farm --scheduler, with the settings of dask.yaml. It has no
# password: start it only where the network is trusted (docs/farm.md).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export DASK_CONFIG=${DASK_CONFIG:-$here/dask.yaml}
exec "${DASK:-$here/../build/farm/venv/bin/dask}" scheduler --no-dashboard "$@"
