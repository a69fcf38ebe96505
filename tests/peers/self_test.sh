#!/usr/bin/env bash
# self_test.sh: the tests of ./run peers that need no other renderer.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=../lint/files.sh
source "$here/../lint/files.sh"
require python3
python3 -B -m unittest discover --start-directory "$here" --pattern '*_test.py'
