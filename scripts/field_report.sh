#!/usr/bin/env bash
# What does the program make of a folder of files it has never seen? Prints a line for each robot, world, mesh, cloud, map and recording.
#   scripts/field_report.sh DIR [SECONDS [MEGABYTES]]      limits for each file: 60 s of processor time (and ten times that on the clock), 2000 MB
# The program is $CANOPEER, else build/release/bin/canopeer. A file is `read`, `faulty` (read, and told what is wrong) or `refused` with a
# message. It ends with 1 when any was none of these: `aborted`, `slow` (past the time) or `big` (past the memory).
set -uo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
program=${CANOPEER:-$here/build/release/bin/canopeer}
root=${1:-}
seconds=${2:-60}
megabytes=${3:-2000}
if [ ! -d "$root" ] || [ ! -x "$program" ]; then
  echo "usage: $0 DIR [SECONDS [MEGABYTES]]; DIR must be a folder, and $program the program" >&2
  exit 2
fi
root=$(cd "$root" && pwd)
ticks=$(getconf CLK_TCK)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0

# A robot.yaml for a bare URDF: the arm is the longest chain of joints that move, the camera its last link.
robot_yaml() {
  printf 'urdf: %s\npackage_path: %s\n' "$1" "$root"
  tr '\n\r\t' '   ' <"$1" | sed 's/<!--/\n<!--/g; s/-->/-->\n/g' | sed '/^<!--/d' | tr '\n' ' ' | tr '<' '\n' | awk '
    function value(key,  text) {
      if (!match($0, "[ ]" key "[ ]*=[ ]*[\"\047][^\"\047]*")) return ""
      text = substr($0, RSTART, RLENGTH); sub(/^[^"\047]*["\047]/, "", text); return text
    }
    /^joint[ ].*type/ { joint = value("name"); type = value("type") }
    /^parent[ ]/ && joint { parent = value("link") }
    /^child[ ]/ && joint { child = value("link"); links[child] = 1 }
    /^\/joint/ && joint { from[child] = parent; by[child] = joint; moves[child] = type ~ /revolute|continuous|prismatic/; joint = "" }
    END {
      most = -1
      for (link in links) {
        count = 0; depth = 0
        for (l = link; l in from && depth < 1000; l = from[l]) { count += moves[l]; depth++ }
        if (count > most || (count == most && link < tip)) { most = count; tip = link; base = l }
      }
      list = ""
      for (l = tip; l in from; l = from[l]) if (moves[l]) list = by[l] (list == "" ? "" : ", ") list
      printf "base_link: %s\ncamera_frame: %s\narm_joints: [%s]\n", base, tip, list
    }'
}

# What kind of thing a file is; nothing: no kind of ours.
kind_of() {
  local file=$1 name=${1##*/}
  [ "$name" = depth.txt ] || [ ! -e "${file%/*}/depth.txt" ] || return 0 # belongs to a recording
  case ${name,,} in
    *.urdf) echo robot ;;
    *.yaml) if grep -q '^urdf:' "$file"; then echo robot.yaml; elif grep -qE '^(world|preset|rows|plants|robot):' "$file"; then echo scene; fi ;;
    *.sdf | *.world | *.dae | *.obj | *.stl | *.gltf | *.glb) echo world ;;
    *.ply) if head -c 4000 "$file" | tr -d '\0' | grep -aqE '^element face +[1-9]'; then echo world; else echo cloud; fi ;;
    depth.txt | associations.txt) echo recording ;;
    rgb.txt | groundtruth.txt | poses.txt | trajectory.txt | readme.txt | license.txt | cmakelists.txt) ;;
    *.pcd | *.csv | *.tsv | *.xyz | *.asc | *.pts | *.txt) echo cloud ;;
    *.ot | *.bt | *.cmap) echo map ;;
  esac
}

# Processor time of processes so far, with that of their children that have ended, in hundredths of a second.
processor_time() {
  local pid line total=0
  local -a field
  for pid in "$@"; do
    line=$(cat /proc/"$pid"/stat 2>/dev/null) || continue
    read -ra field <<<"${line##*) }" # from the state on, the third
    total=$((total + field[11] + field[12] + field[13] + field[14]))
  done
  echo $((total * 100 / ticks))
}

# Runs the program with the arguments, within the limits; sets status, time_s (of the processor) and peak_mb.
run_limited() {
  local begin=$SECONDS pid kb child used=0 now family
  "$program" "$@" >"$work/out" 2>"$work/err" &
  pid=$!
  peak_mb=0
  status=
  while kill -0 "$pid" 2>/dev/null; do
    family="$pid $(cat /proc/"$pid"/task/*/children 2>/dev/null)"
    for child in $family; do
      kb=$(awk '/^VmHWM/ { print $2 }' /proc/"$child"/status 2>/dev/null)
      [ "$((${kb:-0} / 1024))" -le "$peak_mb" ] || peak_mb=$((kb / 1024))
    done
    now=$(processor_time $family)
    [ "$now" -le "$used" ] || used=$now
    [ "$used" -lt "$((seconds * 100))" ] && [ "$((SECONDS - begin))" -lt "$((seconds * 10))" ] || status=slow
    [ "$peak_mb" -lt "$megabytes" ] || status=big
    [ -z "$status" ] || kill -9 $family 2>/dev/null
    sleep 0.05
  done
  wait "$pid" 2>/dev/null
  local code=$?
  time_s=$((used / 100)).$((used / 10 % 10))
  [ -n "$status" ] || case $code in 0) status=read ;; 1) status=faulty ;; 2) status=refused ;; *) status=aborted ;; esac
}

report() {
  local kind=$1 file=$2 line notices out=$work/results
  rm -rf "$out"
  case $kind in
    robot) robot_yaml "$file" >"$work/robot.yaml"; run_limited robot check "$work/robot.yaml" --views 200 --states 500 --out "$out" ;;
    robot.yaml) run_limited robot check "$file" --views 200 --states 500 --out "$out" ;;
    scene) run_limited scene inspect "$file" --counts ;;
    world) run_limited scene import "$file" --model-path "$root" --out "$out" ;;
    cloud) run_limited fruit fit "$file" --out "$out" ;;
    map) run_limited map info "$file" ;;
    recording) run_limited map fuse "${file%/*}" --out "$out.ot" --resolution 0.05 ;;
  esac 2>/dev/null # where the shell says that a process was killed
  case $status in
    read) line=$(grep -ahE '^imported' "$work/err" || grep -a . "$work/out" | head -n 1) ;;
    faulty) line=$(grep -ahE 'wrong:|^canopeer:' "$work/out" "$work/err" | head -n 1) ;;
    *) line=$(grep -a '^canopeer:' "$work/err" | tail -n 1) ;;
  esac
  line=$(printf '%s' "${line#canopeer: }" | tr '\r\n' '  ' | tr -s ' ')
  notices=$(grep -ac '^canopeer: \(notice\|warning\|passed over\)' "$work/err")
  [ "$notices" -eq 0 ] || line="$line; $notices notice(s)"
  case $status in read | faulty | refused) ;; *) bad=1 ;; esac
  printf '%-8s %6s s %6s MB  %-10s %s  %s\n' "$status" "$time_s" "$peak_mb" "$kind" "${file#"$root"/}" "${line:0:200}"
}

printf '%-8s %8s %9s  %-10s %s\n' status time memory kind 'name  what the program says'
while IFS= read -r -d '' file; do
  kind=$(kind_of "$file")
  [ -z "$kind" ] || report "$kind" "$file"
done < <(find -L "$root" -type f -print0 | sort -z)
exit $bad
