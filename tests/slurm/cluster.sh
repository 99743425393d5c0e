# shellcheck shell=bash
# A Slurm cluster of one node on loopback, in a folder of its own: start_cluster FOLDER, stop_cluster.
# Daemons are children of the script, in its process group; they end with it, however it ends.

# Two free ports in a row.
free_port() {
  local port
  while :; do
    port=$((20000 + RANDOM % 9000))
    (: <"/dev/tcp/127.0.0.1/$port" || : <"/dev/tcp/127.0.0.1/$((port + 1))") 2>/dev/null || break
  done
  echo "$port"
}

write_settings() {
  local folder=$1 port=$2 me host
  me=$(id -un)
  host=$(hostname -s)
  cat >"$folder/slurm.conf" <<EOF
ClusterName=canopeer_test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
# A requeued job waits for the time after which its old credential expires: not the usual two minutes.
AuthInfo=socket=$folder/munge.socket,cred_expire=5
SlurmUser=$me
SlurmdUser=$me
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SlurmdParameters=config_overrides
MpiDefault=none
SwitchType=switch/none
MailProg=/bin/true
NodeName=loop NodeHostname=$host NodeAddr=127.0.0.1 CPUs=2
PartitionName=main Nodes=loop Default=YES MaxTime=INFINITE
EOF
  # Slurm 24.11 wants control groups, which a container may not have, unless told so; 22.05 goes without.
  [[ $(slurmd -V) =~ ([0-9]+)\.([0-9]+) ]] || return 1
  [ "$((10#${BASH_REMATCH[1]}${BASH_REMATCH[2]}))" -lt 2405 ] || echo "CgroupPlugin=disabled" >"$folder/cgroup.conf"
}

daemons=()
start_daemon() {
  local name=$1
  shift
  setpriv --pdeathsig KILL "$@" >"$cluster/$name.log" 2>&1 &
  daemons+=("$!")
}

# Fails when the node is not idle in time; what the daemons said is in FOLDER/*.log.
start_cluster() {
  cluster=$1
  mkdir -p "$cluster/state" "$cluster/spool"
  (umask 077 && head -c 128 /dev/urandom >"$cluster/munge.key")
  write_settings "$cluster" "$(free_port)"
  unset "${!SLURM_@}" "${!SBATCH_@}"  # of the cluster that runs this test, perhaps
  export SLURM_CONF=$cluster/slurm.conf
  start_daemon munged munged --foreground --force --socket="$cluster/munge.socket" --key-file="$cluster/munge.key" \
    --pid-file="$cluster/munged.pid" --seed-file="$cluster/munge.seed" --log-file="$cluster/munged.file"
  until_true 300 test -S "$cluster/munge.socket" || return 1
  start_daemon slurmctld slurmctld -D -c
  start_daemon slurmd slurmd -D -N loop
  until_true 600 node_is_idle
}
node_is_idle() { [ "$(timeout 2 sinfo --noheader --format=%T 2>/dev/null)" = idle ]; }

stop_cluster() {
  [ ${#daemons[@]} -gt 0 ] || return 0
  timeout 5 scancel --user="$(id -un)" 2>/dev/null
  until_true 50 no_steps
  kill "${daemons[@]}" 2>/dev/null
  until_true 50 all_ended || kill -KILL "${daemons[@]}" 2>/dev/null
  daemons=()
}
no_steps() { [ -z "$(timeout 2 squeue --noheader 2>/dev/null)" ]; }
all_ended() { ! kill -0 "${daemons[@]}" 2>/dev/null; }

# until_true N COMMAND…: tries it N times at most, ten times a second.
until_true() {
  local left=$1
  shift
  until "$@"; do
    [ $((left--)) -gt 0 ] || return 1
    sleep 0.1
  done
}
