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
