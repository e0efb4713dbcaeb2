#!/usr/bin/env bash
# Interrupted work: the status of a death by that signal, no process and no temporary folder left, an older output untouched.
# MOMENTS is at how many random moments a render is interrupted, SEED what they are drawn from.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
mkdir fake output
cat > scene.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <0, 2, -6> look_at 0 }
light_source { <-5, 8, -6> rgb 1 area_light x, y, 9, 9 }
plane { y, 0 pigment { bozo turbulence 1 } normal { bumps } finish { reflection 0.5 Gloss(50) } }
POV
library=+L$root/povscenes

# What is left after the signal; $status is the program's.
# shellcheck disable=SC2015 # neither test has a side effect
left_clean() {
    expect_status "$1" && expect_nothing_left || return 1
    [ "$(ls -A output)" = picture.png ] && [ "$(cat output/picture.png)" = 'an older picture' ] ||
        fail "written: $(ls -A output)"
}

# Waits until COMMAND succeeds, 20 seconds at most.
wait_until() {
    local tries
    for ((tries = 0; tries < 400; tries++)); do
        "$@" > /dev/null 2>&1 && return
        sleep 0.05
    done
    fail "never came true: $*"
}

# processes_in FOLDER [NAME]: the ids of the processes whose current folder is below it, and its own name.
processes_in() {
    local process
    for process in /proc/[0-9]*; do
        case $(readlink "$process/cwd") in "$1"*"${2-}") printf '%s\n' "${process#/proc/}" ;; esac
    done
}

some_run() {
    [ "$(processes_in "$TMPDIR" | wc -l)" -ge "$1" ]
}

# start COMMAND...: in the background, but with input and signals as in the foreground.
start() {
    printf 'an older picture\n' > output/picture.png
    : > out
    env --default-signal=INT,TERM,HUP "$@" <&0 > out 2> err &
    started=$!
}

# It ends, within so many seconds; what hasn't after 60 more is killed.
finish() {
    local began=$SECONDS
    while kill -0 "$started" 2> /dev/null && [ $((SECONDS - began)) -le $(($1 + 60)) ]; do
        sleep 0.02
    done
    kill -KILL "$started" 2> /dev/null
    wait "$started"
    status=$?
    [ $((SECONDS - began)) -le "$1" ] || fail "took $((SECONDS - began)) seconds to end"
}

# The fake one says how far it is and then does nothing for long.
cat > fake/povray << 'SH'
#!/bin/sh
printf 'Rendered 10 of 100 pixels (10%%)\r' >&2
exec sleep 300
SH
cat > fake/deaf_povray << 'SH'
#!/bin/sh
trap '' TERM INT HUP
exec sleep 300
SH
chmod +x fake/*

# interrupt SIGNAL STATUS SECONDS POVRAY: all of the first processes are running when the signal comes.
interrupt() {
    start "$bin/povgloss" render scene.pov "$library" +W1600 +H1200 --povray "$4" --jobs 3 -o output/picture.png
    wait_until some_run 3 || return 1
    kill "-$1" "$started"
    finish "$3" && left_clean "$2"
}

for signal in INT:130 TERM:143 HUP:129; do
    check "SIG${signal%:*} while a slow povray runs" interrupt "${signal%:*}" "${signal#*:}" 2 "$scratch/fake/povray"
    check "SIG${signal%:*} while the real one runs" interrupt "${signal%:*}" "${signal#*:}" 5 povray
done
check "SIGTERM while povray ignores it" interrupt TERM 143 9 "$scratch/fake/deaf_povray"

interrupt_twice() {
    start "$bin/povgloss" render scene.pov "$library" --povray "$scratch/fake/deaf_povray" --jobs 2 -o output/picture.png
    wait_until some_run 2 || return 1
    kill -INT "$started"
    sleep 0.2
    kill -INT "$started" 2> /dev/null
    finish 6 && left_clean 130
}
check "an impatient second SIGINT" interrupt_twice

# The terminal sends it to povray too.
interrupt_group() {
    printf 'an older picture\n' > output/picture.png
    set -m
    env --default-signal=INT "$bin/povgloss" render scene.pov "$library" +W1600 +H1200 --jobs 3 -o output/picture.png \
        > out 2> err &
    started=$!
    set +m
    wait_until some_run 3 || return 1
    kill -INT -- "-$started"
    finish 5 && left_clean 130
}
check "SIGINT from the keyboard, to all processes" interrupt_group

# The base's takes longest: it doesn't end by itself meanwhile.
kill_one() {
    start "$bin/povgloss" render scene.pov "$library" +W1600 +H1200 --jobs 3 --quiet -o output/picture.png
    wait_until some_run 3 || return 1
    kill -KILL "$(processes_in "$TMPDIR" base | head -n 1)"
    finish 5 && left_clean 4 || return 1
    grep -q 'exit status 137 in the [a-z-]* pass' err || { cat err; return 1; }
}
check "one povray is killed" kill_one

# ---- at any moment

small=("$bin/povgloss" render scene.pov "$library" +W48 +H36 --quiet --format png)
whole_render_ms() {
    local began
    "${small[@]}" -o expected.png || return 1
    began=$(date +%s%N)
    "${small[@]}" -o expected.png || return 1
    echo $((($(date +%s%N) - began) / 1000000))
}

# The signal may come when all is done: then the picture is the new one.
interrupt_at_random() {
    local moment signal number ms left interrupted=0
    RANDOM=$seed
    for ((moment = 1; moment <= moments; moment++)); do
        ms=$((RANDOM % (whole_ms + whole_ms / 8 + 1))) signal=$((RANDOM % 3))
        number=$(set -- 2 15 1; shift "$signal"; echo "$1")
        start "${small[@]}" -o output/picture.png
        sleep "$(printf '%d.%03d' $((ms / 1000)) $((ms % 1000)))"
        kill "-$number" "$started" 2> /dev/null
        finish 9 || return 1
        if [ "$status" -eq 0 ]; then
            cmp output/picture.png expected.png || return 1
        else
            interrupted=$((interrupted + 1))
            expect_status $((128 + number)) && [ "$(cat output/picture.png)" = 'an older picture' ] || {
                echo "signal $number after $ms ms, moment $moment of seed $seed"
                return 1
            }
        fi
        left=$(ls -A "$TMPDIR" output | grep -vx -e picture.png -e '.*:' -e '')
        [ -z "$left" ] || fail "left: $left; signal $number after $ms ms, moment $moment of seed $seed" || return 1
    done
    [ -z "$(find . -name '*.pov-state')" ] || fail "left: $(find . -name '*.pov-state')" || return 1
    [ "$interrupted" -gt 0 ] || fail "no render was interrupted" || return 1
    expect_nothing_left
}
moments=${MOMENTS:-20} seed=${SEED:-$$}
whole_ms=$(whole_render_ms)
check "a signal at $moments random moments of $whole_ms ms, seed $seed" interrupt_at_random

# ---- glossfilter, and the filter of povgloss

oiiotool --pattern fill:topleft=0,0,0:bottomright=9,1,9 2600x2600 3 --chnames P.X,P.Y,P.Z \
    --create 2600x2600 3 --addc 0.5 --chnames specular.R,specular.G,specular.B --chappend \
    --create 2600x2600 4 --addc 0,3,0,1 --chnames endpoint.X,endpoint.Y,endpoint.Z,endpoint.W --chappend \
    -d float --compression none --attrib:type=float[3] povgloss:eye 4,4,-4 --attrib:type=float povgloss:viewAngle 1 \
    -o big.exr

# What is built before the sums isn't interrupted: 2 s for so large a picture, several times that in a sanitized build.
case $bin in
    */sanitize-*) seconds=20 ;;
    *) seconds=4 ;;
esac

# interrupt_filter SIGNAL STATUS: after a second, which is less than this lobe takes.
interrupt_filter() {
    start "$bin/glossfilter" big.exr --phong 60 -o output/picture.png
    sleep 1
    kill "-$1" "$started" || fail "it has ended already: $(cat err)" || return 1
    finish "$seconds" && left_clean "$2"
}
for signal in INT:130 TERM:143 HUP:129; do
    check "SIG${signal%:*} while glossfilter filters" interrupt_filter "${signal%:*}" "${signal#*:}"
done

interrupt_reading() {
    mkfifo fifo
    printf 'an older picture\n' > output/picture.png
    sleep 300 > fifo &
    local writer=$!
    start "$bin/glossfilter" - -o output/picture.png < fifo
    sleep 0.3
    kill -INT "$started"
    finish 2 && left_clean 130
    local result=$?
    kill "$writer"
    return "$result"
}
check "SIGINT while glossfilter waits for its input" interrupt_reading
end_of_tests
