#!/usr/bin/env bash
# Scenes in several files: where these lie, how deep they go, and what they are included in.
. tests/e2e/lib_scenes.sh

mkdir "$folder/parts"
put() {
    cat > "$folder/$1"
}

put polish.inc <<< 'reflection 0.5 Gloss(100)'
put texture.inc <<< 'texture { pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }'
put inside.inc <<< 'pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) }'
put open.inc <<< 'object { Floor pigment { rgb 0.3 } finish { reflection 0.5'
put close.inc <<< 'Gloss(100) } }'
put value.inc <<< '0.5'
put statement.inc <<< 'background { rgb 0.4 } global_settings { max_trace_level 4 }'
put media.inc <<< 'media { emission 0.1 }'
put camera.inc <<< 'camera { location <1, 2, -6> right x*4/3 angle 50 look_at <0, 0.6, 0> }'
put camera-inside.inc <<< 'location <1, 2, -6> right x*4/3 angle 50 look_at <0, 0.6, 0>'
put light-inside.inc <<< '<3, 4, -3> rgb 0.3'
put guarded.inc << 'POV'
#ifndef (Guarded_Inc)
#declare Guarded_Inc = version;
#version 3.5;
#declare Guarded_Finish = finish { reflection 0.5 Gloss(100) }
#macro Guarded_Ball(Where) object { Ball scale 0.5 translate Where pigment { rgb 0.1 } finish { Guarded_Finish } } #end
#version Guarded_Inc;
#end
POV
put twice.inc <<< 'object { Ball scale 0.3 translate x*(Count - 1) pigment { rgb 0.1 }
  finish { reflection 0.4 Gloss(100) } }'
put self.inc << 'POV'
#if (Count < 3)
  object { Ball scale 0.3 translate <Count - 1, 0, -1> pigment { rgb 0.1 } finish { reflection 0.4 Gloss(100) } }
  #declare Count = Count + 1;
  #include "self.inc"
#end
POV
put inside-out.inc <<< '#macro Outside() #include "inside.inc" #end'
for level in 1 2 3 4; do
    put "parts/level$level.inc" <<< "#include \"parts/level$((level + 1)).inc\" #declare Level = Level + 1;"
done
put parts/level5.inc << 'POV'
#declare Level = 1;
#declare Deep = finish { reflection 0.5 Gloss(100) }
#include "colors.inc"
POV

scene "an include inside a finish" << 'POV'
object { Floor pigment { rgb 0.3 } finish { #include "polish.inc" } }
POV
scene "an include inside a declared finish" << 'POV'
#declare F = finish { #include "polish.inc" }
object { Floor pigment { rgb 0.3 } finish { F } }
POV
scene "an include inside an object" << 'POV'
object { Floor #include "texture.inc" }
POV
scene "an include inside a texture" << 'POV'
object { Floor texture { #include "inside.inc" } }
POV
scene "an include in place of a value" << 'POV'
object { Floor pigment { rgb 0.3 } finish { reflection #include "value.inc" Gloss(100) } }
POV
scene "an include in place of an object's insides" << 'POV'
object { Floor #include "inside.inc" }
POV
scene "includes in macros, loops and conditionals" << 'POV'
#macro Thing(Where) object { Ball scale 0.5 translate Where #include "inside.inc" } #end
#for (Count, 0, 2) #include "twice.inc" #end
#if (0) #include "nowhere.inc" #else Thing(-z) #end
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "five levels of includes, the last one of the system" << 'POV'
#include "parts/level1.inc"
object { Floor pigment { Red*0.5 } finish { Deep } }
object { Ball scale 0.2*Level pigment { Blue*0.2 } finish { Deep } }
POV
scene "guards, #version and the same file twice" << 'POV'
#include "guarded.inc"
#include "guarded.inc"
object { Floor pigment { rgb 0.3 } finish { Guarded_Finish } }
Guarded_Ball(x)
POV
scene "statements and a camera from an include" << 'POV'
#include "statement.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
#include "camera.inc"
object { Ball translate x pigment { rgb 0.1 } finish { reflection 0.5 Gloss(100) } }
POV
scene "a camera and a light whose insides are included" << 'POV'
camera { #include "camera-inside.inc" }
light_source { #include "light-inside.inc" }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
scene "a file that includes itself, and one by a path with .." << 'POV'
#declare Count = 0;
#include "self.inc"
#include "parts/../inside-out.inc"
object { Floor Outside() }
POV
end_of_scenes
