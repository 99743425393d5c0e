#!/usr/bin/env bash
# campaign_test.sh PROGRAM SOURCES: a campaign on a real Slurm (munged, slurmctld, slurmd on loopback), submitted as people do.
# One task is requeued in the middle. Every run is there, each equal to one made without Slurm.
set -uo pipefail
for tool in munged slurmctld slurmd sbatch setpriv; do
  PATH=$PATH:/usr/sbin:/sbin command -v "$tool" >/dev/null || { echo "skipped: Slurm is not installed ($tool)"; exit 0; }
done
# In a PID namespace nothing outlives this script, not even a job that was just started.
if [ -z "${CANOPEER_IN_NAMESPACE:-}" ] && unshare --pid --fork --mount-proc true 2>/dev/null; then
  CANOPEER_IN_NAMESPACE=1 exec unshare --pid --fork --kill-child --mount-proc bash "$0" "$@"
fi
export PATH=$PATH:/usr/sbin:/sbin
# 22.05 goes without control groups, 24.05 can be told to.
if [[ $(slurmd -V) == *" 23."* ]] && ! mountpoint -q /sys/fs/cgroup; then
  echo "skipped: Slurm 23 needs control groups, and /sys/fs/cgroup is not mounted"
  exit 0
fi
program=$1 sources=$2
. "$sources/tests/slurm/cluster.sh"
work=$(mktemp -d)
chmod 755 "$work"
trap 'stop_cluster; rm -rf "$work"' EXIT
trap 'exit 1' INT TERM

shared=$work/shared
fail() {
  echo "FAILED: $*" >&2
  tail -n 20 "$shared"/slurm/*.log "$work"/alone.log "$work"/cluster/*.log >&2 2>/dev/null
  exit 1
}
cd "$sources" || exit 1
campaign=(missions/smoke.yaml --planners random --runs 4 --budgets 4)
folder=runs/smoke/4s/random

start_cluster "$work/cluster" || fail "no cluster"
CANOPEER=$program slurm/submit.sh 2 -- "${campaign[@]}" --out "$shared" || fail "cannot submit"
array=$(squeue --noheader --array --format=%F --name=canopeer-bench | head -n 1)

# Shard 1 makes seeds 1 and 3. It is sent back while it is in the second.
in_the_second() { [ -f "$shared/$folder/seed_1/command" ] && compgen -G "$shared/$folder/seed_3.*.part/record" >/dev/null; }
until_true 1200 in_the_second || fail "shard 1 does not get on"
first=$(stat -c %i "$shared/$folder/seed_1/record")
scontrol requeue "${array}_1" || fail "cannot requeue"

# Meanwhile, the same without Slurm.
"$program" bench "${campaign[@]}" --threads 1 --quiet --out "$work/alone" >"$work/alone.log" 2>&1 || fail "cannot run alone"

compared() { [ -z "$(squeue --noheader)" ] && [ -f "$shared/slurm/compare.log" ]; }
until_true 1200 compared || fail "jobs do not end: $(squeue)"

grep -q 'shard 1/2 .* start 2' "$shared/slurm/shard_1.log" || fail "task 1 was not started again"
[ "$(stat -c %i "$shared/$folder/seed_1/record")" = "$first" ] || fail "a run that was whole was made again"
for seed in 1 2 3 4; do
  for file in record fruits.csv timeline.csv command; do
    cmp "$work/alone/$folder/seed_$seed/$file" "$shared/$folder/seed_$seed/$file" || fail "seed $seed differs"
  done
done
for file in runs.csv comparison.csv comparison.md comparison.html; do
  cmp "$work/alone/$file" "$shared/$file" || fail "$file differs"
done
left=$(find "$shared" -name '*.part' -o -name 'begun.*' -o -path '*/runs/*.log')
[ -z "$left" ] || fail "left behind: $left"
echo "4 runs in 2 shards on Slurm, one sent back: equal to those without"
