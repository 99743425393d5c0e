#!/usr/bin/env bash
# Installs what is missing, configures and builds one preset: scripts/build.sh PRESET [TARGET…]
# The preset demo begins the folder of the preset release; where that is whole already, nothing is left out.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
folder=build/${preset/#demo/release}
scripts/install_packages.sh "$preset"
if [ ! -f "$folder/build.ninja" ] || { [ "$preset" = release ] && grep -q "^CANOPEER_DEMO:BOOL=ON" "$folder/CMakeCache.txt"; }; then
  cmake --preset "$preset" >/dev/null
fi
cmake --build "$folder" -j "$(scripts/jobs.sh)" ${1:+--target "$@"}
