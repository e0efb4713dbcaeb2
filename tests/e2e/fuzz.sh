#!/usr/bin/env bash
# The seeds of the fuzz targets, and files that claim much more than they hold: in little time and memory.
. tests/e2e/lib.sh
replays=$(realpath "${TOOLS:-build/tests/tools}/../fuzz")
seeds=$root/tests/fuzz/seeds
cd "$scratch" || exit 1

# A sanitizer reserves addresses without end.
case $replays in
    */sanitize-*) bounded() { timeout 60 "$@"; } ;;
    *) bounded() { (ulimit -v 400000 && timeout 20 "$@"); } ;;
esac

# shellcheck disable=SC2015 # neither test has a side effect
replays_seeds() {
    local files=("$seeds/$1"/*)
    run bounded "$replays/replay_$1" "${files[@]}"
    expect_status 0 && [ "$(cat out)" = "${#files[@]} inputs" ] || show_run
}
for target in exr ppm scene command filter; do
    check "seeds__${target}__read_or_refused" replays_seeds "$target"
done

# ---- a header of WIDTH x HEIGHT pixels and CHANNELS channels, and whatever follows

number() { printf '%08x' "$1" | sed 's/\(..\)\(..\)\(..\)\(..\)/\\x\4\\x\3\\x\2\\x\1/'; }
# attribute NAME TYPE SIZE BYTES
attribute() { printf "%s\0%s\0$(number "$3")$4" "$1" "$2"; }
# header WIDTH HEIGHT CHANNELS COMPRESSION
header() {
    local box i
    box="$(number 0)$(number 0)$(number $(($1 - 1)))$(number $(($2 - 1)))"
    printf '\x76\x2f\x31\x01\x02\0\0\0'
    printf "channels\0chlist\0$(number $(($3 * 22 + 1)))"
    for ((i = 0; i < $3; i++)); do printf 'c%04d\0\x02\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0' "$i"; done
    printf '\0'
    attribute compression compression 1 "\\x0$4"
    attribute dataWindow box2i 16 "$box"
    attribute displayWindow box2i 16 "$box"
    attribute lineOrder lineOrder 1 '\0'
    attribute pixelAspectRatio float 4 '\0\0\x80\x3f'
    attribute screenWindowCenter v2f 8 "$(number 0)$(number 0)"
    attribute screenWindowWidth float 4 '\0\0\x80\x3f'
    printf '\0'
}

# bomb NAME MESSAGE
bomb() {
    run bounded "$bin/glossfilter" "$1" -o picture.png
    expect_status 3 && expect_message "$2" && expect_one_line glossfilter && expect_no_file picture.png
}
for compression in 0 3 4; do
    { header 65535 65535 10 $compression; head -c 600000 /dev/zero; } > sides-$compression.exr
    check "exr_of_65535_by_65535__compression_${compression}__refused" bomb sides-$compression.exr "can't be in"
done
header 8 8 10000 0 > channels.exr
check "exr_of_10000_channels__refused" bomb channels.exr "has 10000 channels; from 1 to 1024 are read"
header 65535 65535 1 3 > header.exr
check "exr_of_a_header_alone__refused" bomb header.exr "can't be in"
header 2000000000 1 1 3 > wide.exr
check "exr_of_2000000000_by_1__refused" bomb wide.exr "more than 65535 pixels a side"
# As many chunks as there should be, all at the same place.
{ header 4000 4000 1 3; for ((i = 0; i < 250; i++)); do printf '\0\x04\0\0\0\0\0\0'; done; head -c 40000 /dev/zero; } > offsets.exr
check "exr_with_chunks_that_overlap__refused" bomb offsets.exr "damaged or cut short"
head -c 700000000 /dev/zero > zeros.exr
check "exr_of_zeros_alone__refused" bomb zeros.exr ""

# ---- scenes

# bad_scene STATUS MESSAGE: on standard input; read by `povgloss list`.
bad_scene() {
    cat > bad.pov
    run bounded "$bin/povgloss" list bad.pov
    expect_status "$1" && expect_message "$2"
}
many() { head -c 100000 /dev/zero | tr '\0' "$1"; }
check "scene_of_100000_open_braces__refused" bad_scene 3 "bad.pov:1: more than 1000 brackets" < <(many '{')
check "scene_of_100000_open_parentheses__refused" bad_scene 3 "bad.pov:1: more than 1000 brackets" < <(many '(')
check "scene_of_100000_nested_comments__refused" bad_scene 3 "bad.pov:1" < <(yes '/*' | head -n 100000 | tr -d '\n')

# nested COUNT DEPTH WORD: spheres with blocks in blocks
nested() {
    local opened closed i
    opened=$(printf "$3 {%.0s" $(seq "$2")) closed=$(printf '}%.0s' $(seq "$2"))
    echo 'camera { location 0 look_at z }'
    for ((i = 0; i < $1; i++)); do echo "sphere { 0, 1 $opened $closed }"; done
}
# Every copy is written before the first pass fails.
rewrites_nested() {
    nested 100 900 "$1" > nested.pov
    run bounded "$bin/povgloss" list nested.pov
    expect_status 0 || return
    run bounded "$bin/povgloss" passes nested.pov --gloss all=300 --povray false -o nested.exr
    expect_status 4 && expect_message "exit status 1"
}
for word in finish texture union; do
    check "scene_of_100_times_900_nested_${word}__in_seconds" rewrites_nested "$word"
done
check "scene_that_includes_itself__read" bad_scene 0 "no finish reflects" <<< '#include "bad.pov"'
end_of_tests
