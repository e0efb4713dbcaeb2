#!/usr/bin/env bash
# --depfile: make, reading the rule, redraws a picture when any file that its scene read has changed, and only then.
# shellcheck disable=SC2016 # folders are called $
. tests/e2e/lib.sh

cd "$scratch" || exit 1
mkdir -p 'lib $1/parts' fake
# oiiotool takes # for a frame number.
png() { oiiotool --pattern checker:width=2:height=2 8x8 3 -d uint8 -o new.png && mv new.png "$1"; }
png 'lib $1/parts/height#2.png'
png 'a [b]*.png'
png unused.png
cp "$root/povscenes/povgloss.inc" 'lib $1/'
cp /usr/share/povray-3.7/include/cyrvetic.ttf 'my font.ttf'
# shellcheck disable=SC2028 # the backslash is one
echo '#include "deep: back\ slash.inc"' > first.inc
echo '#declare Deep = 1;' > 'deep: back\ slash.inc'
echo '#declare Deep = 2;' > skipped.inc
echo '1, 2, 3' > data.txt
echo '+W16 +H12' > size.ini
cat > 'my scene.pov' << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
#include "first.inc"
#if (Deep = 2) #include "skipped.inc" #end
#fopen Data "data.txt" read
#read (Data, A, B)
#fopen Own "own.txt" write
#write (Own, "1,")
#fclose Own
#fopen Own "own.txt" read
#read (Own, C)
camera { location <0, 2, -6> look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
height_field { png concat("parts/height#", str(B, 0, 0), ".png") }
text { ttf "my font.ttf" "x" 0.1, 0 }
plane { y, 0 pigment { image_map { png "a [b]*.png" } } finish { reflection 0.5 Gloss(50) } }
POV
cat >> 'my scene.pov' << POV
#fopen Log "$PWD/own-log.txt" append
#write (Log, "1,")
#fclose Log
#fopen Log "$PWD/own-log.txt" read
#read (Log, D)
POV
reads=('my scene.pov' first.inc 'deep: back\ slash.inc' 'lib $1/povgloss.inc' 'lib $1/parts/height#2.png' 'my font.ttf'
       'a [b]*.png' data.txt size.ini)
{
    echo 'all: my\ picture$$.png'
    echo 'my\ picture$$.png:; "$(POVGLOSS)" render "my scene.pov" "+Llib \$$1" size.ini -A --quiet' \
        '--depfile picture.d -o "my picture\$$.png"'
    echo '-include picture.d'
} > Makefile
make=(make --no-print-directory --no-builtin-rules "POVGLOSS=$bin/povgloss")

age() {
    touch -d 2001-01-01 -- *.* lib*/* lib*/parts/*
    touch -d 2002-02-02 'my picture$.png'
}
up_to_date() { "${make[@]}" -q || fail "make would redraw: $("${make[@]}" -n)"; }
redraws() {
    "${make[@]}" -q
    status=$?
    expect_status 1
}

draws() {
    "${make[@]}" || return 1
    if [ ! -s 'my picture$.png' ] || [ ! -s picture.d ]; then
        ls
        return 1
    fi
    expect_nothing_left && expect_no_file .povgloss-*
}
touched() {
    age
    touch "$1"
    redraws || { cat picture.d; return 1; }
}
nothing_touched() {
    age
    up_to_date
}
others_touched() {
    age
    touch unused.png skipped.inc
    up_to_date
}
removed() {
    age
    mv first.inc second.inc
    sed -i 's/first/second/' 'my scene.pov'
    redraws || return 1
    "${make[@]}" && touch -d 2001-01-01 second.inc && age && up_to_date && touch second.inc && redraws
}
check "the picture and the rule are made" draws
check "nothing touched: nothing is redrawn" nothing_touched
check "files that the scene didn't read touched: nothing is redrawn" others_touched
for file in "${reads[@]}"; do
    check "touched: $file" touched "$file"
done
no_other_names() {
    # Every name is the user's: relative, and in one of the places that were named.
    ! grep -nE '^ ?/|: /|/tmp|copies|lib0|own|/usr|/etc' picture.d
}
check "no name of the system, of the work folder or of what the scene wrote" no_other_names
check "an include that is gone doesn't stop make" removed

passes_too() {
    "$bin/povgloss" passes 'my scene.pov' '+Llib $1' size.ini -A --quiet --depfile passes.d -o passes.exr || return 1
    sed -e 's/^my.*png:/passes.exr:/' picture.d | cmp - passes.d
}
check "povgloss passes writes the same rule" passes_too
to_standard_output() {
    "$bin/povgloss" render 'my scene.pov' '+Llib $1' size.ini -A --quiet --depfile - -o 'my picture$.png' | cmp - picture.d
}
check "--depfile - is standard output" to_standard_output
absolute() {
    "$bin/povgloss" render "$PWD/my scene.pov" "+L$PWD/lib \$1" size.ini -A --quiet --depfile absolute.d -o "$PWD/x.png" ||
        return 1
    grep -qF "$PWD/x.png: $PWD/my\\ scene.pov" absolute.d && grep -qF "$PWD/lib\\ \$\$1/povgloss.inc:" absolute.d ||
        { cat absolute.d; return 1; }
}
check "absolute names stay absolute" absolute

# ---- .ini files and animations

ini_files() {
    printf 'Include_Ini=size.ini\n[Large]\n+W640\n' > all.ini
    "$bin/povgloss" render 'my scene.pov' '+Llib $1' 'all.ini' -A --quiet --depfile ini.d -o 'my picture$.png' || return 1
    grep -q '^ all.ini' ini.d && grep -q '^ size.ini' ini.d && grep -q '^all.ini:$' ini.d && grep -q '^size.ini:$' ini.d
}
check "an .ini file that reads another: both" ini_files

# Each frame reads files of its own, by names that only POV-Ray knows; what they hold isn't the same either.
cat > frames.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
camera { location <0, 2, -6> look_at 0 }
light_source { <-5, 8, -6> rgb 1 }
#fopen Data concat("frame", str(frame_number, 0, 0), ".txt") read
#read (Data, Height)
#include concat("frame", str(frame_number, 0, 0), ".inc")
#fopen Own "own.inc" write
#write (Own, "sphere { <1, ", frame_number/3, ", 0>, 0.5 pigment { rgb x } finish { reflection 0.2 Gloss(30) } }")
#fclose Own
#include "own.inc"
plane { y, 0 pigment { rgb 0.2 } finish { reflection 0.5 Gloss(50) } }
POV
for number in 1 2 3; do
    echo "$number," > "frame$number.txt"
    echo "sphere { <-1, Height/2, 0>, $number/5 pigment { rgb y } finish { reflection 0.3 Gloss(20) } }" > "frame$number.inc"
done
mkdir plain
cp 'lib $1/povgloss.inc' plain
frames=(+Lplain +W32 +H24 -A +KFF3)
frames_are_povrays() {
    local number
    povray +Iframes.pov "${frames[@]}" -D +FE +Otruth.exr > povray.log 2>&1 || { tail -5 povray.log; return 1; }
    "$bin/povgloss" passes frames.pov "${frames[@]}" --quiet --depfile frames.d -o 'frame$.exr' || return 1
    for number in 1 2 3; do
        "$bin/glossfilter" "frame\$$number.exr" --phong inf -o mirror.exr && same_picture "truth$number.exr" mirror.exr ||
            { echo "frame $number"; return 1; }
    done
    expect_nothing_left
}
check "includes that are other files in every frame: the frames are POV-Ray's own" frames_are_povrays
cat > Frames.mk << 'MK'
frame$$1.exr frame$$2.exr frame$$3.exr &:; exit 1
include frames.d
MK
frames_depend() {
    local number file
    for file in frame{1,2,3}.{txt,inc} frames.pov plain/povgloss.inc; do
        touch -d 2001-01-01 frame* plain/povgloss.inc
        touch -d 2002-02-02 'frame$'*.exr
        for number in 1 2 3; do
            make -q -f Frames.mk "frame\$$number.exr" || fail "make would redraw frame $number" || return 1
        done
        touch "$file"
        for number in 1 2 3; do
            ! make -q -f Frames.mk "frame\$$number.exr" || fail "$file isn't for frame $number" || return 1
        done
    done
}
check "an animation: every frame depends on every file" frames_depend
frame_fails() {
    echo old > old.d
    echo wrong > frame3.inc
    run "$bin/povgloss" passes frames.pov "${frames[@]}" --quiet --depfile old.d -o part.exr
    expect_status 4 && expect_message "frame 3: frames.pov" && [ -s part2.exr ] && expect_no_file part3.exr && [ "$(cat old.d)" = old ]
}
check "a frame that fails leaves the older rule" frame_fails

# ---- failures

refused() {
    local expected=$1 message=$2
    shift 2
    echo old > old.d
    run "$bin/povgloss" render 'my scene.pov' '+Llib $1' size.ini -A --quiet --depfile old.d "$@"
    expect_status "$expected" && expect_message "$message" && expect_nothing_left && [ "$(cat old.d)" = old ]
}
for name in 'a;b.png' 'a%b.png' 'a=b.png' 'a|b.png' '~a.png' $'a\tb.png' $'a\nb.png'; do
    check "an output that no rule can name: ${name//[$'\n\t']/?}" refused 3 "make can't take" -o "$name"
done
check "an output without a name" refused 2 "-o - has none" -o -
check "frames that are there already" refused 2 "--resume" --resume -o 'my picture$.png'
fails() {
    echo old > old.d
    { cat 'my scene.pov'; echo '#error "oops"'; } > wrong.pov
    run "$bin/povgloss" render wrong.pov '+Llib $1' --quiet --depfile old.d -o wrong.png
    expect_status 4 && expect_nothing_left && expect_no_file wrong.png && [ "$(cat old.d)" = old ]
}
check "a scene that fails leaves the older rule" fails
odd_dependency() {
    cp second.inc 'odd;name.inc'
    sed 's/second/odd;name/' 'my scene.pov' > odd.pov
    echo old > old.d
    run "$bin/povgloss" render odd.pov '+Llib $1' size.ini -A --quiet --depfile old.d -o odd.png
    expect_status 3 && expect_message "odd;name.inc: make can't take" && [ "$(cat old.d)" = old ]
}
check "a file that no rule can name" odd_dependency
no_folder() {
    run "$bin/povgloss" render 'my scene.pov' '+Llib $1' --quiet --depfile none/x.d --povray "$PWD/never" -o x.png
    expect_status 3 && expect_message "mkdir -p"
}
check "a depfile in a folder that is missing is told before the work" no_folder
not_preloaded() {
    printf '#!/bin/sh\nunset LD_PRELOAD\nexec %q "$@"\n' "$(command -v povray)" > fake/povray
    chmod +x fake/povray
    rm -f x.png
    run "$bin/povgloss" render 'my scene.pov' '+Llib $1' size.ini -A --quiet --depfile x.d --povray fake/povray -o x.png
    expect_status 3 && expect_message "LD_PRELOAD" && expect_no_file x.d x.png
}
check "a povray whose reading can't be noted" not_preloaded
own_preload() {
    printf '#!/bin/sh\necho "$LD_PRELOAD" > %q\nexec %q "$@"\n' "$PWD/seen" "$(command -v povray)" > fake/povray
    LD_PRELOAD=libm.so.6 "$bin/povgloss" render 'my scene.pov' '+Llib $1' size.ini -A --quiet --depfile own.d \
        --povray fake/povray -o 'my picture$.png' && cmp own.d picture.d && grep -q 'preload.so:libm.so.6' seen
}
# A sanitizer wants to be loaded first.
case $bin in
    */sanitize-*) ;;
    *) check "the user's own LD_PRELOAD stays" own_preload ;;
esac
end_of_tests
