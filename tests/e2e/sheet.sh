#!/usr/bin/env bash
# glossfilter --sheet: the pictures of several exponents side by side, each as it is by itself, under a label of its own.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
"$bin/povgloss" passes "$root/povscenes/interior.pov" "+L$root/povscenes" +W80 +H60 -A --quiet --no-check -o passes.exr ||
    exit 1

# Places of the pictures: three columns of 80 + 8 pixels, two lines of 60 + 15 + 8, the first one at 8, 8 + 15.
draws() {
    local index=0 exponent
    run "$bin/glossfilter" passes.exr --sheet 30,300,1e6,inf,0.5 -o "sheet.$1"
    expect_status 0 || return
    [ ! -s err ] || { show_run; return 1; }
    oiiotool --info "sheet.$1" | grep -q " 272 x  174," || { oiiotool --info "sheet.$1"; return 1; }
    for exponent in 30 300 1e6 inf 0.5; do
        "$bin/glossfilter" passes.exr --phong $exponent -o "one.$1" || return
        oiiotool "sheet.$1" --cut "80x60+$((8 + index % 3 * 88))+$((23 + index / 3 * 83))" -o "cut.$1"
        idiff -fail 0 -hardfail 0 "one.$1" "cut.$1" > log || { cat log; return 1; }
        oiiotool "sheet.$1" --cut "80x7+$((8 + index % 3 * 88))+$((8 + index / 3 * 83))" -o "label$index.$1"
        index=$((index + 1))
    done
}
check 'sheet__png__each_picture_as_by_itself' draws png
check 'sheet__exr__each_picture_as_by_itself' draws exr

# p = 300: the letters' columns of ink, six pixels each.
labelled() {
    oiiotool label1.exr --ch R --cut 6x7+24+0 -o letter.exr && oiiotool --dumpdata letter.exr |
        awk '/Pixel/ { printf "%s", ($NF > 0.5 ? "#" : "."); if (++n % 6 == 0) print "" }' > letter
    printf '%s\n' '#####.' '...#..' '..#...' '...#..' '....#.' '#...#.' '.###..' | diff - letter
}
check 'sheet__label__tells_the_exponent' labelled
different() {
    ! idiff -fail 0.1 label0.exr label1.exr > log && ! idiff -fail 0.1 label2.exr label3.exr > log
}
check 'sheet__labels__differ' different

refused() {
    local message=$1
    shift
    run "$bin/glossfilter" passes.exr "$@"
    expect_status 2 && expect_message "$message" && expect_one_line glossfilter && expect_no_file refused.png
}
for wrong in '' ',' '30,' ',30' '30,,40' x 30x '30, 40' -1 nan; do
    check "sheet__of_'$wrong'__refused" refused 'must be a number from 0 to inf' "--sheet=$wrong" -o refused.png
done
check 'sheet__of_101__refused' refused 'at most 100 exponents' --sheet "$(seq -s, 101)" -o refused.png
check 'sheet__with_phong__refused' refused 'leave out --phong' --sheet 30,40 --phong 3 -o refused.png
check 'sheet__with_layers__refused' refused 'leave out --layers' --sheet 30,40 --layers -o refused.exr
check 'sheet__without_output__refused' refused 'no output' --sheet 30,40
end_of_tests
