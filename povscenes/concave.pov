// povgloss render concave.pov +W640 +H480 +A0.3 -o concave.png
// Concave mirrors: a satin bowl before a bent satin wall, with marbles in and about them. Mirrored rays cross on their way,
// and a thing may be seen in several places.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }

camera {
  location <0, 3.4, -6.2>
  up y
  right x*image_width/image_height
  angle 44
  look_at <0, 0.95, 0>
}

sky_sphere {
  pigment {
    gradient y
    color_map { [0.0 rgb <0.75, 0.68, 0.60>] [0.3 rgb <0.45, 0.55, 0.72>] [1.0 rgb <0.12, 0.20, 0.42>] }
  }
}
light_source { <-7, 12, -9> rgb <1.1, 1.0, 0.85> }
light_source { <9, 6, -4> rgb <0.15, 0.2, 0.3> shadowless }

plane { y, 0 pigment { checker rgb <0.82, 0.78, 0.70> rgb <0.60, 0.55, 0.50> scale 0.9 } finish { ambient 0 diffuse 0.8 } }

#declare Satin = texture {
  pigment { rgb <0.30, 0.28, 0.26> }
  finish { ambient 0 diffuse 0.2 reflection 0.75 Gloss(300) }
}

// The bowl, cut from a ball, and a third of a pipe behind it.
difference {
  sphere { <0, 1.6, 0>, 1.6 }
  sphere { <0, 1.6, 0>, 1.54 }
  box { <-2, 0.95, -2>, <2, 4, 2> }
  texture { Satin }
}
difference {
  cylinder { 0, y*2.4, 4.2 }
  cylinder { -y, y*3, 4.12 }
  box { <-5, -1, -5>, <5, 4, 2.1> }
  texture { Satin }
}

#macro Marble(Place, Size, Colour)
  sphere { Place + y*Size, Size pigment { gradient y color_map { [0.5 rgb Colour] [0.5 rgb 0.92] } scale 0.25 }
           finish { ambient 0 diffuse 0.85 specular 0.3 roughness 0.02 } }
#end
Marble(<0.10, 0.06, -0.15>, 0.30, <0.85, 0.25, 0.20>)
Marble(<-0.50, 0.24, 0.15>, 0.20, <0.15, 0.45, 0.75>)
Marble(<-2.15, 0, -0.60>, 0.38, <0.95, 0.70, 0.15>)
Marble(<2.10, 0, -0.20>, 0.50, <0.20, 0.55, 0.35>)
cylinder { <-1.5, 0, 1.6>, <-1.5, 1.5, 1.6>, 0.09 pigment { rgb <0.85, 0.35, 0.15> } }
cylinder { <1.4, 0, 1.9>, <1.7, 1.9, 1.6>, 0.06 pigment { rgb <0.25, 0.20, 0.60> } }
