# shellcheck shell=bash
# Sourced before the commands of figures.toml.

# screenshot URL PICTURE [WIDTH,HEIGHT]: draws a page, as a window of this size shows it, into a .png
screenshot() {
    chromium --headless --no-sandbox --disable-gpu --force-device-scale-factor=1 --user-data-dir="$scratch/chromium" \
        --window-size="${3:-1000,640}" --screenshot="$2" "$1" 2>"$scratch/chromium.log"
    [ -s "$2" ] || { tail -n 1 "$scratch/chromium.log" >&2; return 1; }
}
