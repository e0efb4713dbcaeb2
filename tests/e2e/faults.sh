#!/usr/bin/env bash
# Every call that can fail, failing in turn: the exit status, one message by the program, nothing left, and an older output
# as it was; or the right picture. FAULTS is how many points of each kind are tried at most, evenly spread ("all": each).
. tests/e2e/lib.sh
tools=$(realpath "${TOOLS:-build/tests/tools}")
faults=${FAULTS:-10}
if ldd "$bin/povgloss" | grep -qE 'lib[at]san'; then
    echo 'ok 1 - faults # SKIP a sanitizer stands before the calls that are to fail'
    echo 1..1
    exit
fi

cd "$scratch" || exit 1
mkdir fake output
cat > scene.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <0, 2, -6> look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
#declare F = finish { reflection 0.5 Gloss(50) }
plane { y, 0 pigment { rgb 0.3 } finish { F } }
POV
library=+L$root/povscenes
size=(+W8 +H6 -A --quiet)
"$bin/povgloss" render scene.pov "$library" "${size[@]}" --keep kept -o good.exr
"$bin/povgloss" passes scene.pov "$library" "${size[@]}" -o passes.exr

# The images that POV-Ray rendered before.
cat > fake/povray << SH
#!/bin/sh
cp "$scratch/kept/\${PWD##*/}"/image.* .
SH
chmod +x fake/povray
export PATH=$scratch/fake:$PATH

# faulty KIND:NUMBER OUTPUT COMMAND...: $hit says whether the program came to the fault; OUTPUT may be "".
faulty() {
    local fault=$1 output=$2
    shift 2
    rm -f log output/* output/.povgloss*
    [ -z "$output" ] || printf 'an older picture\n' > "$output"
    timeout 60 env "FAULT=$fault" "FAULT_LOG=$scratch/log" "LD_PRELOAD=$tools/faults.so" "$@" > out 2> err
    status=$?
    [ -e log ] && hit=yes || hit=no
}

# One line, but for warnings.
one_message() {
    local line
    line=$(grep -v "^$1: warning: " err) && [[ $line == "$1: "* && $line != *$'\n'* ]]
}

# shellcheck disable=SC2015 # neither test has a side effect
as_it_should_be() {
    local fault=$1 output=$2 program=${3##*/} left
    left=$(ls -A "$TMPDIR")
    # What can't be removed is told; where the rest went well, the picture is as good.
    if [ -n "$left" ]; then
        [[ $fault == remove* || $fault == open* ]] && grep -q "^$program: warning: $TMPDIR/$left: " err ||
            fail "left in TMPDIR: $left" || return 1
        rm -rf "${TMPDIR:?}/$left"
    fi
    if [ "$status" -eq 0 ]; then
        [ -z "$output" ] || cmp "$output" "expected-${output##*/}" || return 1
        [ -n "$output" ] || cmp out expected-out || return 1
    else
        [[ $status -eq 3 || $status -eq 4 ]] || fail "exit status $status" || return 1
        one_message "$program" || fail "no message" || return 1
        # OpenEXRCore doesn't tell zlib's lack of memory from a damaged chunk.
        [[ $fault != memory* ]] || grep -q -e 'memory' -e 'Corrupt data block' err || fail "no word of memory" || return 1
        [ -z "$output" ] || [ "$(cat "$output")" = 'an older picture' ] || fail "$output isn't the older one" || return 1
    fi
    [[ $fault == remove* ]] || [ -z "$(find output -name '.povgloss*')" ] || fail "left in output: $(ls -A output)"
}

# points COUNT: the numbers from 1 to COUNT, or as many of them as are to be tried.
points() {
    local wanted=$faults
    if [ "$wanted" = all ] || [ "$1" -le "$wanted" ]; then
        seq 1 "$1"
    else
        awk -v count="$1" -v wanted="$wanted" 'BEGIN { for (i = 0; i < wanted; i++) print 1 + int(i * count / wanted) }'
    fi
}

# each_fails KIND OUTPUT COMMAND...: once, and from then on.
each_fails() {
    local kind=$1 output=$2 count number after
    shift 2
    faulty "$kind:0" "$output" "$@"
    [ "$status" -eq 0 ] && [ "$hit" = yes ] || fail "without a fault: exit status $status: $(cat err)" || return 1
    count=$(cat log)
    [ "$count" -gt 0 ] || fail "no call of this kind" || return 1
    [ -z "$output" ] || cp "$output" "expected-${output##*/}"
    [ -n "$output" ] || cp out expected-out
    # Bytes are many.
    [ "$kind" != space ] || [ "$faults" != all ] || local faults=300
    for number in $(points "$count"); do
        for after in '' +; do
            faulty "$kind:$number$after" "$output" "$@"
            as_it_should_be "$kind" "$output" "$@" || fail "at $kind:$number$after of $count: $(cat err)" || return 1
        done
    done
    expect_nothing_left
}

for kind in memory read write close rename open thread space; do
    check "glossfilter__${kind}_fails__message_and_nothing_left" \
        each_fails "$kind" output/picture.png "$bin/glossfilter" passes.exr --threads 2 -o output/picture.png
done
check "glossfilter_draft__memory_fails__message_and_nothing_left" \
    each_fails memory output/picture.png "$bin/glossfilter" passes.exr --quality draft --threads 2 -o output/picture.png
check "glossfilter_exr__memory_fails__message_and_nothing_left" \
    each_fails memory output/picture.exr "$bin/glossfilter" passes.exr --layers --mode paper --weights table -o output/picture.exr
for kind in memory read close open write; do
    check "list__${kind}_fails__message_and_nothing_left" each_fails "$kind" "" "$bin/povgloss" list scene.pov "$library"
done
for kind in memory read write close rename open folder remove pipe spawn thread wait space; do
    check "render__${kind}_fails__message_and_nothing_left" \
        each_fails "$kind" output/picture.exr "$bin/povgloss" render scene.pov "$library" "${size[@]}" -o output/picture.exr
done
for kind in memory close; do
    check "passes__${kind}_fails__message_and_nothing_left" \
        each_fails "$kind" output/p.exr "$bin/povgloss" passes scene.pov "$library" "${size[@]}" -o output/p.exr
done
end_of_tests
