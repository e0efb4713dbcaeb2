#!/usr/bin/env bash
# povgloss list: the finishes that reflect, where they stand, and the exponents that --gloss auto then gives them.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
mkdir parts
cp "$root/povscenes/povgloss.inc" .
cat > parts/library.inc << 'POV'
#declare R = 0.25;
#declare F_Base = finish { reflection R phong_size 40 }
#declare F_Used = finish { F_Base roughness 0.01 }
#declare F_Unused = finish { reflection 0.9 phong_size 7 }
#declare T_Unused = texture { finish { F_Unused } }
#declare T_Used = texture { pigment { rgb 1 } } texture { pigment { rgbt 1 } finish { F_Used } }
#macro Thing(P) sphere { 0, 1 finish { reflection 0.1 phong_size P + 1 } } #end
#macro Other(P) sphere { 0, 1 finish { reflection 0.11 phong_size P } } #end
POV
cat > scene.pov << 'POV'
#include "povgloss.inc"
#include "parts/library.inc"
// finish { reflection 0.8 }
#declare Mirror = finish { reflection { 0.1,   0.9
    fresnel /* yes */ } metallic }
#declare Shiny = finish { ambient 0 reflection 0.3 roughness 0.002 phong_size 60 }
#declare Later = finish { Shiny roughness 0.005 }
#declare Own = texture { pigment { rgb 1 } finish { reflection rgb <0.1, 0.2, 0.3> Gloss(300) phong_size 10 } }
#declare Matte = finish { reflection 0 phong_size 50 }
#declare Dull = finish { phong_size 50 }
sphere { 0, 1 finish { reflection 0.2*R Gloss_Roughness( 0.3 ) } }
sphere { 0, 1 finish { reflection 0.7 Gloss(P * 10) } }
object { Thing(4) texture { T_Used } }
sphere { 0, 1 finish { Own_Finish reflection 0.4 } }
sphere { 0, 1 texture { finish { Shiny } } }
POV
cat > expected << 'TXT'
NAME PLACE EXPONENT REFLECTION
Mirror scene.pov:4 - { 0.1, 0.9 fresnel }
Shiny scene.pov:6 60 0.3
Later scene.pov:7 50 0.3
Own scene.pov:8 300 rgb <0.1, 0.2, 0.3>
- scene.pov:11 61.2284 0.2*R
- scene.pov:12 P*10 0.7
- scene.pov:14 - 0.4
- scene.pov:15 60 0.3
F_Base parts/library.inc:2 40 R
F_Used parts/library.inc:3 25 R
T_Used parts/library.inc:6 25 R
- parts/library.inc:7 P+1 0.1
TXT

lists() {
    run "$bin/povgloss" list scene.pov +W640 +A0.3
    expect_status 0 || return 1
    [ ! -s err ] && tr -s ' ' < out > squeezed && diff expected squeezed
}
check "what reflects, and only what the scene uses of its includes" lists
aligned() {
    # Every column begins at one place: that of its heading, after two spaces.
    awk 'NR == 1 { place = index($0, "PLACE"); exponent = index($0, "EXPONENT"); reflection = index($0, "REFLECTION") }
         substr($0, place - 2, 2) != "  " || substr($0, exponent - 2, 2) != "  " || substr($0, reflection - 2, 2) != "  " ||
         index($0, $2) != place || substr($0, exponent, length($3)) != $3 || / $/ { print; bad = 1 }
         END { exit bad || NR < 2 }' out
}
check "the columns are aligned" aligned

# The exponents that POV-Ray finds for every pixel of a picture of five balls.
cat > balls.pov << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "povgloss.inc"
#declare A = finish { reflection 0.3 phong_size 60 }
#declare B = finish { A roughness 0.005 }
#declare C = finish { roughness 0.001 reflection 0.2 phong_size 30 }
#declare D = finish { A Gloss(77) }
#declare E = finish { C reflection 0.1 roughness 1/400 }
sphere { -2*x, 0.5 pigment { rgb 0.5 } finish { A } }
sphere { -x, 0.5 pigment { rgb 0.5 } finish { B } }
sphere { 0, 0.5 pigment { rgb 0.5 } finish { C } }
sphere { x, 0.5 pigment { rgb 0.5 } finish { D } }
sphere { 2*x, 0.5 pigment { rgb 0.5 } finish { E } }
camera { orthographic location -z*5 right x*6 up y*1.5 look_at 0 }
POV
agrees() {
    local name exponent column found
    "$bin/povgloss" list balls.pov > out || return 1
    "$bin/povgloss" passes balls.pov +W60 +H15 -A --gloss auto --quiet -o balls.exr || return 1
    column=10
    for name in A B C D E; do
        exponent=$(awk -v name=$name '$1 == name { gsub("/", " "); print $3 == "1" ? 100 : $3 }' out)
        found=$(oiiotool balls.exr --ch phong.V --cut "1x1+$column+7" --printstats | awk '/Stats Max/ { print $3 }')
        awk "BEGIN { exit !(\"$exponent\" != \"\" && ($found - $exponent)^2 < 1e-6*$exponent^2) }" ||
            fail "$name: listed $exponent, rendered $found" || { cat out; return 1; }
        column=$((column + 10))
    done
}
check "the exponents are those that --gloss auto renders with" agrees

nothing() {
    echo 'sphere { 0, 1 finish { reflection 0 phong_size 5 } }' > plain.pov
    run "$bin/povgloss" list plain.pov
    expect_status 0 && expect_message "plain.pov: no finish reflects" && expect_one_line povgloss
}
check "nothing that reflects: one line, status 0" nothing
warns() {
    { cat balls.pov; echo '#include concat("a", "b")'; } > computed.pov
    run "$bin/povgloss" list computed.pov
    expect_status 0 && grep -q 'warning: computed.pov: files that are included' err && grep -q '^A ' out
}
check "an include by a computed name is warned of" warns
by_library() {
    mkdir -p elsewhere
    mv parts/library.inc elsewhere/used.inc
    sed 's,parts/library,used,' scene.pov > other.pov
    run "$bin/povgloss" list +Ielse.pov
    expect_status 3 || return 1
    run "$bin/povgloss" list other.pov +Lelsewhere
    expect_status 0 && grep -q '^F_Used  *elsewhere/used.inc:3 ' out
}
check "includes are found by +L" by_library
by_ini() {
    printf 'Input_File_Name=other.pov\nLibrary_Path=elsewhere\n+W640\n' > list.ini
    "$bin/povgloss" list other.pov +Lelsewhere > expected || return 1
    run "$bin/povgloss" list list.ini
    expect_status 0 && [ ! -s err ] && cmp expected out
}
check "scene and includes are found by an .ini file" by_ini
by_comment() {
    { echo '// +W640 +H480 +Lelsewhere'; cat other.pov; } > comment.pov
    run "$bin/povgloss" list comment.pov --from-scene
    expect_status 0 && grep -q '^F_Used  *elsewhere/used.inc:3 ' out
}
check "switches from the scene's comment" by_comment
deprecated() {
    printf '#declare deprecated once "old" Old = finish { reflection 0.3 }\nsphere { 0, 1 finish { Old } }\n' > old.pov
    run "$bin/povgloss" list old.pov
    expect_status 0 && grep -q '^Old  *old.pov:1 ' out
}
check "a deprecated name" deprecated
refused() {
    local expected=$1 message=$2
    shift 2
    run "$bin/povgloss" list "$@"
    expect_status "$expected" && expect_message "$message" && expect_one_line povgloss
}
check "a missing scene" refused 3 "none.pov: cannot be opened" none.pov
check "an output" refused 2 "standard output" balls.pov -o x.txt
check "a depfile" refused 2 "standard output" balls.pov --depfile x.d
check "an option of the filter" refused 2 "standard output" balls.pov --phong 3
check "no scene" refused 2 "no scene"
full_disk() {
    "$bin/povgloss" list balls.pov > /dev/full 2> err
    status=$?
    expect_status 3 && grep -q 'standard output: cannot be written' err
}
check "a full disk" full_disk
end_of_tests
