# shellcheck shell=bash
# Sourced by the checks beside it, in the folder to be checked: lists files, and distinguishes skips from passes.

skipped=77 # CTest's SKIP_RETURN_CODE

# tracked PATTERN...: the files of the repository that match, zero-terminated. Without a repository (an
# unpacked archive) all files except built ones.
tracked() {
    if [ -e .git ]; then
        git -c safe.directory='*' ls-files -z -- "$@" | while IFS= read -r -d '' file; do
            if [ -f "$file" ]; then printf '%s\0' "$file"; fi
        done
    else
        local names=() pattern
        for pattern in "$@"; do names+=(-o -path "./$pattern"); done
        find . \( -path ./build -o -path ./out \) -prune -o -type f \( "${names[@]:1}" \) -printf '%P\0'
    fi
}

# require TOOL: ends the check as skipped if the tool is missing.
require() {
    command -v "$1" >/dev/null && return
    echo "SKIPPED: $1 is not installed (./run test installs it)"
    exit "$skipped"
}
