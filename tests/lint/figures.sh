#!/usr/bin/env bash
# figures.sh ROOT: exactly one entry of docs/figures/figures.toml draws each picture of docs/images/, a page shows it, and
# no page shows a picture that is missing. Nothing is drawn.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
require python3
exec python3 -B "$1/docs/figures/figures.py" --table --root "$1"
