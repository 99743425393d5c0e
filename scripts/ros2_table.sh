#!/bin/bash
# ros2_table.sh [RUNS] [MISSION]: the same mission over ROS 2 (against the simulated robot, in a process of its own) and on the
# wall clock without it, RUNS times each (default 10, smoke). Prints what was found, how much later frames and motions are over
# ROS 2, and what speaking ROS 2 costs. Needs root or user namespaces (a network of its own) and a machine with nothing else to do.
set -euo pipefail
runs=${1:-10} mission=${2:-missions/smoke.yaml}
cd "$(dirname "$0")/.."
program=${CANOPEER:-build/release/bin/canopeer}
export OUT=${OUT:-$(mktemp -d)}
if [ -z "${CANOPEER_OWN_NETWORK:-}" ]; then
  for flags in "-n" "-r -n"; do
    # shellcheck disable=SC2086
    unshare $flags true 2> /dev/null && exec unshare $flags env CANOPEER_OWN_NETWORK=1 "$0" "$@"
  done
  echo "ros2_table.sh: cannot make a network of its own: run it as root, or allow user namespaces" >&2
  exit 1
fi
ip link set lo up
ip link set lo multicast on

for ((i = 1; i <= runs; ++i)); do
  "$program" run "$mission" --realtime --quiet --out "$OUT/wall_$i"
  "$program" ros2 robot "$mission" --camera-rate 8 > "$OUT/robot_$i.txt" &
  robot=$!
  "$program" run "$mission" --site ros2 --quiet --set ros2.arm.speed_scale=1 --set ros2.arm.first_motions=0 --out "$OUT/ros2_$i" &
  python3 scripts/thread_times.py $! > "$OUT/threads_$i.json" || true
  wait $! || true
  awk -v hz="$(getconf CLK_TCK)" '{print ($14 + $15) / hz}' /proc/$robot/stat > "$OUT/robot_cpu_$i.txt"
  kill -INT $robot
  wait $robot
done
python3 scripts/ros2_table.py "$OUT" "$runs"
echo "results in $OUT"
