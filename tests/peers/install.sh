#!/usr/bin/env bash
# install.sh FOLDER: a virtual environment of Python in FOLDER with the renderers that ./run peers measures and whose pictures ./run
# conformance judges, and with Pillow, which writes that one's sheet of pictures. One that cannot be installed is reported in
# one line; the others are used without it.
set -euo pipefail
folder=$1
mkdir -p "$(dirname "$folder")"
[ -x "$folder/bin/python" ] || python3 -m venv "$folder"
# The versions that the scenes and options are written for.
for package in "mitsuba~=3.9.1" "pyluxcore~=2.11.2" "pillow"; do
    name=${package%%~*}
    "$folder/bin/pip" show -q "$name" 2>/dev/null && continue
    echo "Installing $package into $folder" >&2
    "$folder/bin/pip" install -q --disable-pip-version-check "$package" numpy 2>"$folder.log" ||
        echo "$name: cannot be installed: $(tail -n 1 "$folder.log")" >&2
done
