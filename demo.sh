#!/usr/bin/env bash
# Builds Canopeer, maps Scenario 1 and says where the report is. Arguments go to `canopeer run`.
# CANOPEER_EMULATOR is set where another machine's program is built (scripts/in_debian.sh RELEASE arm64).
set -euo pipefail
cd "$(dirname "$0")"
scripts/build.sh demo canopeer
out=out/scenario_1
${CANOPEER_EMULATOR:-} build/release/bin/canopeer run missions/scenario_1.yaml --out "$out" "$@"
echo "Open $PWD/$out/report.html in a browser."
