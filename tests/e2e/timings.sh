#!/usr/bin/env bash
# --timings: a table on standard error with a line for every step, each POV-Ray process among them.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
switches=("+L$root/povscenes" +W48 +H36 -A)
scene=$root/povscenes/contact.pov

# rows FILE STEP...: the table, alone in the file, has those steps in it, and times that fit together.
rows() {
    local file=$1 step
    shift
    for step; do
        grep -q "^$step " "$file" || { cat "$file"; return 1; }
    done
    awk 'NR == 1 { wrong += $0 !~ /^STEP +START_S +WALL_S +CPU_S$/; next }
         NF != 4 || $2 !~ /^[0-9.]+$/ || $3 !~ /^[0-9.]+$/ || $4 !~ /^[0-9.]+$/ { wrong++ }
         $1 == "total" { total = $3; all = $4; next }
         $2 + $3 > end { end = $2 + $3 }
         { cpu += $4 }
         $1 ~ /^povray:/ { povray += $4 }
         END { exit wrong || total <= 0 || end > total + 0.01 || cpu > all + 0.05 || (with_povray && povray <= 0) }' \
        with_povray="$(grep -c ^povray: "$file")" "$file" || { cat "$file"; return 1; }
}
# Without a check, for --quiet has none.
render_quiet() {
    run "$bin/povgloss" render "$scene" "${switches[@]}" --quiet --timings -o picture.png
    expect_status 0 && rows err scene passes povray:base povray:specular povray:endpoint-low decode filter compose write \
        total && ! grep -q "^povray:own" err
}
passes() {
    run "$bin/povgloss" passes "$scene" "${switches[@]}" --timings -o passes.exr
    expect_status 0 && grep -v '^povgloss: ' err > table && rows table scene povray:own check decode write total
}
filter() {
    run "$bin/glossfilter" passes.exr --timings -o picture.png
    expect_status 0 && rows err read filter compose write total
}
probe() {
    run "$bin/povgloss" probe "$scene" "${switches[@]}" --grid 4 --error 0.5 --quiet --timings -o probes.csv
    expect_status 0 && rows err scene povray:mirror povray:probe total
}
# The rays of a perspective camera are known by few of them; those of another one, of a scene in which the size matters
# and of a part of the picture are all rendered.
views() {
    sed 's/^camera {/camera { fisheye/' "$scene" > fisheye.pov
    sed 's/^camera {/#declare Pixels = image_width*image_height; camera {/' "$scene" > size.pov
    local options=("${switches[@]}" --quiet --no-check --timings -o passes.exr) other
    run "$bin/povgloss" passes "$scene" "${options[@]}"
    expect_status 0 && rows err povray:view && ! grep -q "^povray:direction" err || return 1
    for other in "fisheye.pov" "size.pov" "$scene +SR9 +ER20"; do
        # shellcheck disable=SC2086 # file and switches
        run "$bin/povgloss" passes $other "${options[@]}"
        expect_status 0 && rows err povray:direction || return 1
    done
}
check "passes__perspective_camera__no_directions" views
unasked() {
    run "$bin/glossfilter" passes.exr -o picture.png
    expect_status 0 && [ ! -s err ] || { show_run; return 1; }
}
check "render__quiet__the_table_alone" render_quiet
check "passes__with_the_check__its_row" passes
check "glossfilter__passes_file__its_steps" filter
check "probe__rays__their_row" probe
check "glossfilter__unasked__no_table" unasked
end_of_tests
