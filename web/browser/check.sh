#!/usr/bin/env bash
# Looks at a replay and steers a live run in a real browser: web/browser/check.sh PROGRAM FOLDER. Makes both runs in FOLDER.
# Ends with 77 where it was not asked for (CANOPEER_BROWSER=1), or where the browser, Node 20 or the npm registry is missing, with
# a word on which.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=$1
folder=$2
skip() {
  echo "skipped: $1"
  exit 77
}
[ "${CANOPEER_BROWSER:-}" = 1 ] || skip "a busy machine may fail it; CANOPEER_BROWSER=1 asks for it"
grep -q 'live view *built in' <<<"$("$program" doctor --quick)" || skip "the program was built without its page"
[ "$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null || echo 0)" -ge 20 ] || skip "Node 20 or newer is missing"
[ -x /usr/bin/chromium ] || [ -x /usr/bin/chromium-browser ] || [ -x /usr/bin/google-chrome ] || skip "Chromium is missing (apt-get install chromium)"

mkdir -p "$folder"
cp "$here"/*.mjs "$here"/package.json "$here"/package-lock.json "$folder/"
if ! cmp -s "$here/package-lock.json" "$folder/fetched"; then
  (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1 --fetch-timeout=20000 >npm.log 2>&1) ||
    skip "npm could not fetch what drives the browser ($folder/npm.log)"
  cp "$here/package-lock.json" "$folder/fetched"
fi

server=
trap '[ -z "$server" ] || kill "$server" 2>/dev/null || true' EXIT
# Starts a command that serves a page, and waits for its link.
serve() {
  : >"$folder/link"
  "$@" >"$folder/link" 2>&1 &
  server=$!
  for _ in $(seq 300); do
    link=$(grep -om1 'http://127[^ ]*' "$folder/link" || true)
    [ -z "$link" ] || return 0
    sleep 0.1
  done
  cat "$folder/link"
  return 1
}

"$program" run smoke --quiet --time-per-segment 8 --set frames.on_the_way_hz=5 --out "$folder/run"
serve "$program" view "$folder/run" --view-port 0
node "$folder/replay.mjs" "$link"
kill "$server"
wait "$server" || true

server=
node "$folder/back.mjs" "$program" "$folder/run"

serve "$program" run scenario_1 --time-per-segment 600 --view --view-port 0 --out "$folder/live"
node "$folder/live.mjs" "$link"
wait "$server" || [ $? -eq 130 ]
server=
