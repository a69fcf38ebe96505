#!/usr/bin/env bash
# paths.sh ROOT: no file names a path that exists on one machine only, such as a home folder.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
found=$(tracked '*' | xargs -0 -r grep -nIE '(^|[^A-Za-z0-9_./-])/(home|root|work|mnt|srv|Users)/[A-Za-z0-9_.]' || true)
[ -z "$found" ] && exit 0
echo "$found"
exit 1
