#!/usr/bin/env bash
# --from-scene: the switches that a scene's own comment recommends; the truth is POV-Ray's render_scene.sh.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
library=+L$root/povscenes
examples=/usr/share/doc/povray/examples

# The scene's comment is on standard input.
scene() {
    {
        cat
        cat << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <0, 2, -6> look_at clock*y }
light_source { <-5, 8, -6> rgb 1 }
#declare F = finish { reflection 0.1 }
plane { y, 0 pigment { rgb 0.3 } finish { reflection 0.5 Gloss(50) } }
POV
    } > "$1"
}

# draw OUTPUT ARGUMENT...
draw() {
    run "$bin/povgloss" render "${@:2}" "$library" -o "$1"
    expect_status 0 && expect_nothing_left
}
has_size() {
    oiiotool --info "$1" | grep -q " $2 x *$3," || fail "$1: $(oiiotool --info "$1")"
}
told() {
    head -n 1 "$scratch/err" | grep -qxF "povgloss: $1" || { show_run; return 1; }
}

printf '// A scene\n//  -w48 -h36\n// +W64 +H48 +A0.3\n' | scene sizes.pov
first_line() {
    draw first.png sizes.pov --from-scene && told "sizes.pov:2: //  -w48 -h36" && has_size first.png 48 36
}
check "the first line of switches, which is told" first_line
command_line_wins() {
    draw wins.png sizes.pov +W20 --from-scene && has_size wins.png 20 36 &&
        draw wins.png +W20 --from-scene +H10 --gloss all=9 --gloss F=5 sizes.pov && has_size wins.png 20 10
}
check "the command line wins, wherever it stands" command_line_wins
quiet() {
    draw quiet.png sizes.pov --from-scene --quiet && cmp quiet.png first.png || return 1
    [ ! -s "$scratch/err" ] || { show_run; return 1; }
}
check "--quiet" quiet
from_ini() {
    printf 'Input_File_Name=sizes.pov\nHeight=10\n' > sizes.ini
    draw ini.png sizes.ini --from-scene && has_size ini.png 48 10
}
check "a scene that an .ini file names; the .ini file wins" from_ini

printf '// +W40 +H30 +KFF2 +FT Output_File_Name=nowhere/x.tga -d\n' | scene 'an animation.pov'
animation() {
    draw frames.png 'an animation.pov' --from-scene && has_size frames1.png 40 30 && has_size frames2.png 40 30 &&
        ! cmp -s frames1.png frames2.png && [ "$(echo frames*)" = "frames1.png frames2.png" ]
}
check "an animation; output file and type are povgloss's own" animation
subsampled() {
    draw subsampled.png sizes.pov --from-scene --subsample 4 && has_size subsampled.png 48 36
}
check "--subsample knows the size" subsampled

refused() {
    run "$bin/povgloss" render "${@:3}" "$library" --from-scene --povray /none/povray -o no.png
    expect_status "$1" && expect_message "$2" && expect_one_line povgloss && expect_no_file no.png
}
printf '// Nothing to see\n' | scene none.pov
check "a scene without such a comment" refused 3 "none.pov: no comment such as // +W640 +H480" none.pov
check "a scene that isn't there" refused 3 "missing.pov: cannot be opened" missing.pov
check "standard input" refused 2 "name its file in place of -" - < sizes.pov

# Nothing in the examples is glossy: povgloss tells the comment and stops.
mkdir fake
printf '#!/bin/sh\n' > fake/povray
chmod +x fake/povray
of_every_example() {
    local example
    find "$examples" -name '*.pov' | sort | while read -r example; do
        PATH=$scratch/fake:$PATH sh /usr/share/povray-3.7/scripts/render_scene.sh "$scratch" "$example" < /dev/null |
            grep -aF "$example: " >> theirs
        "$bin/povgloss" render "$example" --from-scene -o no.png 2>&1 | grep -aE '^povgloss: [^:]*:[0-9]+: //' >> ours
    done
    sed -E -i 's/^povgloss: ([^:]*):[0-9]+: \/\/ +/\1: /' ours
    [ "$(wc -l < theirs)" -gt 300 ] && diff theirs ours
}
check "every example scene of POV-Ray, as its render_scene.sh" of_every_example
end_of_tests
