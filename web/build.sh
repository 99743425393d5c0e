#!/usr/bin/env bash
# Makes the page of the live view: web/build.sh PAGE.html FOLDER. What it is made with is fetched into FOLDER, once for each
# package-lock.json. Where that fails the page is empty, which leaves it out of the program.
set -euo pipefail
web=$(cd "$(dirname "$0")" && pwd)
page=$1
folder=$2
mkdir -p "$folder"
if ! cmp -s "$web/package-lock.json" "$folder/fetched"; then
  cp "$web/package.json" "$web/package-lock.json" "$folder/"
  if ! (cd "$folder" && npm ci --omit=dev --ignore-scripts --no-audit --no-fund --loglevel=error >npm.log 2>&1); then
    echo "The live view is left out: npm could not fetch what its page is made with ($folder/npm.log)." >&2
    echo "To try again: touch web/build.sh" >&2
    : >"$page"
    exit 0
  fi
  cp "$web/package-lock.json" "$folder/fetched"
fi
exec node "$web/build.mjs" "$page" "$folder/node_modules" >/dev/null
