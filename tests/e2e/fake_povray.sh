#!/usr/bin/env bash
# A povray that fails in ways the real one rarely does: a message that says which pass, the right exit status, nothing left.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
mkdir fake output
cat > scene.pov << 'POV'
#include "povgloss.inc"
plane { y, 0 finish { reflection 0.5 Gloss(50) } }
POV
oiiotool --create 8x6 3 -d half -o good.exr --create 9x6 3 -d half -o wrong.exr
{ printf 'P6 8 6 65535\n'; head -c $((8 * 6 * 6)) /dev/zero; } > good.ppm
{ printf 'P6 9 6 65535\n'; head -c $((9 * 6 * 6)) /dev/zero; } > wrong.ppm
head -c 60 good.ppm > cut.ppm
head -c 200 good.exr > cut.exr
printf 'not an image\n' > text.ppm

# draw OPTION...: with a povray whose commands are on standard input; $folder is its pass, $image its image's name.
draw() {
    {
        printf '#!/bin/sh\nhere=%q\n' "$scratch"
        cat << 'SH'
folder=$(basename "$PWD") image=image.exr
for argument; do case $argument in *image.ppm) image=image.ppm ;; esac; done
put() { cp "$here/$1.${image#image.}" "$image"; }
good() { put good; }
SH
        cat
    } > fake/povray
    chmod +x fake/povray
    printf 'an older picture\n' > output/picture.png
    run env "PATH=$scratch/fake:$PATH" timeout 60 "$bin/povgloss" render scene.pov "+L$root/povscenes" \
        -o output/picture.png "$@"
}

# shellcheck disable=SC2015 # neither test has a side effect
fails() {
    local expected=$1 message=$2
    shift 2
    draw "$@"
    expect_status "$expected" && expect_message "$message" && expect_nothing_left || return 1
    grep -q '^povgloss: ' "$scratch/err" || { show_run; return 1; }
    [ "$(ls -A output)" = picture.png ] && [ "$(cat output/picture.png)" = 'an older picture' ] ||
        fail "written: $(ls -A output)"
}

works() {
    draw "$@"
    expect_status 0 && expect_nothing_left && oiiotool output/picture.png -o copy.png
}
# warns_of_version TEXT: "": there isn't a word of it.
warns_of_version() {
    works || return 1
    if [ -n "$1" ]; then grep -qF "$1" "$scratch/err"; else ! grep -qF 'this is POV-Ray' "$scratch/err"; fi ||
        { show_run; return 1; }
}
check "images of the right kind: the fake is good enough" works <<< 'good'
preloaded() {
    works << 'SH' && [ -s "$scratch/preloads" ] && ! grep -vE '^\.\./preload\.so(:|$)' "$scratch/preloads"
echo "$LD_PRELOAD" >> "$here/preloads"
[ -e ../preload.so ] && good
SH
}
check "every pass has the object that shortens waits" preloaded
# The programs alone, as somebody may copy them.
programs_alone() {
    mkdir -p alone/bin && cp "$bin/povgloss" alone/bin && rm -f preloads || return 1
    bin=$PWD/alone/bin works << 'SH' && ! grep -q preload.so preloads
echo "$LD_PRELOAD" >> "$here/preloads"
good
SH
}
check "without that object it works, too" programs_alone
check "exit status 1 with a message" fails 4 "Parse Error: Hello" << 'SH'
echo "File 'pass.inc' line 3: Parse Error: Hello" >&2
exit 1
SH
check "exit status 1 without a word" fails 4 "exit status 1" <<< 'exit 1'
check "exit status 134, as on a full disk" fails 4 "exit status 134" <<< 'good; kill -ABRT $$'
check "one pass of several fails" fails 4 "exit status 7 in the endpoint pass" << 'SH'
good
[ "$folder" != endpoint ] || exit 7
SH
check "a pass fails while others run on" fails 4 "exit status 7 in the specular pass" << 'SH'
[ "$folder" != specular ] || exit 7
[ "$folder" != endpoint ] || { good; exit; }
exec sleep 300
SH
check "nothing written, exit status 0" fails 3 "/image.ppm: cannot be opened" <<< 'exit 0'
check "one image isn't written" fails 3 "reflectance/image.exr: cannot be opened" << 'SH'
[ "$folder" = reflectance ] || good
SH
check "a PPM that ends early" fails 3 "position/image.ppm: " << 'SH'
if [ "$folder" = position ]; then put cut; else good; fi
SH
check "an EXR that ends early" fails 3 "specular/image.exr: " << 'SH'
if [ "$folder" = specular ]; then put cut; else good; fi
SH
check "a text in place of a PPM" fails 3 "direction/image.ppm: not a PPM" << 'SH'
if [ "$folder" = direction ]; then put text; else good; fi
SH
check "an error in POV-Ray's own picture names the user's line" fails 4 "File 'scene.pov' line 2: Parse Error" << 'SH'
good
[ "$folder" != own ] || { echo "File 'pass.inc' line 2: Parse Error: Hello" >&2; exit 1; }
SH
check "an error in a file from a library folder names the user's file" fails 4 "File 'a.inc' line 2: Parse Error" << 'SH'
good
[ "$folder" != own ] || { echo "File '../lib0/a.inc' line 2: Parse Error: Hello" >&2; exit 1; }
SH
check "POV-Ray's own picture ends early" fails 3 "own/image.exr: " << 'SH'
if [ "$folder" = own ]; then put cut; else good; fi
SH
for pass in base specular reflectance position position-low endpoint endpoint-low; do
    check "an image of another size in the $pass pass" fails 3 "9" << SH
if [ "\$folder" = $pass ]; then put wrong; else good; fi
SH
done
check "megabytes of messages" fails 4 "exit status 3" << 'SH'
head -c 30000000 /dev/zero | tr '\0' x >&2
exit 3
SH
check "an error message longer than a line should be" fails 4 "Parse Error" << 'SH'
{ echo "File 'pass.inc' line 3: Parse Error:"; head -c 100000 /dev/zero | tr '\0' x; echo; } >&2
exit 1
SH
check "messages with bytes of no text" fails 4 "exit status 1" << 'SH'
head -c 10000 /dev/urandom >&2
printf '\0\0Parse Error: \377\376\0\n' >&2
exit 1
SH
check "a pass that hangs, with --timeout" fails 4 "longer than 1 s in the reflectance pass" --timeout 1 << 'SH'
good
[ "$folder" != reflectance ] || exec sleep 300
SH
check "a pass that hangs without standard error, with --timeout" fails 4 "longer than 1 s in the base pass" --timeout 1 << 'SH'
good
[ "$folder" != base ] || exec sleep 300 2>&-
SH
check "a pass that hangs and takes no SIGTERM, with --timeout" fails 4 "longer than 1 s" --timeout=1 << 'SH'
trap '' TERM
good
exec sleep 300
SH
check "a --timeout that is long enough" works --timeout 30 <<< 'good'
check "POV-Ray 3.8 is drawn with, and warned of" warns_of_version "this is POV-Ray 3.8.0-beta.2: povgloss is made for 3.7" << 'SH'
echo 'Persistence of Vision(tm) Ray Tracer Version 3.8.0-beta.2 (g++ 12 @' >&2
good
SH
check "POV-Ray 3.7 isn't warned of" warns_of_version "" << 'SH'
echo 'Persistence of Vision(tm) Ray Tracer Version 3.7.0.10.unofficial (g++ @' >&2
good
SH
check "POV-Ray 3.6 fails, and is named" fails 4 "this is POV-Ray 3.6.1, and povgloss needs 3.7" << 'SH'
printf 'Persistence of Vision(tm) Ray Tracer Version 3.6.1 (g++)\nFailed to parse command-line option\n' >&2
exit 1
SH
check "standard error closed early, then work" fails 3 "/image.ppm: cannot be opened" << 'SH'
exec 2>&-
sleep 0.3
SH
end_of_tests
