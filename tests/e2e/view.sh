#!/usr/bin/env bash
# glossfilter --view on a screen of its own (Xvfb), by real key presses and the mouse: what the window shows is what
# glossfilter writes for the roughness in the title.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
viewer=$bin/../lib/povgloss/view
without_sdl() {
    mkdir -p alone/bin && cp "$bin/glossfilter" alone/bin
    run alone/bin/glossfilter passes.exr --view
    expect_status 3 && expect_message 'built without SDL2: install libsdl2-dev' && expect_one_line glossfilter
}
check 'view__not_built__says_so' without_sdl
refused() {
    run "$bin/glossfilter" passes.exr --view "$@"
    expect_status 2 && expect_message 'leave out --check and --sheet' && expect_one_line glossfilter
}
check 'view__with_check__refused' refused --check
check 'view__with_sheet__refused' refused --sheet 3,4 -o refused.png
for tool in Xvfb xdotool import "$viewer"; do
    command -v "$tool" > /dev/null || {
        tests=$((tests + 1))
        echo "ok $tests - view # SKIP no $(basename "$tool")"
        end_of_tests
        exit
    }
done

"$bin/povgloss" passes "$root/povscenes/interior.pov" "+L$root/povscenes" +W160 +H120 -A --quiet --no-check -o passes.exr ||
    exit 1
unset DISPLAY WAYLAND_DISPLAY
export ASAN_OPTIONS=detect_leaks=0 SDL_VIDEODRIVER=x11 # X11 and its drivers leak
no_screen() {
    run "$bin/glossfilter" passes.exr --view
    expect_status 3 && expect_message '--view: no window can be opened' && expect_one_line glossfilter
}
check 'view__no_screen__says_so' no_screen

Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp -noreset 3> display > xvfb.log 2>&1 &
xvfb=$!
trap 'kill $xvfb 2> /dev/null; wait $xvfb 2> /dev/null; rm -rf "$scratch"' EXIT
for ((i = 0; i < 100; i++)); do
    [ -s display ] && break
    sleep 0.1
done
DISPLAY=:$(cat display)
export DISPLAY
"$bin/glossfilter" passes.exr --roughness 0.3 --view -o saved.png > out 2> err &
viewing=$!

find_window() {
    window=$(xdotool search --name '^passes.exr: ' 2> /dev/null | tail -1)
    [ -n "$window" ]
}
# Until the title is TITLE: the whole picture is there.
wait_for() {
    local i title=
    for ((i = 0; i < 300; i++)); do
        find_window && title=$(xdotool getwindowname "$window") && [ "$title" = "passes.exr: $1" ] && return
        sleep 0.1
    done
    fail "the title is '$title', not '$1'"
    cat err
    return 1
}
shows() {
    wait_for "$1" && sleep 0.3 && import -window "$window" shot.png && "$bin/glossfilter" passes.exr "${@:2}" -o expected.png || return
    oiiotool shot.png --ch 0,1,2 --cut 160x120+0+0 -o cut.png && idiff -fail 0.005 -hardfail 0.005 expected.png cut.png
}
press() {
    find_window && xdotool windowfocus "$window" key "$@"
}
check 'view__at_first__the_picture' shows 'p = 61.23, roughness 0.30' --roughness 0.3
right() {
    press Right && shows 'p = 53.64, roughness 0.31' --roughness 0.31
}
check 'view__right__rougher' right
left() {
    press Left Left && shows 'p = 70.19, roughness 0.29' --roughness 0.29
}
check 'view__left_twice__smoother' left
# The slider's track goes from 8 pixels to 8 pixels before the right side.
drag() {
    find_window && xdotool mousemove --window "$window" 60 132 mousedown 1 mousemove --window "$window" 70 132 sleep 0.2 \
        mousemove --window "$window" 80 132 sleep 0.2 mouseup 1 && shows 'p = 7.5, roughness 0.50' --roughness 0.5
}
check 'view__slider_dragged__its_roughness' drag
saves() {
    press s && wait_for 'p = 7.5, roughness 0.50, saved' && "$bin/glossfilter" passes.exr --roughness 0.5 -o expected.png &&
        cmp expected.png saved.png
}
check 'view__s__saves' saves
press Left q
wait "$viewing" # of this shell, which no test is
status=$?
check 'view__q_while_it_draws__ends' expect_status 0
interrupted() {
    "$bin/glossfilter" passes.exr --view 2> err &
    viewing=$!
    wait_for 'exponents of the passes' && kill -TERM $viewing
    wait "$viewing"
    status=$?
    expect_status 143
}
check 'view__signal__ends' interrupted
end_of_tests
