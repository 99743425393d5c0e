#!/usr/bin/env bash
# Installs what is missing, configures and builds one preset: scripts/build.sh PRESET [TARGET…]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
scripts/install_packages.sh
[ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" >/dev/null
cmake --build "build/$preset" -j "$(scripts/jobs.sh)" ${1:+--target "$@"}
