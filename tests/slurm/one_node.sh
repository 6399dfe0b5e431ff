#!/bin/bash
# A Slurm of one node on this machine, all of it in a folder and on the loopback interface.
#
#     one_node.sh start DIR      then: export SLURM_CONF=DIR/slurm.conf
#     one_node.sh stop DIR
#
# Needs slurm-wlm and munge of Debian, a host name that stands for 127.0.0.1, and a DIR that all may enter (chmod a+x). It stops the processes that it has started, and no other.
set -uo pipefail
D=$(realpath -m "$2")
export SLURM_CONF=$D/slurm.conf
H=$(hostname -s)

start() {
    mkdir -p "$D"/{spool,state}
    read -r CPUS MEM < <(slurmd -C | sed -nE '1s/.*CPUs=([0-9]+).*RealMemory=([0-9]+).*/\1 \2/p')
    (umask 077; dd if=/dev/urandom of="$D/munge.key" bs=1024 count=1 status=none)
    cat >"$SLURM_CONF" <<END
ClusterName=one
SlurmctldHost=$H(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$D/munge.socket
StateSaveLocation=$D/state
SlurmdSpoolDir=$D/spool
SlurmctldPidFile=$D/slurmctld.pid
SlurmdPidFile=$D/slurmd.pid
SlurmctldLogFile=$D/slurmctld.log
SlurmdLogFile=$D/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/linux
JobCompType=jobcomp/filetxt
JobCompLoc=$D/jobcomp.txt
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1,bf_interval=1
MaxArraySize=${MAX_ARRAY_SIZE:-1001}
MaxJobCount=10000
NodeName=$H NodeAddr=127.0.0.1 CPUs=$CPUS RealMemory=$((MEM * 9 / 10)) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    setsid munged --foreground --key-file="$D/munge.key" --socket="$D/munge.socket" --pid-file="$D/munged.pid" \
        --log-file="$D/munged.log" --seed-file="$D/munged.seed" >"$D/munged.out" 2>&1 </dev/null &
    echo $! >"$D/munged.mine"
    for _ in $(seq 50); do [ -S "$D/munge.socket" ] && break; sleep .1; done
    setsid slurmctld -D >"$D/ctld.out" 2>&1 </dev/null &
    echo $! >"$D/slurmctld.mine"
    for _ in $(seq 50); do scontrol ping >/dev/null 2>&1 && break; sleep .1; done
    setsid slurmd -D -N "$H" >"$D/slurmd.out" 2>&1 </dev/null &
    echo $! >"$D/slurmd.mine"
    for _ in $(seq 100); do sinfo -h -o %T 2>/dev/null | grep -q idle && return 0; sleep .1; done
    echo "the node is not idle after 10 s: $D/slurmd.log, $D/slurmctld.log" >&2
    return 1
}

stop() {
    scancel -u root 2>/dev/null
    for daemon in slurmd slurmctld munged; do
        [ -e "$D/$daemon.mine" ] || continue
        pid=$(cat "$D/$daemon.mine")
        kill "$pid" 2>/dev/null
        while kill -0 "$pid" 2>/dev/null; do sleep .1; done
        rm "$D/$daemon.mine"
    done
}

case $1 in
    start) start ;;
    stop) stop ;;
    *) echo "start or stop" >&2; exit 2 ;;
esac
