# A Slurm cluster of several nodes on this machine's loopback, in a folder of its own; to be sourced.
#
#   cluster_start FOLDER   munge, the controller and the nodes n1 to n4, of two processors each
#   cluster_stop           ends all of them, by their numbers
#   start_controller, stop_controller, start_node N, lose_node N
#
# What it starts are children of this shell, and their steps.

nodes=4
first_port=26817  # the controller's; the nodes' follow

cluster_start() {
  cluster=$1
  mkdir -p "$cluster"/{state,munge}
  chmod 755 "$cluster"
  chmod 700 "$cluster/munge"
  head -c 1024 /dev/urandom >"$cluster/munge/key"
  chmod 600 "$cluster/munge/key"
  {
    cat <<END
ClusterName=hbr
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$first_port
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket
CredType=cred/munge
StateSaveLocation=$cluster/state
SlurmctldPidFile=$cluster/controller.pid
SlurmctldLogFile=$cluster/controller.log
SlurmdPidFile=$cluster/%n.pid
SlurmdLogFile=$cluster/%n.log
SlurmdSpoolDir=$cluster/%n.spool
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
DefMemPerCPU=1000
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=15
MessageTimeout=10
InactiveLimit=0
KillWait=2
MinJobAge=300
SlurmdParameters=config_overrides
CommunicationParameters=NoAddrCache
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    for ((n = 1; n <= nodes; n++)); do
      echo "NodeName=n$n NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((first_port + n)) CPUs=2 RealMemory=8000 State=UNKNOWN"
    done
  } >"$cluster/slurm.conf"
  export SLURM_CONF=$cluster/slurm.conf
  munged --foreground --key-file "$cluster/munge/key" --socket "$cluster/munge/socket" --pid-file "$cluster/munge/pid" \
    --log-file "$cluster/munge/log" --seed-file "$cluster/munge/seed" --force >"$cluster/munge/out" 2>&1 &
  munge_process=$!
  wait_until 20 '[ -S "$cluster/munge/socket" ]' || { cat "$cluster/munge/out" >&2; return 1; }
  start_controller
  for ((n = 1; n <= nodes; n++)); do start_node $n; done
  wait_until 30 '[ "$(sinfo -h -t idle -o %D)" = '"$nodes"' ]'
}

start_controller() {
  slurmctld -D >>"$cluster/controller.out" 2>&1 &
  controller_process=$!
  wait_until 20 'scontrol ping 2>/dev/null | grep -q UP'
}

stop_controller() {
  kill_family "$controller_process"
  wait "$controller_process" 2>/dev/null || true
}

declare -A node_process
start_node() {
  mkdir -p "$cluster/n$1.spool"
  slurmd -D -N "n$1" >>"$cluster/n$1.out" 2>&1 &
  node_process[$1]=$!
}

# The node's daemon, and the job steps that it runs: as if the machine had lost its power.
lose_node() {
  local step process
  for process in ${node_process[$1]:-}; do  # none where it was never started
    kill -9 "$process" 2>/dev/null || true
    wait "$process" 2>/dev/null || true
  done
  for step in $(steps_of "$1"); do kill_family "$step"; done
}

# A step's daemon writes to the log of its node.
steps_of() {
  local step
  for step in $(pgrep -f '^slurmstepd: '); do
    ls -l "/proc/$step/fd" 2>/dev/null | grep -qF "$cluster/n$1.log" && echo "$step"
  done
  true
}

kill_family() {
  local child
  for child in $(pgrep -P "$1"); do kill_family "$child"; done
  kill -9 "$1" 2>/dev/null || true
}

cluster_stop() {
  local n
  for ((n = 1; n <= nodes; n++)); do lose_node $n; done
  for n in ${controller_process:-} ${munge_process:-}; do
    kill_family "$n"
    wait "$n" 2>/dev/null || true
  done
}

# wait_until SECONDS CONDITION
wait_until() {
  local until=$((SECONDS + $1))
  until eval "$2"; do
    ((SECONDS < until)) || { echo "waited $1 s in vain until $2" >&2; return 1; }
    sleep 0.2
  done
}
