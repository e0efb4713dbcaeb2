#!/usr/bin/env bash
# Probes by the real POV-Ray: under skies of closed form, against L0 on surfaces of all kinds, and a filtered image against
# them.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
size=(+W80 +H60 -A)
library=+L$root/povscenes

# probe NAME ARGUMENT...: measures NAME.pov into NAME.csv.
probe() {
    local name=$1
    shift
    "$bin/povgloss" probe "$name.pov" "$library" "${size[@]}" --quiet -o "$name.csv" "$@"
}

# over CSV PROGRAM: an awk program over the probes, which fails by `bad = 1`; the columns have their names' numbers.
over() {
    awk -F, -v x=1 -v y=2 -v p=3 -v R=4 -v G=5 -v B=6 -v error=7 -v samples=8 -v above=9 -v L0R=10 -v L0G=11 -v L0B=12 \
        "function abs(v) { return v < 0 ? -v : v }
         NR > 1 { $2; n++ } bad { print; exit } END { if (!n) print \"no probes\"; exit bad || !n }" "$1"
}

# ---- skies over a glossy floor, seen from above: the mirror direction of the pixel (x, y) is (u, 1, v)/length

cat > floor.inc << 'POV'
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }
camera { location <0, 10, 0> right x*4/3 up y direction z*1.5 look_at 0 }
box { <-20, -1, -20>, <20, 0, 20> pigment { rgb 0 } finish { reflection 0.5 Gloss(30) } }
POV
cat > uniform.pov << 'POV'
#include "floor.inc"
sky_sphere { pigment { rgb <0.25, 0.5, 3> } }
POV
cat > half.pov << 'POV'
#include "floor.inc"
sky_sphere { pigment { function { x > 0 } color_map { [0.5 rgb 0] [0.5 rgb 1] } } }
POV
cat > gradient.pov << 'POV'
#include "floor.inc"
sky_sphere { pigment { function { 0.5 + 0.499*x } color_map { [0 rgb 0] [1 rgb 1] } } }
POV

uniform_sky() {
    probe uniform --phong 0 --phong 3 --phong 1e6 --phong inf --grid 8 || return 1
    [ "$(wc -l < uniform.csv)" -eq $((1 + 4 * 8 * 6)) ] || fail "not every pixel has every exponent" || return 1
    over uniform.csv "bad = abs(\$R - 0.25) > 1e-6 || abs(\$G - 0.5) > 1e-6 || abs(\$B - 3) > 1e-6 || \$error > 1e-6"
}

# Of the lobe about m lies on the white side what lies above the angle -asin(m.x) about z: the integral of cos^p over it.
half_sky() {
    probe half --phong 30 --grid 16 --error 0.003 || return 1
    # shellcheck disable=SC2016
    over half.csv '
        u = (($x + 0.5) / 80 - 0.5) * 4 / 3 / 1.5; v = (0.5 - ($y + 0.5) / 60) / 1.5
        s = u / sqrt(1 + u * u + v * v); a = atan2(s, sqrt(1 - s * s)); sum = all = 0
        for (t = -1.570; t < 1.571; t += 0.001) { w = cos(t)^30; all += w; if (t > -a) sum += w }
        bad = abs($R - sum / all) > 2 * $error + 1e-3'
}

# The mean of a.d over the lobe is a.m (p + 1)/(p + 2).
gradient_sky() {
    probe gradient --phong 30 --phong 300 --grid 16 --error 0.001 || return 1
    # shellcheck disable=SC2016
    over gradient.csv '
        u = (($x + 0.5) / 80 - 0.5) * 4 / 3 / 1.5; v = (0.5 - ($y + 0.5) / 60) / 1.5
        s = u / sqrt(1 + u * u + v * v)
        bad = abs($R - (0.5 + 0.499 * s * ($p + 1) / ($p + 2))) > 2 * $error + 5e-4'
}

check 'probe__uniform_sky__its_radiance' uniform_sky
check 'probe__half_sky__share_of_the_lobe' half_sky
check 'probe__gradient_sky__shrinks_with_the_lobe' gradient_sky

# ---- in place: what the camera of a probe sees along the mirror direction is L0

cat > stage.inc << 'POV'
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }
light_source { <-6, 9, -7> rgb 0.9 }
#ifndef (Wall) #declare Wall = 4; #end
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [0.4 rgb <0.2, 0.35, 0.8>] } } }
plane { z, 3 inverse pigment { gradient x color_map { [0 rgb 0.1] [1 rgb <0.9, 0.5, 0.3>] } scale Wall } finish { ambient 0.3 } }
sphere { <1.9, 0.5, 1.5>, 0.5 pigment { rgb <0.1, 0.2, 0.9> } no_image }
sphere { <-1.9, 0.5, 1.5>, 0.5 pigment { rgb <0.9, 0.2, 0.1> } no_reflection }
#declare Shiny = texture { pigment { rgb 0.1 } finish { diffuse 0.3 reflection 0.5 Gloss(200) } }
#declare Floor = box { <-4, -0.1, -3>, <4, 0, 3> }
#macro From(K) camera { location K*<0.3, 2.2, -6> right x*4/3 angle 48 look_at K*<0, 0.8, 0> } #end
POV

# is_l0 NAME SWITCH...: the scene's statements are on standard input. Of the probes 1 % may lie on an edge.
is_l0() {
    local name=$1
    { echo '#include "stage.inc"'; cat; } > "$name.pov"
    probe "$@" --phong inf --grid 40 || return 1
    # shellcheck disable=SC2016
    over "$name.csv" 'off += abs($R - $L0R) > 0.004 || abs($G - $L0G) > 0.004 || abs($B - $L0B) > 0.004
                   if (off > 5) bad = 1'
}

check 'probe__flat_and_convex__l0' is_l0 convex << 'POV'
From(1)
object { Floor texture { Shiny } }
torus { 1, 0.4 rotate 60*x translate y texture { Shiny } }
POV
check 'probe__concave__l0' is_l0 concave << 'POV'
From(1)
difference { sphere { <0, 2, 0>, 2.5 } sphere { <0, 2, -1>, 2.6 } texture { Shiny } }
POV
check 'probe__bumps__l0' is_l0 bumps << 'POV'
From(1)
object { Floor texture { Shiny normal { bumps 0.4 scale 0.5 } } }
POV
check 'probe__isosurface__l0' is_l0 isosurface << 'POV'
From(1)
isosurface {
  function { y - 0.1*sin(x*3)*cos(z*3) } contained_by { box { <-4, -0.3, -3>, <4, 0.3, 3> } } max_gradient 2
  texture { Shiny }
}
POV
check 'probe__orthographic_camera__l0' is_l0 orthographic << 'POV'
camera { orthographic location <0.3, 2.2, -6> right x*8 up y*6 look_at <0, 0.8, 0> }
object { Floor texture { Shiny } }
POV
check 'probe__glass_bends_what_is_mirrored__l0' is_l0 glass << 'POV'
From(1)
object { Floor texture { Shiny } }
sphere { <0, 0.9, -0.2>, 0.9 pigment { rgbt 1 } finish { reflection 0.1 } interior { ior 1.5 } }
POV
check 'probe__defaults_that_reflect_and_bump__l0' is_l0 defaults << 'POV'
From(1)
#default { finish { ambient 0.2 reflection 0.2 phong 1 } normal { bumps 0.5 } }
box { <-4, -0.1, -3>, <4, 0, 3> pigment { rgb 0.1 } finish { reflection 0.5 Gloss(200) } }
POV
check 'probe__small_scene__l0' is_l0 small << 'POV'
From(0.01)
union { object { Floor } sphere { <0, 0.9, -0.2>, 0.9 } texture { Shiny } scale 0.01 }
POV
check 'probe__far_from_the_origin__l0' is_l0 far Declare=Wall=40000 << 'POV'
camera { location 1000*<0.3, 2.2, -6> right x*4/3 angle 48 look_at 1000*<0, 0.8, 0> translate <5e4, 0, 3e4> }
union { object { Floor } sphere { <0, 0.9, -0.2>, 0.9 } scale 1000 texture { Shiny } translate <5e4, 0, 3e4> }
POV

# A closed cavity that shines evenly is as bright in every direction, its own surface included.
cavity() {
    cat > cavity.pov << 'POV'
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 max_trace_level 3 }
camera { location <0, 0, -1> look_at z angle 70 }
sphere { 0, 3 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 0.3 reflection 0.5 Gloss(50) } }
POV
    probe cavity --phong 0 --phong 50 --grid 8 || return 1
    # shellcheck disable=SC2016
    over cavity.csv 'bad = abs($R - 0.45) > 1e-3'
}
check 'probe__cavity__sees_itself' cavity

frame() {
    cat > turning.pov << 'POV'
#include "floor.inc"
sky_sphere { pigment { rgb clock } }
POV
    probe turning +KFF3 +SF2 +EF2 --grid 4 || return 1
    # shellcheck disable=SC2016
    over turning.csv 'bad = abs($R - 0.5) > 1e-6'
}
check 'probe__frame_of_an_animation__measured' frame

# ---- the table and what is compared with it

against_itself() {
    "$bin/povgloss" passes convex.pov "$library" "${size[@]}" --quiet -o convex.exr || return 1
    "$bin/glossfilter" convex.exr --phong inf --layers --quiet -o mirror.exr || return 1
    "$bin/glossfilter" convex.exr --layers --quiet -o glossy.exr || return 1
    "$bin/povgloss" compare convex.csv mirror.exr > mirror.txt || return 1
    probe convex --phong inf --phong 200 --grid 12 || return 1
    "$bin/povgloss" compare convex.csv glossy.exr --phong 200 > glossy.txt || return 1
    "$bin/povgloss" compare convex.csv mirror.exr --phong 200 > wrong.txt || return 1
    cat mirror.txt glossy.txt wrong.txt
    awk '/^rmse/ { rmse[FILENAME] = $2 } /^noise/ { noise[FILENAME] = $2 }
         END { exit !(rmse["mirror.txt"] < 0.002 && rmse["glossy.txt"] < 0.1 && rmse["glossy.txt"] < rmse["wrong.txt"] &&
                      noise["glossy.txt"] > 0 && noise["glossy.txt"] < 0.002) }' mirror.txt glossy.txt wrong.txt
}
check 'compare__images__as_far_off_as_they_are' against_itself

# ---- every pixel by the same rays

# With mirrors in place of the lobes the picture is POV-Ray's own; with lobes it nears the probes as the rays grow in number.
brute_mirror() {
    povray +Iconvex.pov "$library" "${size[@]}" -D +FE +Otruth.exr > log 2>&1 || { tail -5 log; return 1; }
    "$bin/povgloss" brute convex.pov "$library" "${size[@]}" --quiet --phong inf --samples 1 -o brute.exr || return 1
    same_picture truth.exr brute.exr
}

brute_nears() {
    local count
    cp convex.pov near.pov
    probe near --grid 20 || return 1
    for count in 4 64; do
        "$bin/povgloss" brute near.pov "$library" "${size[@]}" --quiet --samples "$count" --layers -o "brute$count.exr" &&
            "$bin/povgloss" compare near.csv "brute$count.exr" > "brute$count.txt" || return 1
    done
    cat brute4.txt brute64.txt
    awk '/^rmse/ { rmse[FILENAME] = $2 } /^bias/ { bias[FILENAME] = $2 }
         END { exit !(rmse["brute64.txt"] < 0.35 * rmse["brute4.txt"] && bias["brute64.txt"]^2 < rmse["brute64.txt"]^2 / 4) }' \
        brute4.txt brute64.txt
}
check 'brute__mirror__povrays_own_picture' brute_mirror
check 'brute__more_rays__nearer_to_the_probes' brute_nears

# refuses STATUS MESSAGE COMMAND...
refuses() {
    local expected=$1 message=$2
    shift 2
    run "$@"
    expect_status "$expected" && expect_message "$message" && expect_one_line povgloss && expect_nothing_left
}
"$bin/glossfilter" convex.exr --quiet -o plain.exr
printf 'x,y\n1,2\n' > other.csv
{ cat convex.csv; echo '1,2,3'; } > broken.csv
{ head -1 convex.csv; echo '500,2,200,1,1,1,0,1,1,1,1,1'; } > outside.csv
check 'compare__several_exponents__refused' refuses 3 'choose the image'"'"'s with --phong' "$bin/povgloss" compare convex.csv glossy.exr
check 'compare__no_such_exponent__refused' refuses 3 'no probes of exponent 7' "$bin/povgloss" compare convex.csv glossy.exr --phong 7
check 'compare__no_layers__refused' refuses 3 'write it with --layers' "$bin/povgloss" compare convex.csv plain.exr --phong 200
check 'compare__another_table__refused' refuses 3 'no table of povgloss probe' "$bin/povgloss" compare other.csv glossy.exr
check 'compare__broken_line__refused' refuses 3 'broken.csv: line ' "$bin/povgloss" compare broken.csv glossy.exr
check 'compare__smaller_image__refused' refuses 3 'has a probe at 500, 2' "$bin/povgloss" compare outside.csv glossy.exr
check 'probe__nothing_glossy_on_the_grid__refused' refuses 3 'no pixel of the grid is glossy' \
    "$bin/povgloss" probe convex.pov "$library" "${size[@]}" --quiet --grid 1 --gloss Shiny=inf -o none.csv +SR1 +ER2
echo 'sphere { 0, 1 }' > dull.pov
check 'probe__nothing_glossy_in_the_scene__refused' refuses 3 'nothing in this scene is glossy' \
    "$bin/povgloss" probe dull.pov "$library" "${size[@]}" --quiet -o none.csv
check 'probe__output_that_cannot_be__refused' refuses 3 'none/none.csv' \
    "$bin/povgloss" probe convex.pov "$library" "${size[@]}" --quiet -o none/none.csv
end_of_tests
