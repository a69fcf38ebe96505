#!/usr/bin/env bash
# python.sh SCRIPT ARGUMENT...: the check in SCRIPT, which is beside this file and in Python.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/files.sh"
require python3
python3 -c 'import tomllib' 2>/dev/null || {
    echo "SKIPPED: python3 is older than 3.11, which reads TOML"
    exit "$skipped"
}
exec python3 -B "$here/$1" "${@:2}"
