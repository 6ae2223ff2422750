#!/usr/bin/env bash
# The head of a page as a picture; that of share/doc/evaluation.md is the demo's (needs the package chromium).
#   share/page-still.sh [page] [picture]     default: out/demo/page.html share/pictures/evaluation.png
set -euo pipefail
cd "$(dirname "$0")/.."
page=$(realpath "${1:-out/demo/page.html}")
picture=$(realpath "${2:-share/pictures/evaluation.png}")
chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --blink-settings=preferredColorScheme=1 \
  --window-size=1008,1500 --screenshot="$picture" "file://$page"
