#!/usr/bin/env bash
# Makes a campaign on a Slurm cluster: a job array of N shards, then a job that compares.
#   slurm/submit.sh N [SBATCH-OPTION…] -- ARGUMENT…              # arguments of `canopeer bench`
#   slurm/submit.sh 20 --time=4:00:00 --cpus-per-task=4 -- scenario_1 --planners vmp,rvp --runs 10 --out /shared/compare
# The program, the missions and --out must be the same files on all nodes. docs/cluster.md is for those who use it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
fail() { echo "submit.sh: $*" >&2; exit 2; }
usage='slurm/submit.sh N [SBATCH-OPTION…] -- ARGUMENT…, e.g. slurm/submit.sh 20 --time=4:00:00 -- scenario_1 --out /shared/compare'
[[ ${1:-} =~ ^[1-9][0-9]{0,6}$ ]] || fail "expected a number of shards first: $usage"
shards=$1
shift
options=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
[ $# -gt 1 ] || fail "expected -- and the arguments of canopeer bench: $usage"
shift
out=
for ((i = 1; i <= $#; ++i)); do
  case ${!i} in
    --out) next=$((i + 1)); out=${!next:-} ;;
    --out=*) out=${!i#*=} ;;
    --shard | --shard=* | --merge | --merge=* | --report-only) fail "${!i%%=*}: the jobs say that themselves" ;;
  esac
done
[ -n "$out" ] || fail "expected --out FOLDER, which all nodes see"
command -v sbatch >/dev/null || fail "no command sbatch here: this is for a machine from which one submits to Slurm"

# CANOPEER names another program, one with planners of your own for instance.
program=${CANOPEER:-$here/../build/release/bin/canopeer}
[ -x "$program" ] || { [ -z "${CANOPEER:-}" ] && program=$(command -v canopeer); } || fail "no program canopeer: build it (scripts/build.sh release canopeer), install it, or set CANOPEER"
program=$(realpath "$program")

# What is wrong with the arguments is said now, not by every task in an hour.
"$program" bench "$@" --report-only --quiet
logs=$(realpath "$out")/slurm
mkdir -p "$logs"
array=$(sbatch --parsable --array="1-$shards" --output="$logs/shard_%a.log" "${options[@]}" "$here/bench.sbatch" "$shards" "$program" "$out" "$@")
array=${array%%;*}
# After all of them, whether they went well or not: it compares what is there, and says what is missing.
compare=$(sbatch --parsable --dependency="afterany:$array" --output="$logs/compare.log" "${options[@]}" "$here/compare.sbatch" "$program" "$@")
echo "shards      job $array, tasks 1-$shards; logs in $logs"
echo "comparison  job ${compare%%;*}; $(realpath "$out")/comparison.html when they are done"
