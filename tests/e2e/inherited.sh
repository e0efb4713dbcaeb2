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
end_of_scenes
