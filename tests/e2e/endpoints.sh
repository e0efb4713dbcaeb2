#!/usr/bin/env bash
# Decoded positions and endpoints against POV-Ray's own trace() in double precision: within 1e-5 of the scene's size (about
# 10 units), misses as directions.
. tests/e2e/lib.sh

size=(+W160 +H120)

trace_points() {
    (cd "$scratch" && povray "+I$root/tests/scenes/points_trace.pov" "+L$root/tests/scenes" "+L$root/povscenes" \
        +Otrace.png "${size[@]}" -D) > "$scratch/log" 2>&1 || { tail -5 "$scratch/log"; return 1; }
}

render_points() {
    "$bin/povgloss" passes tests/scenes/points.pov +Lpovscenes "${size[@]}" --quiet -o "$scratch/points.exr"
}

check 'trace__points__written' trace_points
check 'passes__points__written' render_points
check 'passes__positions_and_endpoints__agree_with_trace' \
    "${TOOLS:-build/tests/tools}/compare_points" "$scratch/points.exr" "$scratch/points.txt" 10 1e-5
end_of_tests
