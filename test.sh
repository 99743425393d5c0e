#!/usr/bin/env bash
# Builds Canopeer and runs all tests. Arguments go to ctest, e.g. ./test.sh -R VoxelMap
set -euo pipefail
cd "$(dirname "$0")"
scripts/build.sh release
ctest --test-dir build/release --output-on-failure -j "$(nproc)" "$@"
