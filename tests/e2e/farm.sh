#!/usr/bin/env bash
# docs/farm.md: frames by make, by GNU parallel and by a Slurm of two nodes on this machine, one task of which is killed and
# done again, are those of one local run; bands of rows join to the whole picture.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
PATH=$bin:$PATH
cp "$root/povscenes/povgloss.inc" "$root/scripts/povgloss-array.sbatch" .
size=(+W48 +H36 +A0.3)
cat > turning.pov << 'POV'
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1 }
camera { location <0, 2, -5> right x*4/3 look_at <0, 0.5, 0> }
light_source { <-6, 9, -7> rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [0.4 rgb <0.2, 0.35, 0.8>] } } }
plane { y, 0 pigment { checker rgb 0.1 rgb 0.7 scale 0.23 rotate 31*y } finish { reflection 0.5 Gloss(60) } }
box { -0.6, 0.6 pigment { checker rgb x rgb 1 scale 0.3 } rotate 360*clock*y translate 0.7*y }
POV
printf '%s\n' Input_File_Name=turning.pov Initial_Frame=1 Final_Frame=12 > turning.ini
mkdir local
povgloss render turning.ini "${size[@]}" --quiet --no-check -o local/turning.png || exit 1

# same_frames FRAME...: those in this folder are the local ones.
same_frames() {
    local frame
    for frame; do
        cmp "turning$frame.png" "local/turning$frame.png" || return
    done
}

# The rule of the manual, with this size.
by_make() {
    sed -n '/^```make/,/^```/p' "$root/docs/farm.md" | grep -v '^```' | sed 's/+W640 +H480/+W48 +H36 --no-check/' > Makefile
    env -u MAKEFLAGS -u MAKELEVEL make -j2 turning02.png turning11.png > log 2>&1 || { cat log; return 1; }
    same_frames 02 11 && env -u MAKEFLAGS -u MAKELEVEL make -q turning02.png || return
    touch turning.pov
    ! env -u MAKEFLAGS -u MAKELEVEL make -q turning02.png
}
check 'frames__by_make__those_of_a_local_run' by_make
rm -f turning??.png

if command -v parallel > /dev/null; then
    by_parallel() {
        parallel --will-cite -S 2/: --wd . --joblog frames.log \
            povgloss render turning.ini '+SF{} +EF{}' "${size[@]}" --jobs 1 +WT1 --quiet --no-check -o turning.png ::: 3 12 &&
            same_frames 03 12
    }
    check 'frames__by_parallel__those_of_a_local_run' by_parallel
    rm -f turning??.png
else
    tests=$((tests + 1))
    echo "ok $tests - frames__by_parallel # SKIP parallel is not installed"
fi

# task NUMBER ARGUMENT...: what a Slurm task runs.
task() {
    SLURM_ARRAY_TASK_ID=$1 bash povgloss-array.sbatch "${@:2}"
}
bands() {
    local number
    povgloss passes turning.pov +W64 +H150 +A0.3 "$@" --quiet --no-check -o whole.exr || return
    for number in 1 2 3; do
        task $number bands=3 turning.pov +W64 +H150 +A0.3 "$@" --no-check -o 'band-%.exr' || return
    done
    # Outside of its band a file is 0.
    oiiotool band-1.exr band-2.exr --add band-3.exr --add -o sum.exr
}
joined() {
    bands "$@" && idiff -a -fail 0 -hardfail 0 whole.exr sum.exr &&
        glossfilter band-*.exr -o joined.exr && glossfilter whole.exr -o picture.exr &&
        idiff -fail 1e-4 -hardfail 1e-4 picture.exr joined.exr
}
check 'bands__joined__the_whole_picture' joined
check 'bands__without_means__joined__the_whole_picture' joined --no-means
wrong_bands() {
    povgloss passes turning.pov +W32 +H150 --quiet --no-check -o other.exr || return
    run glossfilter band-1.exr other.exr -o refused.exr
    expect_status 3 && expect_message 'other.exr: bands of one picture have its whole size' && expect_no_file refused.exr
}
check 'bands__of_another_size__refused' wrong_bands
too_many() {
    run task 1 bands=6 turning.pov +W64 +H150 -o 'refused-%.exr'
    expect_status 2 && grep -qF '150 rows are at most 5 bands' err && expect_no_file refused-1.exr
}
check 'bands__more_than_blocks__refused' too_many
failed_task() {
    run task 7 frames missing.pov -o missing.png
    expect_status 3 && grep -qF 'task 7 failed (exit status 3), again: sbatch --array=7 povgloss-array.sbatch frames missing.pov' out
}
check 'task__that_fails__names_itself' failed_task

# ---- a real Slurm

for tool in slurmctld slurmd sbatch; do
    command -v $tool > /dev/null || {
        tests=$((tests + 1))
        echo "ok $tests - slurm # SKIP no $tool (make slurm)"
        end_of_tests
        exit
    }
done
mkdir state
port=$((20000 + RANDOM % 10000))
cat > slurm.conf << END
ClusterName=povgloss
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=$port
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool-%n
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd-%n.pid
KillWait=5
NodeName=n[1-2] NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=1
PartitionName=all Nodes=n[1-2] Default=YES State=UP MaxTime=5
END
export SLURM_CONF=$scratch/slurm.conf
# In the foreground each is a child of this script, which ends them, come what may.
slurmctld -D > slurmctld.log 2>&1 &
daemons=($!)
for node in n1 n2; do
    slurmd -D -N $node > slurmd-$node.log 2>&1 &
    daemons+=($!)
done
stop() {
    scancel --quiet --state=RUNNING --user="$(id -un)" 2> /dev/null
    kill "${daemons[@]}" 2> /dev/null
    wait "${daemons[@]}" 2> /dev/null
    rm -rf "$scratch"
}
trap stop EXIT
for ((i = 0; i < 200; i++)); do
    [ "$(sinfo -h -o %D -t idle 2> /dev/null)" = 2 ] && break
    sleep 0.1
done
if [ "$i" -eq 200 ]; then
    tests=$((tests + 1))
    echo "ok $tests - slurm # SKIP it doesn't start here: $(grep -hi error slurmctld.log slurmd-n1.log | head -1)"
    end_of_tests
    exit
fi

# Twelve frames, the fifth of which is killed while it is drawn.
array_with_a_killed_task() {
    local job i status
    job=$(sbatch --parsable --array=1-12 povgloss-array.sbatch frames turning.ini "${size[@]}" --no-check -o turning.png) || return
    for ((i = 0; i < 1200; i++)); do
        pgrep -f '^povgloss render turning.ini .*[+]SF5 ' > /dev/null && break
        sleep 0.1
    done
    scancel "${job}_5"
    for ((i = 0; i < 1800; i++)); do
        [ -z "$(squeue -h 2> /dev/null)" ] && break
        sleep 0.1
    done
    expect_no_file turning05.png && same_frames 01 02 03 04 06 07 08 09 10 11 12
}
check 'slurm__array_with_a_killed_task__the_other_frames' array_with_a_killed_task
alone_again() {
    local again
    again=$(grep -h again: slurm-*.out) && [ "$(grep -c . <<< "$again")" -eq 1 ] || fail "again: $again" || return
    again=${again##*again: }
    timeout 120 bash -c "${again/sbatch/sbatch --wait}" && same_frames 01 02 03 04 05 06 07 08 09 10 11 12
}
check 'slurm__killed_task_alone_again__all_frames_of_a_local_run' alone_again
failing_array() {
    run timeout 120 sbatch --wait --array=2-3 povgloss-array.sbatch frames missing.pov -o missing.png
    [ "$status" -ne 0 ] && [ "$status" -ne 124 ] && [ "$(grep -h 'again:' slurm-*.out | grep -c missing.pov)" -eq 2 ]
}
check 'slurm__tasks_that_fail__are_named' failing_array
end_of_tests
