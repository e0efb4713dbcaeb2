// povgloss render two_exponents.pov +W640 +H480 +A0.3 -o two_exponents.png
// One row of colour pencils on a desk of lanes, in turn polished (exponent 2000) and brushed (exponent 60).
// Each lane is an object with a texture of its own; the pencils, a cup, a ball of wool and dice stand on both kinds,
// so that every mirror image changes from crisp to blurred where it crosses from one lane into the next.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }

camera {
  location <0.0, 3.3, -8.2>
  up y
  right x*image_width/image_height
  angle 42
  look_at <0, 0.95, 0>
}

light_source {
  <-5.5, 10, -3.5> rgb <1.25, 1.18, 1.06>
  area_light <1.3, 0, 0>, <0, 0, 1.3>, 3, 3 adaptive 1
}
light_source { <7, 5, -4> rgb <0.34, 0.38, 0.46> }
light_source { <0, 3, -9> rgb 0.22 shadowless }

#declare Matt = finish { ambient 0 diffuse 0.8 }
#declare Varnish = finish { ambient 0 diffuse 0.78 specular 0.3 roughness 0.02 }

// A sheet of paper for a backdrop, light at the bottom, darker above.
box {
  <-16, -1, 5.2>, <16, 9, 5.3>
  pigment {
    gradient y
    color_map {
      [0.0 srgb <0.96, 0.86, 0.70>]
      [0.3 srgb <0.90, 0.75, 0.58>]
      [0.7 srgb <0.46, 0.48, 0.54>]
      [1.0 srgb <0.24, 0.32, 0.44>]
    }
    scale 7
  }
  finish { Matt emission 0.10 }
}
sky_sphere { pigment { gradient y color_map { [0.0 srgb <0.50, 0.46, 0.44>] [1.0 srgb <0.70, 0.74, 0.80>] } } }

// ---- The desk

#declare Lane_Width = 1.3;

#declare Polished = texture {
  pigment { srgb <0.07, 0.13, 0.18> }
  finish { ambient 0 diffuse 0.7 reflection 0.42 Gloss(2000) }
}
#declare Brushed = texture {
  pigment { srgb <0.34, 0.38, 0.40> }
  finish { ambient 0 diffuse 0.7 Gloss(60) reflection { 0.42 } }
}

#declare Lane = box { <-Lane_Width/2 + 0.012, -0.3, -6>, <Lane_Width/2 - 0.012, 0, 5.2> }
#declare I = -6;
#while (I <= 6)
  object {
    Lane
    #if (mod(I + 6, 2) = 0) texture { Polished } #else texture { Brushed } #end
    translate x*Lane_Width*I
  }
  #declare I = I + 1;
#end
box { <-9, -0.4, -6>, <9, -0.02, 5.2> pigment { srgb <0.80, 0.62, 0.32> } finish { Matt } }

// ---- Pencils

#macro Hex_Rod(Radius, Bottom, Top)
  prism {
    linear_sweep linear_spline Bottom, Top, 7,
    #local K = 0;
    #while (K < 7)
      <Radius*cos(K*pi/3), Radius*sin(K*pi/3)>
      #local K = K + 1;
    #end
  }
#end

// Stands on its blunt end; Height is that of the lacquered part.
#macro Pencil(Colour, Height)
  union {
    object { Hex_Rod(0.20, 0.16, Height) pigment { Colour } }
    cylinder { 0, y*0.10, 0.175 pigment { Colour } }
    cylinder { y*0.10, y*0.16, 0.185 pigment { srgb <0.92, 0.84, 0.62> } }
    intersection {
      cone { y*(Height - 0.18), 0.2667, y*(Height + 0.54), 0 }
      Hex_Rod(0.199, Height - 0.18, Height + 0.6)
      pigment {
        gradient y
        color_map {
          [0.72 srgb <0.87, 0.70, 0.48>]
          [0.72 Colour]
        }
        scale 0.72 translate y*(Height - 0.18)
      }
    }
    finish { Varnish }
  }
#end

#declare Rainbow = array[11] {
  srgb <0.52, 0.12, 0.22>, srgb <0.83, 0.17, 0.17>, srgb <0.93, 0.42, 0.14>, srgb <0.97, 0.68, 0.14>,
  srgb <0.98, 0.87, 0.26>, srgb <0.56, 0.74, 0.24>, srgb <0.13, 0.52, 0.34>, srgb <0.12, 0.60, 0.64>,
  srgb <0.15, 0.40, 0.74>, srgb <0.28, 0.24, 0.60>, srgb <0.58, 0.26, 0.58>
}
#declare Stand_Seed = seed(31);
#declare I = 0;
#while (I < 11)
  object {
    Pencil(Rainbow[I], 2.05 + 0.35*sin(I*0.9) + 0.25*rand(Stand_Seed))
    rotate y*60*rand(Stand_Seed)
    translate <-3.1 + 0.62*I, 0, 1.5 + 0.10*(rand(Stand_Seed) - 0.5)>
  }
  #declare I = I + 1;
#end

// One has fallen over, right across three lanes.
object {
  Pencil(srgb <0.94, 0.56, 0.52>, 1.9)
  rotate y*30
  rotate z*(-90)
  translate <0, 0.1735, 0>
  rotate y*9
  translate <-0.55, 0, -1.75>
}

// ---- A cup on a seam, a ball of wool, dice

union {
  difference {
    cone { 0, 0.40, y*0.82, 0.50 }
    cone { y*0.05, 0.36, y*0.83, 0.463 }
  }
  torus { 0.481, 0.019 translate y*0.82 }
  torus { 0.24, 0.055 rotate x*90 scale <1, 1.15, 1> translate <0.50, 0.43, 0> }
  pigment {
    gradient y
    color_map {
      [0.30 srgb <0.95, 0.92, 0.85>] [0.30 srgb <0.15, 0.40, 0.62>]
      [0.45 srgb <0.15, 0.40, 0.62>] [0.45 srgb <0.95, 0.92, 0.85>]
    }
    scale 0.84
  }
  finish { Varnish }
  rotate y*28
  translate <1.93, 0, -0.25>
}

// Wool: turns of thread about a core, each a thin torus.
union {
  #declare Wool_Seed = seed(9);
  sphere { 0, 0.50 pigment { srgb <0.62, 0.16, 0.18> } }
  #declare I = 0;
  #while (I < 90)
    torus {
      0.505, 0.024
      rotate <180*rand(Wool_Seed), 360*rand(Wool_Seed), 180*rand(Wool_Seed)>
      pigment { srgb <0.86, 0.26, 0.24> - 0.10*rand(Wool_Seed) }
    }
    #declare I = I + 1;
  #end
  finish { Matt }
  translate <-1.75, 0.529, -0.30>
}

#macro Die(Colour)
  difference {
    superellipsoid { <0.16, 0.16> pigment { Colour } }
    sphere { y, 0.24 }
    sphere { <0.5, 0.5, -1>, 0.20 }
    sphere { <-0.5, -0.5, -1>, 0.20 }
    sphere { <0, 0, -1>, 0.20 }
    sphere { <1, 0.5, 0.5>, 0.20 }
    sphere { <1, -0.5, -0.5>, 0.20 }
    sphere { <-1, 0.5, 0.5>, 0.20 }
    sphere { <-1, 0.5, -0.5>, 0.20 }
    sphere { <-1, -0.5, 0.5>, 0.20 }
    sphere { <-1, -0.5, -0.5>, 0.20 }
    pigment { srgb <0.96, 0.94, 0.90> }
    finish { Varnish }
    scale 0.21
    translate y*0.21
  }
#end
object { Die(srgb <0.13, 0.52, 0.44>) rotate y*24 translate <0.10, 0, -0.10> }
object { Die(srgb <0.96, 0.66, 0.16>) rotate y*(-35) translate <0.78, 0, -0.62> }
