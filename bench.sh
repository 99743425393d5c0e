#!/usr/bin/env bash
# Builds the benchmarks and runs them, each beside its baseline: ./bench.sh [--only NAME] [--json FILE] [--filter REGEX]
set -euo pipefail
cd "$(dirname "$0")"
names=$(sed -n 's/^add_executable(\([a-z]*\)_bench .*/\1/p' bench/CMakeLists.txt | sort)
only=
json=
filter=
while [ $# -gt 0 ]; do
  case $1 in
    --only) only=${2:?--only needs a name}; shift 2 ;;
    --json) json=${2:?--json needs a file}; shift 2 ;;
    --filter) filter=${2:?--filter needs a pattern}; shift 2 ;;
    *) echo "bench.sh: unknown option '$1' (--only NAME, --json FILE, --filter REGEX)" >&2; exit 2 ;;
  esac
done
if [ -n "$only" ]; then
  grep -qx -- "$only" <<<"$names" || { echo "bench.sh: no benchmark '$only'; there are:" $names >&2; exit 2; }
  names=$only
fi
rows=$(mktemp -d)
trap 'rm -rf "$rows"' EXIT
scripts/build.sh release $(printf '%s_bench ' $names)
for name in $names; do
  "build/release/bin/${name}_bench" --json "$rows/$name.json" ${filter:+"--benchmark_filter=$filter"}
done
if [ -n "$json" ]; then
  # One list of all programs' rows: the brackets of the parts go, commas come between them.
  { echo '['; sed -e '/^\[\(\]\)\?$/d' -e '/^\]$/d' -e 's/^  }$/  },/' "$rows"/*.json | sed '$ s/},$/}/'; echo ']'; } >"$json.tmp"
  mv "$json.tmp" "$json"
fi
