#!/bin/sh
# A course exported by Slurm on this machine: three node daemons, one set down while it works.
#
#     tests/farm/slurm.sh COURSE OUT [FORMATS]
#
# As root, on a machine that runs no Slurm of its own. Needs Debian's slurm-wlm and munge, and `lianpu` on the PATH (or
# LIANPU). COURSE is a folder of lessons (tests/farm/course.sh makes one). It makes a cluster in a folder of its own,
# prints the job with `lianpu farm slurm`, submits it, sets one node down as soon as it has a part, waits,
# compares the joined manifest with that of a plain export, and takes the cluster away again.
set -eu
course=$(realpath "${1:?usage: slurm.sh COURSE OUT [FORMATS]}") out=$(realpath -m "${2:?}") formats=${3:-png,srt}
program=$(command -v "${LIANPU:-lianpu}")
host=$(hostname -s)
state=$(mktemp -d)
mkdir -p "$state/state" /run/munge
cpus=${CPUS:-1}

cat >"$state/slurm.conf" <<CONF
ClusterName=lianpu
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
AuthType=auth/munge
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$state/state
SlurmdSpoolDir=$state/spool.%n
SlurmctldPidFile=$state/ctld.pid
SlurmdPidFile=$state/d.%n.pid
SlurmctldLogFile=$state/ctld.log
SlurmdLogFile=$state/d.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SwitchType=switch/none
MpiDefault=none
ReturnToService=1
SlurmdTimeout=15
SlurmdParameters=config_overrides
NodeName=n[1-3] NodeHostname=$host NodeAddr=127.0.0.1 Port=[17001-17003] CPUs=$cpus RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$state/slurm.conf"

# Only what was started here is ended.
own_munge=
end() {
    for pid in "$state"/*.pid; do [ -f "$pid" ] && kill "$(cat "$pid")" 2>/dev/null || :; done
    [ -z "$own_munge" ] || kill "$(cat "$own_munge")" 2>/dev/null || :
    [ -n "${KEEP:-}" ] && echo "logs in $state" >&2 || { sleep 2; rm -rf "$state"; }
}
trap end EXIT
trap 'exit 130' INT TERM

if ! munge -n >/dev/null 2>&1; then
    [ -f /etc/munge/munge.key ] || mungekey --create
    chown -R munge: /run/munge /etc/munge
    su -s /bin/sh munge -c '/usr/sbin/munged --pid-file=/run/munge/munged.pid' || /usr/sbin/munged --force
    own_munge=/run/munge/munged.pid
fi
slurmctld
for n in n1 n2 n3; do slurmd -N $n; done
until [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 3 ]; do sleep 0.5; done
echo "three nodes of $cpus CPU are idle"

cd "$state"
"$program" farm slurm "$course" --to "$formats" --out "$out" --tasks "${TASKS:-9}" --program "$program" >job.sh
began=$(date +%s)
sh job.sh | tee ids
array=$(sed 's/export \([0-9]*\),.*/\1/' ids) merge=$(sed 's/.*merge //' ids)

# The node falls out with a part on it: Slurm takes the part back and gives it to another.
until squeue -h -r -j "$array" -t R -w n2 -o %i 2>/dev/null | grep -q .; do sleep 0.1; done
lost=$(squeue -h -r -j "$array" -t R -w n2 -o %K | head -1)
scontrol update nodename=n2 state=down reason=test
echo "n2 is set down while it has part $lost"
while squeue -h -j "$array" 2>/dev/null | grep -q .; do sleep 0.5; done
while squeue -h -j "$merge" 2>/dev/null | grep -q .; do sleep 0.5; done
echo "done after $(($(date +%s) - began)) s"
grep -h "requeue job" ctld.log
cat slurm-"$array"_*.out slurm-"$merge".out
"$program" export "$course" --to "$formats" --out "$state/plain" >/dev/null
cmp "$state/plain/manifest.json" "$out/manifest.json" && echo "a plain export has the same manifest"
