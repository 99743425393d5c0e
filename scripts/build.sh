#!/usr/bin/env bash
# Installs what is missing, configures and builds one preset: scripts/build.sh PRESET [TARGET…]
# As many jobs as there are cores, and 1.5 GB of memory for each; CANOPEER_JOBS says another number.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
scripts/install_packages.sh
[ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" >/dev/null
cores=$(nproc)
fit=$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo)
jobs=$((fit < 1 ? 1 : fit < cores ? fit : cores))
cmake --build "build/$preset" -j "${CANOPEER_JOBS:-$jobs}" ${1:+--target "$@"}
