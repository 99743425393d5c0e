#!/usr/bin/env bash
# Builds Canopeer, maps Scenario 1 and says where the report is. Arguments go to `canopeer run`.
set -euo pipefail
cd "$(dirname "$0")"
scripts/build.sh release canopeer
out=out/scenario_1
build/release/bin/canopeer run missions/scenario_1.yaml --out "$out" "$@"
echo "Open $PWD/$out/report.html in a browser."
