#!/usr/bin/env bash
# Gloss_Map: the exponents are what POV-Ray itself draws of the map's pigment, wherever the map is written and whatever
# transforms it, and where the pigment has an edge they change as smoothly as an antialiased picture of it.
. tests/e2e/lib.sh

cd "$scratch" || exit 1
size=(+W96 +H72)
low=20 high=5000

cat > stage.inc << 'POV'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.4, 2, -4> right x*4/3 look_at <0, 0.5, 0> }
#declare Spots = pigment { bozo color_map { [0 rgb 0] [1 rgb <1, 0.8, 0.6>] } scale 0.4 }
#declare Squares = pigment { uv_mapping checker rgb 0.1 rgb 0.9 scale 0.1 }
#declare Red = pigment { rgb <0.5, 0, 0> }
#declare Clear = pigment { rgbt 1 }
POV

# numbers FILE CHANNEL: one line for each pixel, line by line of the picture.
numbers() {
    oiiotool "$1" --ch "$2" -o channel.exr && oiiotool --dumpdata channel.exr | awk '/Pixel/ { print $NF }'
}

# draws NAME SHOWN PAINTED: where stock POV-Ray draws the grey g of the glowing pigment of SHOWN, PAINTED has the exponent
# low^(1-g) high^g. g is 0 beside it, and the exponent, too.
draws() {
    local name=$1 channel
    printf '#include "stage.inc"\n#declare Glow = finish { emission 1 ambient 0 diffuse 0 }\n%s\n' "$2" > "$name-shown.pov"
    printf '#include "stage.inc"\n#include "povgloss.inc"\n#declare Low = %s; #declare High = %s;\n%s\n' $low $high "$3" > "$name.pov"
    povray "+I$name-shown.pov" "+O$name-shown.exr" +FE "${size[@]}" +A0.0 +AM1 +R3 -J Antialias_Gamma=1.0 -D > log 2>&1 ||
        { tail -5 log; return 1; }
    "$bin/povgloss" passes "$name.pov" "+L$root/povscenes" "${size[@]}" --quiet -o "$name.exr" || return
    for channel in R G B; do numbers "$name-shown.exr" $channel > $channel; done
    numbers "$name.exr" phong.V | paste R G B - > table
    # Silhouettes are mixed with the black beside them; the colours shown are half floats.
    awk -v low=$low -v high=$high '
        { grey[NR] = 0.297*$1 + 0.589*$2 + 0.114*$3; exponent[NR] = $4 }
        function inner(i) {
            return grey[i] > 0 && grey[i-1] > 0 && grey[i+1] > 0 && grey[i-96] > 0 && grey[i+96] > 0 &&
                exponent[i] > 0 && exponent[i-1] > 0 && exponent[i+1] > 0 && exponent[i-96] > 0 && exponent[i+96] > 0
        }
        END {
            for (i = 1; i <= NR; i++) {
                if (!inner(i)) continue
                error = log(exponent[i]/low)/log(high/low) - grey[i]
                count++; spread += (grey[i] - 0.5)^2
                if (error < 0) error = -error
                if (error > worst) worst = error
            }
            print count " pixels, worst error " worst
            exit !(count > 800 && spread > 10 && worst < 0.002)
        }' table
}

floor='plane { y, 0'
check 'map__finish_in_texture__drawn_as_the_pigment' draws simple \
    "$floor texture { pigment { Spots } finish { Glow } } }" \
    "$floor texture { pigment { Red } finish { reflection 0.3 Gloss_Map(Spots, Low, High) } } }"
check 'map__texture_transformed__transformed_with_it' draws transformed \
    "$floor texture { pigment { Spots } finish { Glow } scale 2 rotate 30*y } translate x }" \
    "$floor texture { finish { reflection 0.3 Gloss_Map(Spots, Low, High) } pigment { Red } scale 2 rotate 30*y } translate x }"
check 'map__declared_finish_and_texture__drawn_as_the_pigment' draws declared \
    "$floor texture { pigment { Spots } finish { Glow } scale 2 rotate 20*y } }" \
    "#declare F = finish { reflection 0.3 Gloss_Map(pigment { Spots }, Low, High) }
     #declare T = texture { pigment { Red } finish { F } scale 2 }
     $floor texture { T finish { phong 1 } rotate 20*y pigment { Red } } }"
check 'map__finish_of_an_object__drawn_as_the_pigment' draws object \
    "sphere { 0, 1.6 pigment { Spots } finish { Glow } rotate 40 }" \
    "sphere { 0, 1.6 finish { reflection 0.3 Gloss_Map(Spots, Low, High) } pigment { Red } rotate 40 }"
check 'map__under_a_transparent_layer__drawn_as_the_pigment' draws layered \
    "$floor texture { pigment { Spots } finish { Glow } scale 3 } }" \
    "$floor texture { pigment { Red } finish { reflection 0.3 Gloss_Map(Spots, Low, High) } scale 3 }
     texture { pigment { Clear } finish { phong 0.2 } } }"
check 'map__of_the_upper_layer__drawn_as_the_pigment' draws varnish \
    "$floor texture { pigment { Spots } finish { Glow } scale 3 } }" \
    "#declare F = finish { reflection 0.3 Gloss_Map(Spots, Low, High) }
     #declare T = texture { pigment { Red } } texture { pigment { Clear } finish { F } }
     $floor texture { T scale 3 } }"
check 'map__uv_mapped__drawn_as_the_pigment' draws uv \
    "sphere { 0, 1.6 texture { pigment { Squares } finish { Glow } } }" \
    "sphere { 0, 1.6 texture { pigment { Red } finish { reflection 0.3 Gloss_Map(Squares, Low, High) } } }"
check 'map__given_to_macros_and_made_by_one__drawn_as_the_pigment' draws macros \
    "$floor texture { pigment { Spots scale 2 } finish { Glow } } }" \
    "#macro Larger(P) pigment { P scale 2 } #end
     #macro Floor(P) plane { y, 0 texture { pigment { Red } finish { reflection 0.3 Gloss_Map(P, Low, High) } } } #end
     Floor(Larger(Spots))"
check 'maps__several__each_its_own' draws several \
    "#declare I = 0; #while (I < 6) box { <I - 3, 0, -2>, <I - 2, 1, 2> pigment { Spots translate 9*I*x scale 2 } finish { Glow } }
     #declare I = I + 1; #end" \
    "#declare I = 0; #while (I < 6) box { <I - 3, 0, -2>, <I - 2, 1, 2> pigment { Red }
       finish { reflection 0.3 Gloss_Map(pigment { Spots translate 9*I*x scale 2 }, Low, High) } }
     #declare I = I + 1; #end"

# A slanted edge: the sum over a line of pixels says where it is, to a fifth of a pixel.
smooth() {
    printf '%s\n' '#version 3.7; #include "povgloss.inc" global_settings { assumed_gamma 1 }' \
        'camera { orthographic location -9*z right x*64 up y*16 } light_source { -9*z rgb 1 }' \
        '#declare Wedge = pigment { gradient x color_map { [0.5 rgb 0] [0.5 rgb 1] } scale 1000 translate -500*x rotate -20*z };' \
        "plane { z, 0 inverse pigment { rgb 0.5 } finish { reflection 0.5 Gloss_Map(Wedge, $low, $high) } }" > edge.pov
    "$bin/povgloss" passes edge.pov "+L$root/povscenes" +W64 +H16 --quiet -o edge.exr || return
    numbers edge.exr phong.V | awk -v low=$low -v high=$high '
        { sum += log($1/low)/log(high/low) }
        NR % 64 == 0 {
            y = 8 - (NR/64 - 0.5); expected = 32 - y*sin(20*atan2(0, -1)/180)/cos(20*atan2(0, -1)/180)
            error = sum - expected; if (error < 0) error = -error
            if (error > worst) worst = error
            sum = 0
        }
        END { print "worst error in pixels: " worst; exit !(NR == 1024 && worst < 0.2) }'
}
check 'map__edge__antialiased' smooth

stock_povray_draws_it_as_without() {
    sed 's/Gloss_Map([^)]*)//; s/#include "povgloss.inc"//' simple.pov > without.pov
    for name in simple without; do
        povray "+I$name.pov" "+O$name.png" "+L$root/povscenes" "${size[@]}" -D > log 2>&1 || { tail -5 log; return 1; }
    done
    idiff -fail 0 simple.png without.png
}
check 'map__stock_povray__as_without' stock_povray_draws_it_as_without

lists() {
    run "$bin/povgloss" list object.pov "+L$root/povscenes"
    expect_status 0 && grep -q 'Low..High  *0.3$' out && return
    cat out
    return 1
}
check 'map__list__shows_both_ends' lists

# refused MESSAGE SCENE
refused() {
    printf '#include "stage.inc"\n#include "povgloss.inc"\n%s\n' "$2" > refused.pov
    run "$bin/povgloss" passes refused.pov "+L$root/povscenes" "${size[@]}" --quiet -o refused.exr
    expect_status 4 && expect_message "$1" && expect_no_file refused.exr
}
check 'map__exponent_of_0__refused' refused 'exponents here are above 0' \
    "$floor finish { reflection 0.3 Gloss_Map(Spots, 0, 100) } }"
check 'map__in_a_default__refused' refused "can't stand in a #default" \
    "#default { finish { reflection 0.3 Gloss_Map(Spots, 10, 100) } } $floor }"
end_of_tests
