#!/usr/bin/env bash
# Holds two runs of one mission against each other, as decision 15 promises them: scripts/compare_runs.sh RUN OTHER
# Maps, fruits.csv, timeline.csv and ground truth: the same bytes. Record and summary: the same but for the last digits of
# numbers. Says what differs, and by how much; status 1 when that is more.
set -euo pipefail
most=1e-9  # of a number's value
status=0

# Numbers and what is between them, one a line.
tokens() { sed '/"wall_time_s"/d' "$1" | grep -oE -- '-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?|[^-0-9]+|-'; }

for file in map.ot map_roi.ot fruits.csv timeline.csv ground_truth.csv; do
  cmp "$1/$file" "$2/$file" || status=1
done
for file in record summary.json; do
  paste <(tokens "$1/$file") <(tokens "$2/$file") | awk -F '\t' -v most=$most -v file="$2/$file" '
    function size(x) { return x < 0 ? -x : x }
    $1 == $2 { next }
    $1 !~ /^-?[0-9]/ || $2 !~ /^-?[0-9]/ { print file ": has \"" $2 "\" in place of \"" $1 "\""; failed = 1; exit 1 }
    {
      share = size($1 - $2) / (size($1) > size($2) ? size($1) : size($2))
      if (share > largest) { largest = share; pair = $2 " in place of " $1 }
      ++differ
    }
    END {
      if (failed) exit 1
      if (!differ) { print file ": the same"; exit 0 }
      print file ": " differ " numbers differ, by at most " largest " of their value (" pair ")"
      exit largest > most
    }' || status=1
done
exit $status
