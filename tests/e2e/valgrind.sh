#!/usr/bin/env bash
# Whole runs of the filter under valgrind, which sees also what OpenEXR, libpng and zlib do: no wrong access, no value that
# was never written, nothing left allocated.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
case $bin in
    */sanitize-*) reason='a sanitized build' ;;
    *) command -v valgrind > tool || reason='valgrind is not installed' ;;
esac
if [ -n "${reason:-}" ]; then
    check "valgrind # SKIP $reason" true
    end_of_tests
    exit
fi

"$bin/povgloss" passes "$root/povscenes/two_exponents.pov" "+L$root/povscenes" +W48 +H36 --quiet -o passes.exr
# shellcheck disable=SC2015 # neither test has a side effect
clean() {
    run timeout 100 valgrind -q --error-exitcode=9 --leak-check=full "$bin/glossfilter" passes.exr "$@"
    expect_status 0 && [ ! -s err ] || { show_run; return 1; }
}
check "glossfilter__best_to_an_exr_with_layers__clean" clean --threads 2 --layers -o picture.exr
check "glossfilter__paper_to_a_png__clean" clean --mode paper --weights table -o picture.png
check "glossfilter__check__clean" clean --check
end_of_tests
