#!/usr/bin/env bash
# Runs the smoke mission here and in Debians of other releases and architectures, and compares what the runs leave
# (decision 15): scripts/compare_debians.sh RELEASE[/ARCH]…, e.g. scripts/compare_debians.sh trixie bookworm/arm64
set -euo pipefail
cd "$(dirname "$0")/.."
smoke='rm -rf out/smoke
  scripts/build.sh demo canopeer >out/smoke.log 2>&1 || { tail -n 40 out/smoke.log; exit 1; }
  ${CANOPEER_EMULATOR:-} build/release/bin/canopeer run missions/smoke.yaml --out out/smoke >>out/smoke.log'
status=0
mkdir -p out
bash -euc "$smoke"
for system in "$@"; do
  release=${system%/*}
  arch=$(dpkg --print-architecture)
  [ "$release" = "$system" ] || arch=${system#*/}
  echo "== Debian $release $arch"
  scripts/in_debian.sh "$release" "$arch" bash -euc "mkdir -p out; $smoke"
  scripts/compare_runs.sh out/smoke "${CANOPEER_DEBIAN_DIR:-build/debian/$release-$arch}/canopeer/out/smoke" || status=1
done
exit $status
