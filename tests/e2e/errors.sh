#!/usr/bin/env bash
# What goes wrong in scenes, files and folders: the exit status, a message that names the user's own file and the cure,
# and nothing left: no temporary file, no process, no output; an older output stays as it was.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
mkdir scenes scenes/parts output
size=(+W40 +H30 -A)
povgloss=("$bin/povgloss")
library=+L$root/povscenes

cat > scenes/glossy.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <0, 2, -6> look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
plane { y, 0 pigment { rgb 0.3 } finish { reflection 0.5 Gloss(50) } }
POV

# fails STATUS MESSAGE COMMAND...: the command would write output/picture.exr, which is there already.
# shellcheck disable=SC2015 # neither test has a side effect
fails() {
    local expected=$1 message=$2
    shift 2
    rm -f output/*
    printf 'an older picture\n' > output/picture.exr
    run "$@"
    expect_status "$expected" && expect_message "$message" && expect_nothing_left || return 1
    [ "$(ls -A output)" = picture.exr ] && [ "$(cat output/picture.exr)" = 'an older picture' ] ||
        fail "written: $(ls -A output)"
}

# render_fails STATUS MESSAGE SCENE: the scene's text is on standard input.
render_fails() {
    local status=$1 message=$2 scene=$3
    mkdir -p "$(dirname "$scene")"
    cat > "$scene"
    fails "$status" "$message" "${povgloss[@]}" render "$scene" "$library" "${size[@]}" --quiet -o output/picture.exr
}

# The first six lines of a scene.
head -n 5 scenes/glossy.pov > head.txt
echo '#declare F = finish { reflection 0.5 Gloss(50) }' >> head.txt

glossfilter_fails() {
    local message=$1
    shift
    fails 3 "$message" "$bin/glossfilter" "$@" -o output/picture.exr
}

# ---- scenes

check "a missing scene" \
    fails 3 "scenes/none.pov: cannot be opened: No such file" "${povgloss[@]}" render scenes/none.pov -o output/picture.exr
check "a folder as the scene" fails 3 "scenes: " "${povgloss[@]}" render scenes -o output/picture.exr
check "a parse error in the scene" render_fails 4 "File 'scenes/wrong.pov' line 8: Parse Error" scenes/wrong.pov < <(
    cat head.txt
    printf 'plane { y, 0\n  pigmint { rgb 1 } finish { F } }\n'
)
check "a parse error after blocks of many lines" render_fails 4 "File 'scenes/long.pov' line 17: Parse Error" \
    scenes/long.pov < <(
    cat head.txt
    printf 'plane { y, 0\n  texture {\n    pigment {\n      rgb 0.4\n    }\n    finish {\n      F\n    }\n  }\n}\n  box { oops }\n'
)
# Each pass rewrites the scene in its own way: here only one of them gets as far as the error. Some wait for the endpoints.
mkdir one-pass
"${povgloss[@]}" passes scenes/glossy.pov "$library" "${size[@]}" --quiet --keep one-pass/kept -o one-pass/kept.exr
cat > one-pass/povray << SH
#!/bin/sh
case "\$(basename "\$PWD")" in
    "\$PASS") ;;
    endpoint) exec cp "$scratch/one-pass/kept/endpoint/image.ppm" . ;;
    *) exec sleep 60 ;;
esac
exec $(command -v povray) "\$@"
SH
chmod +x one-pass/povray
for pass in base specular reflectance position; do
    check "the line of a parse error in the $pass pass" fails 4 "File 'scenes/long.pov' line 17: Parse Error" \
        env "PASS=$pass" "${povgloss[@]}" render scenes/long.pov "$library" "${size[@]}" --quiet --jobs 9 \
        --povray "$scratch/one-pass/povray" -o output/picture.exr
done
cat > scenes/parts/wrong.inc << 'POV'
// A part with an error.
#declare Part = sphere {
  0, 1
  pigment {
    colour nonsense
  }
}
POV
check "a parse error in an include in a subfolder" \
    render_fails 4 "scenes/parts/wrong.inc' line 5: Parse Error" scenes/includes.pov < <(
    cat head.txt
    printf '#include "parts/wrong.inc"\nplane { y, 0 finish { F } }\nobject { Part }\n'
)
check "a parse error in an include found by +L" fails 4 "parts/wrong.inc' line 5: Parse Error" \
    "${povgloss[@]}" render scenes/includes.pov "$library" "${size[@]}" +Lscenes --quiet -o output/picture.exr
check "an include that is nowhere" render_fails 4 "line 7" scenes/nowhere.pov < <(
    cat head.txt
    printf '#include "no-such-file.inc"\nplane { y, 0 finish { F } }\n'
)
check "an #error of the scene's own" render_fails 4 "this scene wants a shoe size" scenes/error.pov < <(
    cat head.txt
    printf 'plane { y, 0 finish { F } }\n#error "this scene wants a shoe size\\n"\n'
)
check "a negative exponent" render_fails 4 "a Phong exponent is 0 or more" scenes/negative.pov < <(
    cat head.txt
    printf 'plane { y, 0 finish { reflection 1 Gloss(-2) } }\n'
)
writes_no_output() {
    run "${povgloss[@]}" render scenes/wrong.pov "$library" "${size[@]}" --quiet -o new.exr
    expect_status 4 && expect_no_file new.exr .povgloss-*
}
check "a new output isn't begun" writes_no_output
check "a scene with nothing glossy" render_fails 3 "Gloss(300)" scenes/dull.pov << 'POV'
camera { location -z*5 look_at 0 }
sphere { 0, 1 pigment { rgb 1 } finish { reflection 0.3 } }
POV
check "an empty scene" render_fails 3 "Gloss(300)" scenes/empty.pov < /dev/null
check "an assumed_gamma by an expression that isn't one" render_fails 4 "scenes/gamma.pov' line 2" scenes/gamma.pov < <(
    printf '#declare H = 1.0;\nglobal_settings { assumed_gamma G }\n'
)
check "an assumed_gamma below 0" render_fails 4 "scenes/gamma.pov' line 2" scenes/gamma.pov < <(
    printf '#declare G = -1;\nglobal_settings { assumed_gamma G }\n'
)
check "a parse error in an include by a computed name" \
    render_fails 4 "parts/wrong.inc' line 5: Parse Error" scenes/computed.pov < <(
    cat head.txt
    printf '#include concat("parts/", "wrong.inc")\n'
)
check "an include by a computed name that is nowhere" render_fails 4 "scenes/computed.pov' line 7" scenes/computed.pov < <(
    cat head.txt
    printf '#include concat("no-such-file", ".inc")\n'
)
check "a file with objects that the scene writes twice" render_fails 3 "scenes/twice.pov:10: own.inc" scenes/twice.pov < <(
    cat head.txt
    printf '#for (I, 0, 1)\n#fopen File "own.inc" write #write (File, "sphere { ", I, ", 1 finish { F } }")\n#fclose File\n'
    printf '#include "own.inc"\n#end\n'
)

warns() {
    rm -f output/*
    cat > scenes/hidden.pov
    run "${povgloss[@]}" render scenes/hidden.pov "$library" "${size[@]}" "$@" -o output/picture.exr
    expect_status 0 && expect_nothing_left && [ -s output/picture.exr ]
}
warns_of_no_glossy_surface() {
    warns < scenes/hidden.txt || return 1
    grep -q "^povgloss: warning: scenes/hidden.pov: the camera sees no glossy surface" "$scratch/err" || { show_run; return 1; }
    warns --quiet < scenes/hidden.txt || return 1
    [ ! -s "$scratch/err" ] || { show_run; return 1; }
}
{
    cat head.txt
    printf 'box { -1, 1 pigment { rgb 1 } }\nsphere { <0, 0, -20>, 1 finish { F } }\n'
} > scenes/hidden.txt
check "a glossy surface that the camera doesn't see is warned of" warns_of_no_glossy_surface

# ---- POV-Ray itself

mkdir no-povray
check "no povray in PATH" fails 4 "apt-get install povray" \
    env "PATH=$scratch/no-povray" "${povgloss[@]}" render scenes/glossy.pov "$library" "${size[@]}" --quiet -o output/picture.exr
check "a povray that can't be executed" fails 4 "scenes/glossy.pov can't be started: Permission denied" \
    "${povgloss[@]}" render scenes/glossy.pov "$library" "${size[@]}" --quiet --povray "$scratch/scenes/glossy.pov" \
    -o output/picture.exr
check "a povray that isn't there" fails 4 "/none/povray" \
    "${povgloss[@]}" render scenes/glossy.pov "$library" --quiet --povray /none/povray -o output/picture.exr
check "a switch that POV-Ray doesn't know" fails 4 "Failed to parse command-line option" \
    "${povgloss[@]}" render scenes/glossy.pov "$library" +Zonk --quiet -o output/picture.exr
check "an .ini file that isn't there" fails 3 "none.ini" \
    "${povgloss[@]}" render scenes/glossy.pov "$library" none.ini --quiet -o output/picture.exr

# ---- folders. A povray that tells of its start shows that nothing was rendered in vain.

mkdir fake
cat > fake/povray << SH
#!/bin/sh
echo started >> "$scratch/started"
exit 1
SH
chmod +x fake/povray

refused_at_once() {
    local message=$1 output=$2
    shift 2
    rm -f started
    run "${povgloss[@]}" render scenes/glossy.pov "$library" "${size[@]}" --povray "$scratch/fake/povray" --quiet "$@" \
        -o "$output"
    expect_status 3 && expect_message "$message" && expect_no_file started && expect_nothing_left
}
check "the output's folder is missing" refused_at_once "mkdir -p" missing/picture.png
check "the output lies below a file" refused_at_once "Not a directory" scenes/glossy.pov/picture.png
check "the output is a folder" refused_at_once "is a folder" output --format png
printf 'kept\n' > output/old
check "--keep names a folder with something in it" refused_at_once "name a new or an empty one" x.png --keep output
check "--keep names a file" refused_at_once "scenes/glossy.pov" x.png --keep scenes/glossy.pov
check "--keep lies below a missing folder" refused_at_once "missing/keep" x.png --keep missing/keep
check "--keep left the older file alone" grep -qx kept output/old
no_tmpdir() {
    rm -f started
    TMPDIR=$scratch/missing run "${povgloss[@]}" render scenes/glossy.pov "$library" --povray fake/povray --quiet -o x.png
    expect_status 3 && expect_message "set TMPDIR" && expect_no_file started x.png
}
check "a TMPDIR that is missing" no_tmpdir

full_disk() {
    run "$@"
    expect_status 3 && expect_message "No space left" && expect_nothing_left && [ -c /dev/full ]
}
"$bin/povgloss" passes scenes/glossy.pov "$library" "${size[@]}" --quiet -o passes.exr
check "render to a full disk" \
    full_disk "${povgloss[@]}" render scenes/glossy.pov "$library" "${size[@]}" --quiet -o /dev/full --format png
check "passes to a full disk" full_disk "${povgloss[@]}" passes scenes/glossy.pov "$library" "${size[@]}" --quiet -o /dev/full
check "the depfile to a full disk" full_disk "${povgloss[@]}" render scenes/glossy.pov "$library" "${size[@]}" --quiet \
    -o picture.png --depfile /dev/full
check "probe to a full disk" \
    full_disk "${povgloss[@]}" probe scenes/glossy.pov "$library" "${size[@]}" --quiet --grid 2 -o /dev/full
check "brute to a full disk" \
    full_disk "${povgloss[@]}" brute scenes/glossy.pov "$library" "${size[@]}" --quiet -o /dev/full --format png
check "glossfilter to a full disk" full_disk "$bin/glossfilter" passes.exr -o /dev/full --format exr

# on_small_disk KB FOLDER COMMAND...: with a disk of that size at FOLDER, which is left as it is outside; what is in it
# afterwards is listed in the file `left`.
on_small_disk() {
    local size=$1 folder=$2
    shift 2
    # shellcheck disable=SC2016 # the inner shell's own
    unshare -rm bash -c '
        mount -t tmpfs -o "size=$1k" tmpfs "$2" || exit 99
        printf "an older picture\n" > output/picture.exr
        "${@:4}"
        status=$?
        find "$2" -mindepth 1 ! -name picture.exr > "$3/left"
        cp output/picture.exr "$3/picture.exr"
        exit $status' - "$size" "$folder" "$scratch" "$@"
}
# shellcheck disable=SC2015 # neither test has a side effect
small_disk() {
    local folder=$1 kb failures=0
    shift
    rm -f output/*
    for kb in 8 16 32 64 128 256 512 1024 2048 4096; do
        run on_small_disk "$kb" "$folder" timeout 60 "$@"
        [ ! -s left ] || fail "left on a disk of $kb kB: $(cat left)" || return 1
        [ "$status" -ne 0 ] || continue
        failures=$((failures + 1))
        [[ $status -eq 3 || $status -eq 4 ]] && [ -s "$scratch/err" ] && [ "$(cat picture.exr)" = 'an older picture' ] ||
            { echo "a disk of $kb kB, exit status $status"; show_run; return 1; }
        grep -q -e '^[a-z]*: .*No space left' -e '^[a-z]*: .*less than 1 MB is left' "$scratch/err" ||
            { echo "a disk of $kb kB"; show_run; return 1; }
    done
    [ "$status" -eq 0 ] && [ "$failures" -gt 0 ] || { echo "exit status $status, $failures failures"; show_run; return 1; }
}
if unshare -rm mount -t tmpfs tmpfs output 2> /dev/null; then
    check "the temporary folder's disk fills up" small_disk "$TMPDIR" \
        "${povgloss[@]}" render scenes/glossy.pov "$library" +W160 +H120 -A --quiet -o output/picture.exr
    check "the output's disk fills up" small_disk "$scratch/output" \
        "${povgloss[@]}" passes scenes/glossy.pov "$library" +W160 +H120 -A --quiet -o output/picture.exr
else
    tests=$((tests + 1))
    echo "ok $tests - a disk fills up # SKIP no tmpfs can be mounted here"
fi

# Each writes a file of its own and puts it in place.
two_at_once() {
    local render=("${povgloss[@]}" render scenes/glossy.pov "$library" "${size[@]}" --quiet) first second
    rm -f output/*
    "${render[@]}" -o expected.exr || return 1
    "${render[@]}" -o output/picture.exr & first=$!
    "${render[@]}" -o output/picture.exr & second=$!
    wait "$first" && wait "$second" && cmp expected.exr output/picture.exr && expect_nothing_left &&
        [ "$(ls -A output)" = picture.exr ]
}
check "two runs with the same output" two_at_once

kept() {
    run "${povgloss[@]}" render scenes/glossy.pov "$library" "${size[@]}" --quiet --keep keep -o output/picture.png
    expect_status 0 && expect_nothing_left && [ -s keep/base/image.exr ] && [ -s keep/copies/plain-000-glossy.pov ]
}
check "--keep leaves scenes and images" kept

# ---- passes files

oiiotool passes.exr --ch R,G,B,specular.R,specular.G,specular.B,P.X,P.Y,P.Z,phong.V -o no-endpoint.exr
oiiotool passes.exr --compression dwaa -o dwaa.exr
head -c $(($(stat -c %s passes.exr) / 2)) passes.exr > half.exr
head -c 6 passes.exr > six-bytes.exr
: > nothing.exr
check "a passes file without endpoints" glossfilter_fails "no-endpoint.exr: has no channel endpoint.X" no-endpoint.exr
check "a passes file in DWAA" glossfilter_fails "--compression zip" dwaa.exr
# A system that says that little memory is free; its message has both figures.
printf 'MemTotal: 9 kB\nMemAvailable: 100 kB\nSwapFree: 20 kB\n' > meminfo
little_memory=(bwrap --dev-bind / / --bind "$scratch/meminfo" /proc/meminfo)
if "${little_memory[@]}" true 2> reason; then
    check "passes that memory can't hold" fails 3 " GB are needed, and 0.00012 GB are free" "${little_memory[@]}" \
        "$bin/glossfilter" passes.exr -o output/picture.exr
else
    check "passes that memory can't hold # SKIP $(head -n 1 reason)" true
fi
check "half a passes file" glossfilter_fails "half.exr: " half.exr
check "six bytes of a passes file" glossfilter_fails "six-bytes.exr: " six-bytes.exr
check "an empty passes file" glossfilter_fails "nothing.exr: " nothing.exr
check "a text file as the passes file" glossfilter_fails "glossy.pov: " scenes/glossy.pov
check "a missing passes file" glossfilter_fails "none.exr: cannot be opened: No such file" none.exr
check "a folder as the passes file" glossfilter_fails "scenes: " scenes
check "a picture as the passes file" glossfilter_fails "has no channel" keep/base/image.exr
check "glossfilter: the output's folder is missing" fails 3 "mkdir -p" "$bin/glossfilter" passes.exr -o missing/picture.exr
end_of_tests
