// povgloss render spheres.pov +W640 +H480 +A0.3 -o spheres.png
// Brushed steel and lacquered balls on a matt rug of coloured rings, in a studio with light panels and painted walls.
// Curved mirrors that see each other: plain, declared and moved, scaled into an egg, rotated in a union, made by a macro.
// The bar between two of them is matt, and so is the rug: most of what they mirror is not glossy.
#version 3.7;
#include "colors.inc"
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 max_trace_level 7 }

camera {
  location <-0.6, 3.1, -7.4>
  up y
  right x*image_width/image_height
  angle 43
  look_at <0.05, 0.78, 0.15>
}

// ---- The studio: floor, four walls, ceiling; two light panels and a window-like strip.

light_source {
  <-3.4, 6.4, -3.4> rgb <1.22, 1.12, 0.98>
  area_light <1.6, 0, 0>, <0, 0, 1.6>, 3, 3 adaptive 1
}
light_source { <5.6, 3.6, -1.5> rgb <0.36, 0.42, 0.54> }
light_source { <0, 3, -5> rgb 0.26 shadowless }

#declare Wall = finish { ambient 0 diffuse 0.6 emission 0.16 }
#declare Panel = finish { ambient 0 diffuse 0 emission 1 }

// The painted wall at the back: a skyline of blocks in four colours.
#declare Paint = array[6] {
  srgb <0.89, 0.35, 0.27>, srgb <0.96, 0.72, 0.28>, srgb <0.13, 0.42, 0.50>,
  srgb <0.93, 0.88, 0.78>, srgb <0.42, 0.24, 0.40>, srgb <0.37, 0.62, 0.56>
}
#declare Wall_Seed = seed(2002);
union {
  box { <-7, 0, 6>, <7, 7, 6.2> pigment { srgb <0.90, 0.85, 0.76> } }
  #declare I = 0;
  #while (I < 14)
    box {
      <-7 + I, 0, 5.99 - 0.001*I>, <-6 + I, 0.9 + 2.5*rand(Wall_Seed), 6.1>
      pigment { Paint[mod(I*5, 6)] }
    }
    #declare I = I + 1;
  #end
  finish { Wall }
}
box { <-7.2, 0, -11>, <-7, 7, 6> pigment { srgb <0.13, 0.38, 0.47> } finish { Wall } }
box {
  <7, 0, -11>, <7.2, 7, 6>
  pigment {
    gradient y
    color_map { [0.5 srgb <0.88, 0.44, 0.28>] [0.5 srgb <0.95, 0.76, 0.45>] }
    scale 1.4
  }
  finish { Wall }
}
box {
  <-7, 0, -11.2>, <7, 7, -11>
  pigment {
    gradient x
    color_map {
      [0.30 srgb <0.93, 0.88, 0.78>] [0.30 srgb <0.42, 0.24, 0.40>]
      [0.55 srgb <0.42, 0.24, 0.40>] [0.55 srgb <0.96, 0.72, 0.28>]
      [0.75 srgb <0.96, 0.72, 0.28>] [0.75 srgb <0.13, 0.42, 0.50>]
    }
    scale 4.67 translate x*2.33
  }
  finish { Wall }
}
box { <-7, 7, -11>, <7, 7.2, 6> pigment { color Gray60 } finish { Wall } }
box { <-5.2, 6.9, -5.2>, <-1.6, 6.95, -1.6> pigment { rgb <2.2, 2.05, 1.85> } finish { Panel } no_shadow }
box { <2.2, 6.9, -1.2>, <5.2, 6.95, 3.2> pigment { rgb <1.0, 1.15, 1.45> } finish { Panel } no_shadow }
box { <6.9, 1.6, -3.2>, <6.95, 5.4, -0.8> pigment { rgb <1.2, 1.3, 1.6> } finish { Panel } no_shadow }

plane { y, -0.02 pigment { srgb <0.74, 0.68, 0.60> } finish { ambient 0.03 diffuse 0.75 } }
cylinder {
  -y*0.02, 0, 4.1
  pigment {
    wood
    color_map {
      [0.00 srgb <0.93, 0.88, 0.78>] [0.25 srgb <0.93, 0.88, 0.78>]
      [0.25 srgb <0.13, 0.42, 0.50>] [0.50 srgb <0.13, 0.42, 0.50>]
      [0.50 srgb <0.96, 0.72, 0.28>] [0.62 srgb <0.96, 0.72, 0.28>]
      [0.62 srgb <0.84, 0.32, 0.26>] [1.00 srgb <0.84, 0.32, 0.26>]
    }
    rotate x*90
    scale 1.366
  }
  finish { ambient 0.03 diffuse 0.75 }
  translate <0.2, 0, 0.4>
}

// ---- Glossy textures

// Used twice: on the big ball and on the egg.
#declare Steel = texture {
  pigment { color Gray70 }
  finish {
    ambient 0 diffuse 0.16
    reflection 0.72
    metallic
    Gloss(220)
  }
}

#macro Lacquer(Colour)
  texture {
    pigment { Colour }
    finish {
      Gloss(220)
      ambient 0 diffuse 0.72
      reflection { 0.10, 0.85 fresnel on }
      conserve_energy
    }
  }
#end

// ---- The balls

sphere { <0.15, 1.25, 0.95>, 1.25 texture { Steel } }

// One declared ball, painted, in three sizes.
#declare Ball = sphere { 0, 1 interior { ior 1.6 } }
object { Ball Lacquer(srgb <0.80, 0.12, 0.10>) scale 0.62 translate <-1.35, 0.62, -0.75> }
object { Ball Lacquer(srgb <0.08, 0.30, 0.40>) scale 0.40 translate <-0.18, 0.40, -1.42> }
object { Ball Lacquer(srgb <0.90, 0.58, 0.10>) scale 0.30 translate <-2.05, 0.30, -1.55> }

// An egg: the texture comes before the scaling, the lean after it.
sphere {
  0, 1
  texture { Steel }
  scale <0.52, 0.74, 0.52>
  rotate z*(-14)
  translate <-2.15, 0.737, 0.95>
}

// A barbell set down on the rug: two balls and a matt bar, turned as one.
#declare Barbell = union {
  sphere { -x*0.78, 0.46 }
  sphere { x*0.78, 0.34 }
  cylinder { -x*0.5, x*0.6, 0.09 texture { pigment { srgb <0.93, 0.88, 0.78> } finish { ambient 0 diffuse 0.8 } } }
  Lacquer(srgb <0.34, 0.14, 0.36>)
  interior { ior 1.6 }
}

object { Barbell rotate z*(-4.4) rotate y*(-24) translate <2.75, 0.40, 1.25> }

// A string of beads on an arc.
#macro Bead(Angle, Size, Colour)
  sphere {
    <0, Size, 0>, Size
    Lacquer(Colour)
    interior { ior 1.6 }
    translate z*(-1.95)
    rotate y*Angle
    translate <0.15, 0, 0.95>
  }
#end
Bead(-20, 0.20, Paint[1])
Bead(-33, 0.17, Paint[5])
Bead(-45, 0.20, Paint[0])
Bead(-56, 0.15, Paint[3])
Bead(-66, 0.18, Paint[2])
