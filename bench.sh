#!/usr/bin/env bash
# Builds the benchmarks and runs them, each beside its baseline: ./bench.sh [--only map] [--json FILE]
set -euo pipefail
cd "$(dirname "$0")"
only=map
json=
while [ $# -gt 0 ]; do
  case $1 in
    --only) only=${2:?--only needs a name}; shift 2 ;;
    --json) json=${2:?--json needs a file}; shift 2 ;;
    *) echo "bench.sh: unknown option '$1' (--only NAME, --json FILE)" >&2; exit 2 ;;
  esac
done
[ "$only" = map ] || { echo "bench.sh: no benchmark '$only'; there is: map" >&2; exit 2; }
scripts/build.sh release "${only}_bench"
"build/release/bin/${only}_bench" ${json:+"--benchmark_out=$json" --benchmark_out_format=json}
