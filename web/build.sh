#!/usr/bin/env bash
# Makes the page of the live view: web/build.sh PAGE.html FOLDER. What it is made with is fetched into FOLDER, once for each
# package-lock.json. Where that fails the page is empty, which leaves it out of the program.
set -euo pipefail
web=$(cd "$(dirname "$0")" && pwd)
page=$1
folder=$2
mkdir -p "$folder"
leave_out() {
  echo "The live view is left out: $1" >&2
  echo "To try again: rm $page" >&2
  : >"$page"
  exit 0
}
[ "$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null || echo 0)" -ge 18 ] || leave_out "its page needs Node 18 or newer"
if ! cmp -s "$web/package-lock.json" "$folder/fetched"; then
  cp "$web/package.json" "$web/package-lock.json" "$folder/"
  (cd "$folder" && npm ci --omit=dev --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1 --fetch-timeout=20000 >npm.log 2>&1) ||
    leave_out "npm could not fetch what its page is made with ($folder/npm.log)"
  cp "$web/package-lock.json" "$folder/fetched"
fi
exec node "$web/build.mjs" "$page" "$folder/node_modules" >/dev/null
