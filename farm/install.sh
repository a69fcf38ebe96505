#!/usr/bin/env bash
# install.sh FOLDER [jobqueue]: a virtual environment of Python in FOLDER with Dask, for ./run farm. jobqueue: with dask-jobqueue, for
# sites with SLURM, PBS and others.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
folder=$1
mkdir -p "$(dirname "$folder")"
for list in requirements ${2:+requirements-$2}; do
    cmp -s "$here/$list.txt" "$folder/$list.txt" && continue
    [ -x "$folder/bin/pip" ] || python3 -m venv --clear "$folder"
    echo "Installing $(tr '\n' ' ' <"$here/$list.txt")into $folder" >&2
    "$folder/bin/pip" install -q --disable-pip-version-check -r "$here/$list.txt" 2>"$folder.log" ||
        { echo "$here/$list.txt: cannot be installed: $(tail -n 1 "$folder.log")" >&2; exit 2; }
    cp "$here/$list.txt" "$folder/$list.txt"
done
