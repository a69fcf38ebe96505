#!/usr/bin/env bash
# docs.sh ROOT: everything that the documents refer to exists: files, pictures, and names within files, written as
# `file`: `name`.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
status=0
complain() {
    echo "$1"
    status=1
}
# In a paragraph a reference may be broken over two lines.
while IFS= read -r -d '' document; do
    text=$(tr '\n' ' ' <"$document")
    while IFS='|' read -r file name; do
        [ -z "$file" ] && continue
        if [ ! -f "$file" ]; then complain "$document: there is no $file"
        elif ! grep -qwF -- "$name" "$file"; then complain "$document: $file has no $name"; fi
    done < <(grep -oE '`[A-Za-z0-9_./]+\.(h|cpp|cu|cuh)`: +`[A-Za-z0-9_:]+`' <<<"$text" |
        sed -E 's/`([^`]+)`: +`([^`]+)`/\1|\2/')
    while read -r file; do
        [ -e "$file" ] || complain "$document: there is no $file"
    done < <(grep -oE '`(ref|cuda|golden|images|scenes|trade|check|extremes|explain|cli|tests)/[A-Za-z0-9_./]+\.(h|cpp|cu|cuh|dae)`' <<<"$text" | tr -d '`')
    while read -r picture; do
        [ -f "$(dirname "$document")/$picture" ] || complain "$document: there is no picture $picture"
    done < <(grep -oE '\]\([A-Za-z0-9_./-]+\.(png|svg)\)' <<<"$text" | sed -E 's/\]\((.*)\)/\1/')
done < <(tracked '*.md')
exit "$status"
