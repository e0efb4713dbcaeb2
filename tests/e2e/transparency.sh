#!/usr/bin/env bash
# What is transparent, before, around and over glossy surfaces: see lib_scenes.sh.
. tests/e2e/lib_scenes.sh

scene "clear container, panes, glass and a ball with clear squares" << 'POV'
#include "colors.inc"
#include "glass.inc"
object { Floor pigment { checker rgb 0.2 rgb 0.8 translate y*0.1 } finish { reflection 0.3 Gloss(300) } }
box { <-3, -0.5, -2>, <3, 3, 2> pigment { rgbt 1 } hollow }
box { <-2, 0.2, -1.5>, <-1, 1.5, -1.4> pigment { rgbt <0.8, 1, 0.8, 0.7> } }
box { <-0.5, 0.2, -1.5>, <0.5, 1.5, -1.4> texture { T_Glass1 } interior { ior 1.5 } }
sphere {
  <1.4, 0.8, -1>, 0.6
  material {
    texture { pigment { rgbf <0.9, 0.95, 1, 0.9> } finish { specular 0.5 roughness 0.001 reflection 0.1 } }
    interior { ior 1.3 fade_distance 1 fade_power 2 }
  }
}
sphere { <0, 1, 1>, 0.8 pigment { checker Clear Red scale 0.3 } finish { phong 0.5 } }
POV
scene "woods, a stone, metals, a varnished ball and a ball of named glass" << 'POV'
#include "colors.inc"
#include "woods.inc"
#include "stones.inc"
#include "metals.inc"
#include "glass.inc"
#declare Varnish = texture { pigment { rgbt 1 } finish { reflection 0.3 phong 0.5 phong_size 80 } }
#declare Squares =
  texture {
    pigment { rgb 0.3 } // the lower layer
    finish { reflection 0.5 Gloss(100) }
  }
  texture { pigment { checker rgbt <1, 0.2, 0.1, 0.5> rgbt 1 scale 0.7 translate y*0.1 } finish { diffuse 0.8 } };
#declare Varnished = texture { T_Wood3 } texture { Varnish };
#declare Glass = material { texture { T_Glass3 } interior { I_Glass1 } };
object { Floor texture { Squares } }
sphere { <1, 1, 1>, 0.9 texture { T_Wood7 finish { reflection 0.2 Gloss(30) } } }
sphere { <-1.3, 0.6, -0.5>, 0.6 texture { Varnished } }
sphere { <0, 0.5, -1.5>, 0.5 material { Glass } }
cylinder { <-2, 0.2, -1>, <-2, 0.9, -1>, 0.3 texture { T_Stone10 } }
cylinder { <2, 0.2, -1>, <2, 0.9, -1>, 0.3 texture { T_Copper_3C } }
POV
scene "glass from an array and a macro" << 'POV'
#declare Kinds = array[2]
#declare Kinds[0] = material { texture { pigment { rgbt 0.9 } finish { reflection 0.2 } } interior { ior 1.4 } }
#declare Kinds[1] = material { texture { pigment { rgb 0.2 } finish { reflection 0.3 Gloss(80) } } }
#macro Clear_Ball(C) sphere { 0, 0.5 pigment { C } finish { reflection 0.1 } interior { ior 1.2 } } #end
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
#for (I, 0, 1)
  object { Ball scale 0.6 translate <2*I - 1, 0, -0.5> material { Kinds[I] } }
#end
object { Clear_Ball(rgbft <0.9, 0.9, 1, 0.5, 0.4>) translate <0, 0.6, -1.6> }
POV
scene "clear pane before a glossy ball" << 'POV'
box { <-0.5, 1, -3>, <0.5, 2, -2.9> pigment { rgbf <0.9, 1, 0.9, 0.9> } }
object { Ball pigment { rgb 0.2 } finish { reflection 0.5 Gloss(100) } }
POV
scene "fog before a floor, a ball, and a ball behind a pane" << 'POV'
fog { distance 12 rgb <0.6, 0.7, 0.9> }
fog { fog_type 2 distance 3 fog_offset 0.3 fog_alt 0.3 rgb <0.9, 0.8, 0.6> turbulence 0.3 }
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
object { Ball pigment { rgb <0.5, 0.2, 0.1> } finish { reflection 0.5 Gloss(50) } }
sphere { <1.6, 0.8, -1.6>, 0.5 pigment { rgbt 0.9 } finish { reflection 0.1 } interior { ior 1.3 } hollow }
box { <-2, 0.2, -1.5>, <-1, 1.5, -1.4> pigment { rgbt <0.8, 1, 0.8, 0.7> } }
POV
scene "solid glass in fog, beside hollow things without an interior" << 'POV'
fog { distance 8 rgb <0.6, 0.7, 0.9> }
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
#macro Put(Thing) object { Thing scale 1.2 } #end
Put(sphere { <-0.8, 0.8, -1>, 0.8 pigment { rgbf <0.9, 1, 0.9, 0.9> } finish { reflection 0.2 } interior { ior 1.3 } no_reflection })
Put(box { <0.3, 0.1, -1.3>, <1.6, 1.5, -1> hollow pigment { rgbt 0.7 } })
POV
whole_scene "fog in a space that isn't linear" << 'POV'
#version 3.7;
global_settings { assumed_gamma 2.2 }
#include "stage.inc"
fog { distance 12 rgb <0.6, 0.7, 0.9> }
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
POV
scene "a rainbow before a floor" << 'POV'
rainbow {
  angle 30 width 30 distance 3 direction <-0.2, -0.2, 1>
  color_map { [0 rgbt <0.9, 0.1, 0.2, 0.6>] [1 rgbt <0.1, 0.3, 0.9, 0.6>] }
}
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
POV
scene "media before a floor and a ball" << 'POV'
media { absorption <0.1, 0.06, 0.03> emission <0.02, 0.03, 0.05> method 3 intervals 1 samples 30 jitter 0 }
sphere { 0, 30 hollow pigment { rgb 0.5 } }
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
object { Ball pigment { rgb <0.5, 0.2, 0.1> } finish { reflection 0.5 Gloss(50) } }
POV
scene "the camera in an object with media" << 'POV'
sphere {
  0, 20 hollow pigment { rgbt 1 }
  interior { media { absorption <0.1, 0.06, 0.03> emission <0.02, 0.03, 0.05> method 3 intervals 1 samples 30 jitter 0 } }
}
object { Floor pigment { rgb 0.2 } finish { reflection 0.4 Gloss(100) } }
object { Ball pigment { rgb <0.5, 0.2, 0.1> } finish { reflection 0.5 Gloss(50) } }
POV

# Light under surfaces is random: only its average tells it from what is missing without it.
cat > "$folder/under.pov" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 mm_per_unit 40 subsurface { samples 40, 10 } }
#include "stage.inc"
object { Floor pigment { rgb 0.8 } finish { reflection 0.1 subsurface { translucency <0.4, 0.3, 0.2> } } interior { ior 1.4 } }
object { Ball scale 0.7 pigment { rgb <0.8, 0.7, 0.5> } finish { subsurface { translucency <5, 3, 1> } } interior { ior 1.4 } }
object { Ball scale 0.7 translate x*1.6 pigment { rgb <0.2, 0.1, 0.1> } finish { reflection 0.6 Gloss(50) } }
POV
under_surfaces() {
    local file=$folder/under
    judge "$file"
    awk "BEGIN { exit !($(rmse "$file-truth.exr" "$file-mirror.exr") < 0.03) }"
}
check "light under surfaces beside a glossy ball" under_surfaces
scene "a union of glass, glossy and dull things" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.2 } }
union {
  sphere { <-1, 0.9, 0>, 0.8 pigment { rgbf <0.9, 1, 0.9, 0.9> } finish { reflection 0.2 } interior { ior 1.5 } }
  union {
    sphere { <0.3, 0.4, -0.5>, 0.4 pigment { rgb <0.5, 0.2, 0.1> } finish { reflection 0.5 Gloss(50) } }
    #for (I, 0, 2)
      sphere { <1.5, 0.3 + I*0.6, 0>, 0.3 pigment { rgbt I/2 } finish { reflection 0.3 #if (I = 0) Gloss(50) #end }
        interior { ior 1.3 } }
    #end
  }
  box { <-2, 0, 0.8>, <-0.4, 0.5, 1> pigment { rgb y } }
  object { Ball scale 0.4 translate <0.9, 0, 0.4> pigment { rgb 0.2 } finish { reflection 0.5 Gloss(50) } }
  rotate y*20
}
POV
scene "unions of such things by names and macros" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.2 } }
#macro Gold() texture { pigment { rgb <0.5, 0.3, 0.1> } finish { reflection 0.5 Gloss(50) } } #end
#declare Things = union {
  sphere { <0, 0.5, 0>, 0.5 pigment { rgbf <0.9, 1, 0.9, 0.9> } finish { reflection 0.2 } interior { ior 1.5 } }
  union { sphere { <-0.8, 0.2, -0.9>, 0.2 } cone { <-0.8, 0.4, -0.9>, 0.1, <-0.8, 0.7, -0.9>, 0 } Gold() }
  box { <0.5, 0, 0.3>, <0.9, 0.5, 0.7> pigment { rgb y } }
};
#macro Pair(Ior)
  union {
    object { Things translate z }
    #local Tall = cylinder { 0, y*1.5, 0.2 };
    object { Tall texture { pigment { rgbt 0.8 } finish { reflection 0.1 } } interior { ior Ior } }
  }
#end
object { Things scale 1.3 translate <1.3, 0, -1> }
union {
  object { Pair(1.3) translate -x*0.4 }
  object { Things rotate y*70 translate -x*1.7 }
}
POV
gloss=(--gloss all=300)
scene "glass without a name, its finish before its pigment" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 } }
sphere {
  <-1, 0.9, -1>, 0.8
  texture { finish { reflection 0.3 } normal { bumps 0.01 } pigment { rgbt <0.9, 0.5, 0.5, 0.9> } } interior { ior 1.4 }
}
sphere {
  <1, 0.9, -1>, 0.8
  finish { reflection 0.3 } // a line
  pigment { rgbf <0.9, 1, 0.9, 0.9> } interior { ior 1.4 }
}
POV
scene "glass by default" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 } }
#default { texture { pigment { rgbf <1, 0.9, 0.9, 0.8> } finish { reflection 0.2 } } }
sphere { <1, 0.9, -1>, 0.8 interior { ior 1.4 } }
union {
  sphere { <-1, 0.9, -1>, 0.8 interior { ior 1.4 } }
  sphere { <0, 0.4, -1>, 0.4 pigment { rgb x } finish { reflection 0.3 } }
}
#macro Put(Thing) object { Thing translate x*1.5 } #end
Put(sphere { <0, 0.4, -2>, 0.3 pigment { rgb y } finish { reflection 0.5 } })
POV
scene "objects by macros that call macros" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 } }
#macro Rod(L) union { cylinder { 0, y*L, 0.1 pigment { rgb x } } cone { y*L, 0.2, y*(L + 0.3), 0 pigment { rgb y } } } #end
#macro Rods(A, B)
  union { object { Rod(A) } sphere { <-0.5, 0.3, 0>, 0.2 pigment { rgb z } } object { Rod(B) rotate x*70 } }
#end
object { Rods(1, 2) scale 0.8 }
sphere { <1, 0.9, -1>, 0.5 pigment { rgbt <0.9, 0.5, 0.5, 0.9> } finish { reflection 0.2 } }
POV
gloss=()
end_of_scenes
