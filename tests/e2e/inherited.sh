#!/usr/bin/env bash
# Finishes that begin with something declared elsewhere are glossy and transparent as that is.
. tests/e2e/lib_scenes.sh

# ---- elements of arrays

scene "elements by random numbers" << 'POV'
#declare R = seed(3);
#declare T = array[4]
#declare T[int(rand(R))] = texture { pigment { rgb x } finish { reflection 0.3 Gloss(100) } }
#declare T[1] = texture { pigment { rgb y } finish { reflection 0.1 } }
#declare T[2] = texture { pigment { rgb z } finish { diffuse 0.7 } }
#declare T[3] = texture { pigment { rgb 1 } finish { reflection 0.5 Gloss(100) } }
#for (J, 0, 19)
  sphere { <mod(J, 5) - 2, div(J, 5)*0.6, J/8>, 0.4 texture { T[int(rand(R)*4)] finish { diffuse 0.4 } } }
#end
object { Floor pigment { rgb 0.6 } }
POV

# ---- finishes of objects on their textures

gloss=(--gloss auto)
scene "finish of an object after its transparent texture" << 'POV'
#declare F = finish { reflection 0.3 phong 0.5 phong_size 100 }
#declare T = texture { pigment { rgbt <0.7, 0.8, 0.9, 0.6> } }
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 phong_size 50 } }
object { Ball translate x texture { pigment { rgbf <0.9, 0.8, 0.9, 0.9> } } finish { F } interior { ior 1.3 } }
object { Ball translate -x texture { T } finish { F diffuse 0.2 } }
POV

# ---- finishes that begin with the default

default_scene() {
    cat << 'POV'
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 phong_size 50 Gloss(50) } }
POV
    printf '%s\n' "$1"
    cat << 'POV'
#declare Named = sphere { 0, 0.5 }
#declare Clear = texture { pigment { rgbt <0.7, 0.8, 0.9, 0.6> } }
#declare F = finish { phong 1 }
object { Named translate <-2, 0.5, -1> pigment { rgb <0.3, 0.1, 0> } }
object { Named translate <-1, 0.5, -1> pigment { rgbt <0.8, 0.9, 0.7, 0.7> } interior { ior 1.2 } }
object { Named translate <0, 0.5, -1> texture { Clear } }
object { Named translate <1, 0.5, -1> texture { Clear finish { F } } }
object { Named translate <2, 0.5, -1> texture { pigment { rgbf <1, 0.9, 0.8, 0.8> }
  finish { diffuse 0.2 } } interior { ior 1.3 } }
object { Named translate <-2, 1.5, 0> texture { pigment { rgb <0, 0.1, 0.3> } finish { F diffuse 0.2 } } }
object { Named translate <-1, 1.5, 0> texture { pigment { rgb <0, 0.1, 0.3> } finish { F reflection 0 } } }
object { Named translate <0, 1.5, 0> pigment { rgb <0, 0.3, 0.3> } finish { diffuse 0.2 } }
object { Named translate <1, 1.5, 0> texture { gradient y scale 0.2
  texture_map { [0.5 pigment { rgb <0.3, 0.1, 0> }] [0.5 pigment { rgb 0.2 } finish { reflection 0.1 }] } } }
object { Named translate <2, 1.5, 0> finish { diffuse 0.2 } }
object { Named translate <-0.5, 2.2, 0> }
POV
}
scene "default finish" < <(default_scene '#default { finish { reflection 0.3 phong 0.5 phong_size 60 } }')
scene "default texture" < <(default_scene '#default {
  texture { pigment { rgb 0.4 } finish { ambient 0 reflection { 0.4 } specular 0.5 roughness 0.003 } } }')
scene "default finish, twice" < <(default_scene '#default { finish { reflection 0.3 phong 0.5 phong_size 60 } }
#default { finish { diffuse 0.4 } }')

# With Gloss() in a default the passes are those of the same scene with that finish written everywhere.
passes_of() {
    "$bin/povgloss" passes "$folder/$1.pov" "+L$folder" +Lpovscenes "${size[@]}" "${@:2}" --quiet -o "$folder/$1.exr"
}
default_is_as_written() {
    local beginning='#version 3.7; global_settings { assumed_gamma 1 }
#include "stage.inc"
#declare D = finish { reflection 0.3 phong 0.5 Gloss(60) }
#declare Named = sphere { 0, 0.5 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(60) } }'
    printf '%s\n' "$beginning" '#default { finish { reflection 0.3 phong 0.5 Gloss(60) } }
object { Named translate <-2, 0.5, -1> pigment { rgb <0.3, 0.1, 0> } }
object { Named translate <-1, 0.5, -1> pigment { rgbt <0.8, 0.9, 0.7, 0.7> } interior { ior 1.2 } }
object { Named translate <0, 0.5, -1> texture { pigment { rgbt <0.7, 0.8, 0.9, 0.6> } } }
object { Named translate <1, 0.5, -1> texture { pigment { rgbf <1, 0.9, 0.8, 0.8> } finish { diffuse 0.2 } } }
union { object { Named } object { Named translate <-0.2, 0, -1> pigment { rgbt 0.9 } } translate <0.5, 1.6, 0> }
object { Named translate <-1, 1.5, 0> finish { diffuse 0.2 } }' > "$folder/default.pov"
    printf '%s\n' "$beginning" '
object { Named translate <-2, 0.5, -1> pigment { rgb <0.3, 0.1, 0> } finish { D } }
object { Named translate <-1, 0.5, -1> pigment { rgbt <0.8, 0.9, 0.7, 0.7> } finish { D } interior { ior 1.2 } }
object { Named translate <0, 0.5, -1> texture { pigment { rgbt <0.7, 0.8, 0.9, 0.6> } finish { D } } }
object { Named translate <1, 0.5, -1> texture { pigment { rgbf <1, 0.9, 0.8, 0.8> } finish { D diffuse 0.2 } } }
union { object { Named pigment { rgb 0 } finish { D } }
  object { Named translate <-0.2, 0, -1> pigment { rgbt 0.9 } finish { D } } translate <0.5, 1.6, 0> }
object { Named translate <-1, 1.5, 0> finish { D diffuse 0.2 } }' > "$folder/written.pov"
    passes_of default && passes_of written &&
        idiff -a -fail 1e-4 -hardfail 1e-4 "$folder/default.exr" "$folder/written.exr"
}
check "a default with Gloss() is as if it were written in each finish" default_is_as_written
# ---- finishes and textures through macros

scene "textures made by macros" << 'POV'
#macro Made(C)
  texture { // a value, or the texture of an object
    pigment { rgbt C } finish { reflection 0.3 phong_size 60 }
  }
#end
#macro Items(C) pigment { rgbt C } finish { reflection 0.3 phong_size 60 } #end
#declare T = Made(<0.2,0.2,0.2,0.5>)
#declare U = Made(<0.3, 0, 0>)
object { Floor texture { T finish { diffuse 0.2 } } }
object { Ball translate x texture { U finish { diffuse 0.2 } } }
object { Ball translate -x texture { Items(0.1) finish { diffuse 0.1 } } }
object { Ball scale 0.3 translate <0, 0, -2> Made(<0.1, 0.3, 0.1, 0>) }
object { Ball scale 0.3 translate <0.7, 0, -2> Made(<0.1, 0.3, 0.1, 0.5>) }
POV
scene "macro with a finish called from a file that is written anew" << 'POV'
#include "strings.inc"
#declare F = finish { reflection 0.3 phong_size 60 }
#macro Thing(P, I) object { Ball scale 0.5 translate <I, 0, 0> pigment { rgb 0.2 } finish { P } } #end
object { Floor pigment { rgb 0.2 } finish { F } }
Thing(F, 1)
Parse_String("Thing(F, 0)")
Parse_String("Thing(F, -1)")
POV
parameters_are_as_written() {
    printf '#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#include "stage.inc"\n' | tee "$folder/own.pov" \
        > "$folder/given.pov"
    cat >> "$folder/given.pov" << 'POV'
#declare F = finish { reflection 0.3 phong_size 60 }
#declare T = texture { pigment { rgb <0.2, 0, 0.2> } finish { reflection 0.4 Gloss(50) } }
#declare G = texture { pigment { rgb 0.1 } finish { reflection 0.2 } }
#declare A = array[2] { T, G }
#declare E = array[2]
#declare E[0] = finish { reflection 0.5 phong_size 40 }
#declare E[1] = finish { reflection 0 }
#macro Plain(P, I) object { Ball scale 0.5 translate I*x - 2*x pigment { rgb 0.2 } finish { P } } #end
#macro More(I, P) object { Ball scale 0.5 translate I*x - 2*x texture { P finish { diffuse 0.4 } } } #end
#macro Through(P, I) More(I, P) #end
#macro Of(Array, K, I)
  object { Ball scale 0.5 translate I*x - 2*x pigment { rgb 0.2 } finish { Array[K] diffuse 0.3 } }
#end
object { Floor pigment { rgb 0.2 } finish { F } }
Plain(F, 0)
More(1, T)
Through(G, 2)
More(3, A[0])
object { Plain(finish { F diffuse 0.3 }, 4) }
object { Of(E, 0, 0) translate 1.2*y }
object { Of(E, 1, 1) translate 1.2*y }
object { Plain(E[0], 2) translate 1.2*y }
#declare X = Plain(F, 3)
object { X translate 1.2*y }
POV
    cat >> "$folder/own.pov" << 'POV'
#macro Place(I) scale 0.5 translate <mod(I, 5) - 2, div(I, 5)*1.2, 0> #end
object { Floor pigment { rgb 0.2 } finish { reflection 0.3 Gloss(60) } }
object { Ball Place(0) pigment { rgb 0.2 } finish { reflection 0.3 Gloss(60) } }
object { Ball Place(1) pigment { rgb <0.2, 0, 0.2> } finish { reflection 0.4 Gloss(50) diffuse 0.4 } }
object { Ball Place(2) pigment { rgb 0.1 } finish { reflection 0.2 diffuse 0.4 } }
object { Ball Place(3) pigment { rgb <0.2, 0, 0.2> } finish { reflection 0.4 Gloss(50) diffuse 0.4 } }
object { Ball Place(4) pigment { rgb 0.2 } finish { reflection 0.3 Gloss(60) diffuse 0.3 } }
object { Ball Place(5) pigment { rgb 0.2 } finish { reflection 0.5 Gloss(40) diffuse 0.3 } }
object { Ball Place(6) pigment { rgb 0.2 } finish { diffuse 0.3 } }
object { Ball Place(7) pigment { rgb 0.2 } finish { reflection 0.5 Gloss(40) } }
object { Ball Place(8) pigment { rgb 0.2 } finish { reflection 0.3 Gloss(60) } }
POV
    passes_of given --gloss auto && passes_of own &&
        idiff -a -fail 1e-4 -hardfail 1e-4 "$folder/given.exr" "$folder/own.exr"
}
check "parameters of macros carry their gloss" parameters_are_as_written
end_of_scenes
