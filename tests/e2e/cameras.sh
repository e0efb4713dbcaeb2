#!/usr/bin/env bash
# Scenes with every type of camera.
. tests/e2e/lib_scenes.sh

# seen_by NAME: the inside of a camera is on standard input.
seen_by() {
    whole_scene "$1" < <(
        printf '#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#declare Own_Camera = 1;\n#include "stage.inc"\n'
        printf 'camera { '
        cat
        printf '}\nobject { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }\n'
        printf 'object { Ball translate x*1.2 pigment { rgb <0.3, 0.1, 0> } finish { reflection 0.5 Gloss(100) } }\n'
    )
}

place='location <0.3, 2.2, -4> right x*4/3 look_at <0, 0.8, 0>'
seen_by "perspective, with sky, up and right of its own" << 'POV'
perspective location <0.3, 2.2, -6> direction z*1.4 sky <0.1, 1, 0> up y right x*1.4 look_at <0, 0.8, 0>
POV
seen_by "without a word but where it is" <<< "location <0, 1, -5>"
seen_by "left-handed: right -x*4/3" <<< "location <0.3, 2.2, -6> right -x*4/3 angle 48 look_at <0, 0.8, 0>"
seen_by "sheared: direction not at right angles" << 'POV'
location <0.3, 1, -6> direction <0, 0, 1.5> up <0.2, 1, 0> right <1.333, 0, 0.3>
POV
seen_by "orthographic with an angle" <<< "orthographic angle 50 location <0.3, 2.2, -6> right x*4/3 look_at <0, 0.8, 0>"
seen_by "fisheye of 180 degrees" <<< "fisheye angle 180 $place"
seen_by "ultra_wide_angle" <<< "ultra_wide_angle angle 120 $place"
seen_by "omnimax" <<< "omnimax angle 120 $place"
seen_by "panoramic" <<< "panoramic angle 120 $place"
for type in 1 2 3 4; do
    seen_by "cylinder $type" <<< "cylinder $type angle 90 $place"
done
seen_by "spherical" <<< "spherical angle 200 100 $place"
seen_by "with a normal" << 'POV'
location <0.3, 2.2, -6> right x*4/3 angle 48 look_at <0, 0.8, 0> normal { bumps 0.05 scale 0.2 }
POV
seen_by "mesh_camera" << 'POV'
#declare Grid = mesh2 {
  vertex_vectors { 4, <-2, 4, -6>, <2, 4, -6>, <2, 1, -6>, <-2, 1, -6> }
  normal_vectors { 4, <-0.2, -0.1, 1>, <0.2, -0.1, 1>, <0.2, -0.5, 1>, <-0.2, -0.5, 1> }
  uv_vectors { 4, <0, 1>, <1, 1>, <1, 0>, <0, 0> }
  face_indices { 2, <0, 1, 2>, <0, 2, 3> }
}
mesh_camera { 1 3 mesh { Grid } } location z*0.0001
POV
whole_scene "a camera declared, changed where it is used, after another camera" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "stage.inc"
#declare Eyes = array[2]
#declare Eyes[0] = camera { location <2, 2.5, -5> right x*4/3 angle 50 look_at <0, 0.5, 0> }
#declare Eye = camera { Eyes[0] translate y*0.2 }
camera { Eye rotate y*10 }
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
POV
whole_scene "no camera" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare Own_Camera = 1;
#include "stage.inc"
object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } translate <0, -1, 4> }
POV
whole_scene "camera and settings in an include file inside a macro" << 'POV'
#version 3.7;
#declare Own_Camera = 1;
#fopen Out "eye.inc" write
#write (Out, "camera { location <1, 2, -6> right x*4/3 angle 48 look_at <0, 0.5, 0> }\n")
#fclose Out
#macro All(Gamma)
  global_settings { assumed_gamma 1.0 }
  #include "stage.inc"
  camera { location <1, 2, -6> right x*4/3 angle 48 look_at <0, 0.5, 0> }
  object { Floor pigment { rgb 0.3 } finish { reflection 0.5 Gloss(100) } }
#end
All(1)
POV
whole_scene "with focal blur" << 'POV'
#version 3.7;
global_settings { assumed_gamma 1.5 }
#declare Own_Camera = 1;
#include "stage.inc"
camera {
  location <0.3, 2.2, -6> right x*4/3 angle 48 look_at <0, 0.8, 0>
  aperture 0.3 focal_point <0, 0.5, -1> blur_samples 80 variance 0
}
#declare Mirror = texture { pigment { rgb <0.8, 0.5, 0.2> } finish { reflection { 0.6 metallic } diffuse 0.2 } };
object { Floor pigment { checker rgb 0.3 rgb 0.5 } finish { reflection 0.3 Gloss(100) } }
object { Ball texture { Mirror finish { Gloss(50) } } }
sphere { <1.5, 0.6, -1>, 0.6 texture { Mirror } }
sphere { <-1.6, 0.4, -2>, 0.4 pigment { rgbf <0.9, 1, 0.9, 0.9> } finish { reflection 0.1 } interior { ior 1.3 } }
POV
end_of_scenes
