#!/usr/bin/env bash
# worker.sh ADDRESS [option of `dask worker`...]: a worker of ./run farm --scheduler ADDRESS. It runs one task at a time, and the program
# in it uses all processors (or those of -t). It begins again when the scheduler was restarted, until it is ended.
set -euo pipefail
[ $# -ge 1 ] || { echo "Usage: farm/worker.sh tcp://HOST:8786 [option of dask worker...]" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export DASK_CONFIG=${DASK_CONFIG:-$here/dask.yaml}
dask=${DASK:-$here/../build/farm/venv/bin/dask}
trap 'kill "$child" 2>/dev/null; wait; exit 0' TERM INT
while :; do
    # Without a nanny: this loop is one.
    "$dask" worker "$1" --nthreads 1 --no-nanny --no-dashboard --memory-limit 0 --death-timeout 60 "${@:2}" &
    child=$!
    wait "$child" || true
    sleep 2 &
    child=$!
    wait "$child" || true
done
