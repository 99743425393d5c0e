#!/usr/bin/env bash
# Builds the fuzz targets and runs each for SECONDS (default 60), or only those named: fuzz/run.sh [SECONDS [TARGET…]]
# Needs clang-14 and libclang-rt-14-dev. What crashes lies in build/fuzz/corpus/TARGET-crash-….
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
targets=("${@:2}")
[ ${#targets[@]} -gt 0 ] || targets=(octomap cmap cloud png trajectory)
[ -f build/fuzz/build.ninja ] || cmake --preset fuzz >/dev/null
cmake --build build/fuzz -j 2 --target fuzz_seeds "${targets[@]/#/fuzz_}"
build/fuzz/bin/fuzz_seeds build/fuzz/corpus
for target in "${targets[@]}"; do
  echo "== $target, $seconds s"
  build/fuzz/bin/fuzz_"$target" -max_total_time="$seconds" -rss_limit_mb=1024 -malloc_limit_mb=512 -timeout=10 -max_len=20000 \
    -artifact_prefix=build/fuzz/corpus/"$target"- -print_final_stats=1 build/fuzz/corpus/"$target" 2>&1 |
    grep -E '^(stat::|SUMMARY|==.*ERROR|Done)|ERROR' || true
  [ "${PIPESTATUS[0]}" -eq 0 ] || { echo "$target found a failing input" >&2; exit 1; }
done
