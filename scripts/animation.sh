#!/usr/bin/env bash
# Films a run as its page shows it, twenty seconds: scripts/animation.sh RUN_DIR OUT.webp. Needs Node 20, chromium, ffmpeg.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
run=$1
out=$2
program=${CANOPEER:-$root/build/release/bin/canopeer}
folder=$(mktemp -d)
trap 'kill "${server:-}" 2>/dev/null || true; rm -rf "$folder"' EXIT
cp "$root"/web/browser/*.mjs "$root"/web/browser/package*.json "$folder/"
(cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
"$program" view "$run" --view-port 0 >"$folder/link" &
server=$!
until link=$(grep -om1 'http://127[^ ]*' "$folder/link"); do sleep 0.1; done
node "$folder/film.mjs" "$link" "$folder/pictures" 200
ffmpeg -loglevel error -y -framerate 10 -i "$folder/pictures/%04d.png" -vf scale=960:-2:flags=lanczos \
  -c:v libwebp_anim -lossless 0 -quality 70 -compression_level 6 -loop 0 "$out"
ls -l "$out"
