#!/usr/bin/env bash
# The programs in pipes, the passes file as the contract says, and names that are hard on command lines.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
povgloss=$bin/povgloss
glossfilter=$bin/glossfilter
library=+L$root/povscenes
size=(+W80 +H60 +A0.3)
cat > scene.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <1, 2, -6> right x*4/3 angle 60 look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
background { rgb <0.2, 0.4, 0.8> }
plane { y, 0 pigment { checker rgb 0.2 rgb 0.4 } finish { reflection { 0.2, 0.7 } Gloss(80) } }
sphere { y, 1 pigment { rgb <0.9, 0.5, 0.1> } finish { reflection 0.3 Gloss(20) } }
POV

# With a failure anywhere in the pipe as its status.
passes_to() {
    set -o pipefail
    "$povgloss" passes scene.pov "$library" "${size[@]}" --quiet -o - | "$glossfilter" - -o - "$@"
}
render() {
    "$povgloss" render scene.pov "$library" "${size[@]}" --quiet "$@"
}

# pipe_is_render OPTION...: bit for bit.
pipe_is_render() {
    passes_to "$@" > pipe.image && render -o render.image "$@" && cmp pipe.image render.image && expect_nothing_left
}
check "passes | glossfilter is render, PNG" pipe_is_render --format png
check "passes | glossfilter is render, EXR with other options" pipe_is_render --format exr --mode paper --weights table --energy 0.9 --layers
check "passes | glossfilter is render, 16 bits" pipe_is_render --format png --bits 16 --phong 300 --threads 3

to_standard_output() {
    render --format png -o - > stdout.png && render -o file.png && cmp stdout.png file.png
}
check "render to standard output is render to a file" to_standard_output
by_name() {
    render --format png -o /dev/stdout | cat > named.png && cmp named.png file.png
}
check "render to /dev/stdout" by_name

"$povgloss" passes scene.pov "$library" "${size[@]}" --quiet -o passes.exr
# layers_are LAYERS OPTION...
layers_are() {
    "$glossfilter" passes.exr --layers -o layers.exr "${@:2}" &&
        oiiotool --info -v layers.exr | grep -qx "    channel list: R, G, B, $1"
}
check "--layers of the best filter" layers_are "confidence.V, glossy.R, glossy.G, glossy.B"
check "--layers of the paper's" layers_are "glossy.R, glossy.G, glossy.B, radius.V" --mode paper
same_from_file() {
    "$glossfilter" passes.exr -o from-file.png && cmp from-file.png file.png &&
        "$glossfilter" - --format png -o from-stdin.png < passes.exr && cmp from-stdin.png file.png &&
        "$glossfilter" /dev/stdin -o from-device.png < passes.exr && cmp from-device.png file.png
}
check "the passes file gives the same picture again" same_from_file

# ---- the passes file

as_in_the_contract() {
    local line eye='(1|1[.]000.*|0[.]999.*), (2|2[.]000.*|1[.]999.*), -(6|6[.]000.*|5[.]999.*)'
    oiiotool --info -v passes.exr > info
    for line in '80 x +60, 17 channel, float openexr' 'compression: "zip"' "povgloss:eye: $eye" \
        'povgloss:viewAngle: 1[.]04[67]' 'povgloss:version: "[0-9.]+"'; do
        grep -qE "$line" info || { echo "not in the passes file: $line"; cat info; return 1; }
    done
    sed -n 's/.*channel list: //p' info | tr -d ' ' | tr ',' '\n' | sort > channels
    printf '%s\n' R G B specular.{R,G,B} reflectance.{R,G,B} P.{X,Y,Z} endpoint.{X,Y,Z,W} phong.V | sort | diff - channels
}
check "channels, type, compression and attributes" as_in_the_contract

# Pixel X Y: the values of the named channels.
values() {
    oiiotool passes.exr --ch "$3" --cut "1x1+$1+$2" --printstats | sed -n 's/.*Stats Avg: *//p' | sed 's/ (float)//'
}
# near WANTED GOT: numbers within 0.01.
near() {
    paste <(tr ' ' '\n' <<< "$1") <(tr ' ' '\n' <<< "$2") |
        awk '{ d = $1 - $2; if (NF != 2 || d > 0.01 || d < -0.01) exit bad = 1 } END { exit bad }' || fail "wanted $1, got $2"
}
check "exponent and height of the floor" near "80 0" "$(values 5 55 phong.V,P.Y)"
check "the floor's mirrored ray ends in a direction" near "0" "$(values 5 55 endpoint.W)"
check "exponent of the ball" near "20" "$(values 40 20 phong.V)"
check "nothing in the background" near "0 0 0 0" "$(values 2 2 phong.V,specular.R,P.Z,endpoint.W)"

# ---- other exponents without POV-Ray

without_povray() {
    local name=$1
    shift
    env "PATH=$scratch/none" "$glossfilter" passes.exr -o "$name.exr" "$@"
}
differs_by() {
    oiiotool -a --diff "$1" "$2" | awk -v low="$3" -v high="$4" \
        '/RMS error/ { seen = 1; print; exit !($4 >= low && $4 <= high) } END { if (!seen) exit 1 }'
}
mkdir none
other_exponents() {
    without_povray own && without_povray mirror --phong inf && without_povray zero --roughness 0 &&
        without_povray p300 --phong 300 && without_povray rough --roughness 0.2 && without_povray p312 --phong=312
}
check "glossfilter with other exponents" other_exponents
check "--phong inf is --roughness 0" cmp mirror.exr zero.exr
check "--roughness 0.2 is --phong 312" cmp rough.exr p312.exr
check "--phong 300 isn't the scene's own" differs_by own.exr p300.exr 0.004 1
check "--phong inf isn't --phong 300" differs_by mirror.exr p300.exr 0.002 1

# ---- ends of pipes

# closed COMMAND...: the reader goes away after ten bytes; the writer ends soon, with a word of it or killed by SIGPIPE.
closed() {
    local codes
    timeout 30 "$@" 2> err | head -c 10 > /dev/null
    codes=("${PIPESTATUS[@]}")
    expect_nothing_left || return 1
    case ${codes[0]} in
        141) ;;
        3) grep -q 'standard output: cannot be written: Broken pipe' err ;;
        *) fail "exit status ${codes[0]}: $(cat err)" ;;
    esac
}
# Larger than what a pipe holds.
oiiotool passes.exr --resize 1000x1000 --attrib:type=string compression none -o large.exr
check "passes into a closed pipe" closed "$povgloss" passes scene.pov "$library" +W200 +H150 --quiet -o -
check "render into a closed pipe" \
    closed "$povgloss" render scene.pov "$library" +W300 +H200 --quiet --subsample 4 --phong inf \
    --format exr -o -
check "glossfilter into a closed pipe" closed "$glossfilter" large.exr --phong inf --format exr -o -

no_input() {
    run "$glossfilter" - --format png -o x.png <&-
    expect_status 3 && expect_message "standard input: " && expect_no_file x.png || return 1
    run "$glossfilter" - --format png -o x.png < /dev/null
    expect_status 3 && expect_message "standard input: " && expect_no_file x.png
}
check "glossfilter without standard input" no_input
no_streams() {
    "$povgloss" render scene.pov "$library" "${size[@]}" -o closed.png <&- && cmp closed.png file.png || return 1
    "$povgloss" render scene.pov "$library" "${size[@]}" -o closed.png <&- >&- 2>&- && cmp closed.png file.png
}
check "povgloss without standard input, output and error" no_streams
no_output() {
    "$povgloss" render scene.pov "$library" "${size[@]}" --format png -o - >&- 2> err
    status=$?
    : > out
    if [ "$status" -ne 3 ] || ! grep -q '^povgloss: standard output' err; then fail "status $status: $(cat err)"; fi
}
check "povgloss to a standard output that is closed" no_output

# ---- names

# The scene includes a file from a +L folder and one beside it, both under the same sort of name.
named() {
    local name=$1 folder="$scratch/names/$1"
    mkdir -p "$folder/$name lib" "$folder/out"
    printf '#declare Height = 0;\n' > "$folder/$name lib/$name a.inc"
    printf '#declare Shade = 0.3;\n' > "$folder/$name b.inc"
    printf '+W40\n+H30\n' > "$folder/$name.ini"
    {
        sed 4q scene.pov
        printf '#include "%s a.inc"\n#include "%s b.inc"\n' "$name" "$name"
        printf 'light_source { <-5, 8, -6> rgb 1 }\n'
        printf 'plane { y, Height pigment { rgb Shade } finish { reflection 0.5 Gloss(50) } }\n'
        printf 'sphere { y, 1 }\n'
    } > "$folder/$name.pov"
    cd "$folder" || return 1
    "$povgloss" render "./$name.pov" "$library" "+L$name lib" "./$name.ini" --quiet -o "out/$name.png" || return 1
    [ "$(ls -A out)" = "$name.png" ] || fail "written: $(ls -A out)" || return 1
    expect_nothing_left
}
# shellcheck disable=SC2016 # a name with a dollar sign
for name in 'two words' "it's" 'Grüße 日本' '-dash' '--dashes' '+plus' 'blanks  ; $x #,@~&%s UPPER' '$(touch ran) `touch ran`|touch ran'; do
    check "files named <$name>" named "$name"
done
from_elsewhere() {
    local folder='names/two words'
    "$povgloss" render "$scratch/$folder/two words.pov" "$library" "+L$scratch/$folder/two words lib" +W40 +H30 --quiet \
        -o elsewhere.png && cmp elsewhere.png "$folder/out/two words.png"
}
check "the same by whole paths" from_elsewhere
named_quote() {
    mkdir 'quo"te'
    cp scene.pov 'quo"te/sc"ene.pov'
    "$povgloss" render 'quo"te/sc"ene.pov' "$library" "${size[@]}" --quiet -o 'quo"te/out".png' && cmp 'quo"te/out".png' file.png
}
check "files named with double quotes" named_quote

# POV-Ray's strings end at a newline, so that nothing is included by this name.
named_newline() {
    local folder=$'-new\n$(touch ran)\nline'
    mkdir -- "$folder"
    cp scene.pov "./$folder/$folder.pov"
    "$povgloss" render "./$folder/$folder.pov" "$library" "+L./$folder" "${size[@]}" --quiet --keep "./$folder/kept" \
        -o "./$folder/$folder.png" && cmp -- "./$folder/$folder.png" file.png
}
check "files named with newlines" named_newline
no_shell_ran() {
    local ran
    ran=$(find "$scratch" -name ran)
    [ -z "$ran" ] || fail "a shell ran: $ran"
}
check "none of these names is a command" no_shell_ran

temporary_folder() {
    mkdir 'tmp = "x" é'
    TMPDIR="$scratch/tmp = \"x\" é" render -o odd-tmp.png && cmp odd-tmp.png file.png && rmdir 'tmp = "x" é'
}
check "a TMPDIR with an odd name" temporary_folder
end_of_tests
