#!/usr/bin/env bash
# README.md's tutorial, as a reader types it: its scene, its commands, its change of the scene.
. tests/e2e/lib.sh

PATH=$bin:$PATH
cd "$scratch" || exit 1

# blocks LANGUAGE: the tutorial's blocks of a language.
blocks() {
    sed -n '/^## Tutorial/,/^## Use/p' "$root/README.md" | awk -v open="\`\`\`$1" '
        $0 == "```" { inside = 0 }
        inside
        $0 == open { inside = 1 }'
}

# What POV-Ray prints is not for a test's output.
types() {
    blocks pov > room.pov
    blocks diff > change.diff
    # The change stands before the last block of commands.
    blocks sh | awk '/\+A0\.3/ { print "patch -s room.pov change.diff" } 1' > typed.sh
    grep -q '^patch' typed.sh && bash -eu typed.sh > typed.out 2>&1 || { cat typed.out; return 1; }
}
check "tutorial__as_typed__every_command_succeeds" types

lists() {
    grep -E '^Lacquer +room\.pov:10 +120 +0\.45$' typed.out || { cat typed.out; return 1; }
}
check "tutorial__list__the_lacquer_and_its_exponent" lists

# difference A B: RMSE of two pictures.
difference() {
    oiiotool "$1" "$2" --diff 2>&1 | sed -n 's/^ *RMS error = //p'
}

# The exponent that is written into the scene is another one than was typed first.
pictures() {
    local file
    for file in room.png soft.png crisp.png mirror.png; do
        oiiotool "$file" --stats > stats || return 1
    done
    awk -v a="$(difference soft.png crisp.png)" -v b="$(difference crisp.png mirror.png)" 'BEGIN {
        print a, b; exit !(a > 0.005 && b > 0.005) }'
}
check "tutorial__pictures__blurred_by_what_was_typed" pictures
end_of_tests
