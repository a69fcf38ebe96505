#!/usr/bin/env bash
# make.sh [--check|--serve]: the book, from docs/ into out/book/. --check: every warning is an error, and check.py looks at
# each page. --serve: shows it at a port of this machine, and follows changes. Sets up MkDocs in build/book/venv.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
case "${1:-}" in
    --check | --serve | "") ;;
    *) echo "Usage: ./run book [--check|--serve]" >&2; exit 2 ;;
esac
venv=build/book/venv
if ! cmp -s docs/book/requirements.txt "$venv/installed.txt"; then
    python3 -m venv --clear "$venv"
    "$venv/bin/pip" install -q --disable-pip-version-check -r docs/book/requirements.txt
    cp docs/book/requirements.txt "$venv/installed.txt"
fi
export NO_MKDOCS_2_WARNING=true PYTHONDONTWRITEBYTECODE=1
case "${1:-}" in
    --serve) exec "$venv/bin/mkdocs" serve ;;
    --check)
        "$venv/bin/mkdocs" build --strict
        "$venv/bin/python" docs/book/check.py out/book ;;
    *) "$venv/bin/mkdocs" build ;;
esac
echo "The book: $PWD/out/book/index.html"
