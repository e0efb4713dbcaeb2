// povgloss render puddles.pov +W640 +H480 +A0.3 -o puddles.png
// A street after the rain, its roughness painted: where the map is white, water stands, and the lights are mirrored
// sharply (exponent 20000); where it is black, wet paving smears them (exponent 40). The post is steel, brushed in bands.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }

camera {
  location <0.4, 1.7, -8.0>
  up y
  right x*image_width/image_height
  angle 46
  look_at <0.2, 1.15, 0>
}

light_source { <-30, 40, -20> rgb <0.10, 0.13, 0.20> }
sky_sphere { pigment { gradient y color_map { [0.0 rgb <0.30, 0.16, 0.12>] [0.5 rgb <0.03, 0.05, 0.12>] } } }

#declare Dry = finish { ambient 0 diffuse 0.7 }

// ---- The street

#declare Puddles = pigment {
  bozo warp { turbulence 0.5 octaves 4 lambda 2.2 }
  color_map { [0.46 rgb 0] [0.52 rgb 1] }
  scale <1.7, 1, 1.3>
}
plane {
  y, 0
  texture {
    pigment { brick srgb 0.10, srgb <0.30, 0.27, 0.25> brick_size <0.6, 1, 0.3> mortar 0.02 }
    finish { Dry reflection { 0.10, 0.75 fresnel } Gloss_Map(Puddles, 40, 20000) }
    translate <0.1, 0.5, 0>
  }
  interior { ior 1.6 }
}

// ---- A house with lit windows

box { <-9, 0, 4.6>, <9, 6, 5> pigment { srgb <0.32, 0.26, 0.24> } finish { Dry } }
#declare Lit = array[5] {
  rgb <0.95, 0.6, 0.2>, rgb <0.9, 0.7, 0.4>, rgb <0.2, 0.45, 0.7>, rgb <0.9, 0.4, 0.1>, rgb <0.8, 0.8, 0.65>
}
#declare Window_Seed = seed(12);
#declare I = -5;
#while (I <= 5)
  #declare J = 0;
  #while (J < 2)
    union {
      #declare Colour = Lit[int(5*rand(Window_Seed))]*(rand(Window_Seed) < 0.75 ? 1 : 0.04);
      box { <-0.45, 0, 0>, <-0.03, 1.1, 0.1> }
      box { <0.03, 0, 0>, <0.45, 1.1, 0.1> }
      pigment { rgb Colour }
      finish { emission 1 ambient 0 diffuse 0 }
      no_shadow
      translate <1.5*I, 0.8 + 2.0*J, 4.52>
    }
    #declare J = J + 1;
  #end
  #declare I = I + 1;
#end

// ---- Lamps, bollards, a ball that someone left

#macro Lamp(X, Z, Colour)
  union {
    cylinder { 0, 2.6*y, 0.05 pigment { rgb 0.05 } finish { Dry } }
    sphere { 2.75*y, 0.2 pigment { rgb Colour*3 } finish { emission 1 ambient 0 diffuse 0 } no_shadow }
    light_source { 2.75*y rgb Colour*2.2 fade_distance 2 fade_power 2 }
    translate <X, 0, Z>
  }
#end
Lamp(-2.6, 2.2, <1.0, 0.75, 0.4>)
Lamp(2.4, 3.2, <0.6, 0.8, 1.0>)
#declare I = 0;
#while (I < 4)
  union {
    cylinder { 0, 0.7*y, 0.11 }
    sphere { 0.7*y, 0.11 }
    pigment { gradient y color_map { [0.6 srgb <0.8, 0.1, 0.08>] [0.6 srgb 0.9] } scale 0.4 }
    finish { Dry specular 0.2 }
    translate <-0.9 + 1.0*I, 0, 1.4 - 0.5*I>
  }
  #declare I = I + 1;
#end
sphere { <-1.25, 0.28, -1.6>, 0.28 pigment { gradient x color_map { [0.5 srgb <0.9, 0.7, 0.1>] [0.5 srgb <0.1, 0.3, 0.7>] } scale 0.28 rotate 40 } finish { Dry specular 0.3 } }

// ---- The post

#declare Bands = pigment { gradient y color_map { [0.5 rgb 0] [0.5 rgb 1] } scale 0.36 }
cylinder {
  <-2.05, 0, -0.9>, <-2.05, 3.2, -0.9>, 0.34
  pigment { srgb <0.30, 0.31, 0.33> }
  finish { ambient 0 diffuse 0.3 reflection 0.6 Gloss_Map(Bands, 60, 6000) }
}
