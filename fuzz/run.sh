#!/usr/bin/env bash
# Builds the fuzz targets and runs each for SECONDS (default 60), or only those named: fuzz/run.sh [SECONDS [TARGET…]]
# Needs clang-14 and libclang-rt-14-dev. What crashes lies in build/fuzz/corpus/TARGET-crash-….
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
targets=("${@:2}")
[ ${#targets[@]} -gt 0 ] || targets=(cdr octomap cmap cloud png trajectory collada_asset ros2_images scan_rows scene_file sdf_world)
[ -f build/fuzz/build.ninja ] || cmake --preset fuzz >/dev/null
cmake --build build/fuzz -j 2 --target fuzz_seeds "${targets[@]/#/fuzz_}"
build/fuzz/bin/fuzz_seeds build/fuzz/corpus
# A small map file may mean 256³ voxels: with sanitizers, on a busy machine, that takes a while and is no hang.
for target in "${targets[@]}"; do
  log=build/fuzz/corpus/$target.log
  dictionary=()
  [ ! -f "fuzz/$target.dict" ] || dictionary=(-dict="fuzz/$target.dict")
  mkdir -p "build/fuzz/corpus/$target"
  if ! build/fuzz/bin/fuzz_"$target" -max_total_time="$seconds" -rss_limit_mb=1024 -malloc_limit_mb=512 -timeout=120 -max_len=20000 \
    "${dictionary[@]}" -artifact_prefix=build/fuzz/corpus/"$target"- -print_final_stats=1 build/fuzz/corpus/"$target" >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "$target: found an input that fails, see above and $log" >&2
    exit 1
  fi
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "$target: $runs inputs in $seconds s, none fails"
done
