#!/usr/bin/env bash
# scripts/mitsuba_passes.py with a Mitsuba 3 that is installed: its passes, and the filtered picture against Mitsuba's
# own rough reflection. `make mitsuba` installs one; PYTHON names another.
. tests/e2e/lib.sh

python=${PYTHON:-build/mitsuba/bin/python}
if ! "$python" -c 'import mitsuba; mitsuba.set_variant("scalar_rgb")' 2> "$scratch/err"; then
    echo "ok 1 - mitsuba # SKIP $python has no Mitsuba 3 (make mitsuba)"
    echo 1..1
    exit
fi
python=$(realpath -s "$(command -v "$python")")
scene=$root/tests/scenes/mitsuba.xml
cd "$scratch" || exit 1

passes() {
    run "$python" "$root/scripts/mitsuba_passes.py" "$scene" passes.exr 8
    expect_status 0 || return 1
    run "$bin/glossfilter" --check passes.exr
    expect_status 0 && ! grep -E '^(wrong|note)|MISSING' "$scratch/out" &&
        grep -q 'eye at 0, 4, 6, view angle known' "$scratch/out"
}
check "mitsuba_passes__test_scene__nothing_wrong" passes

# matches ALPHA LIMIT: RMSE of the filtered floor in linear light; docs/passes.md has what was measured.
matches() {
    "$python" "$root/tests/tools/compare_mitsuba.py" "$scene" passes.exr "$bin/glossfilter" "$1" 32 > compared ||
        return 1
    cat compared
    awk -v limit="$2" '{ exit !($4 < 0.01 && $6 < 0.06 && $10 < limit) }' compared
}
check "glossfilter__mitsuba_alpha_0.05__its_own_within_the_limit" matches 0.05 0.06
check "glossfilter__mitsuba_alpha_0.1__its_own_within_the_limit" matches 0.1 0.1
end_of_tests
