// povgloss render railing.pov +W640 +H480 +A0.3 -o railing.png
// Thin things on a glossy floor before bright ones far away: a railing, a wheel and reeds on polished granite, the evening
// sky and houses across the water. At its foot each bar is mirrored sharp; a hand's breadth up it is thinner than the lobe.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }

camera {
  location <0.3, 1.35, -4.2>
  up y
  right x*image_width/image_height
  angle 52
  look_at <0, 0.35, 0>
}

sky_sphere {
  pigment {
    gradient y
    color_map {
      [0.00 rgb <1.30, 0.75, 0.35>]
      [0.20 rgb <0.90, 0.60, 0.50>]
      [0.50 rgb <0.30, 0.40, 0.65>]
      [1.00 rgb <0.08, 0.15, 0.40>]
    }
  }
}
light_source { <-30, 18, -20> rgb <1.3, 1.05, 0.8> parallel point_at 0 }

box {
  <-8, -0.5, -8>, <8, 0, 1.6>
  pigment { rgb <0.10, 0.10, 0.11> }
  finish { ambient 0 diffuse 0.6 reflection { 0.2, 0.8 fresnel } Gloss(300) }
  interior { ior 1.6 }
}
plane { y, -2 pigment { rgb <0.10, 0.16, 0.20> } finish { ambient 0 diffuse 0.8 } }

// Houses across the water.
#declare House_Seed = seed(12);
#declare I = 0;
#while (I < 12)
  box {
    <-24 + 4*I, -2, 26>, <-20.3 + 4*I, 4 + 5*rand(House_Seed), 30>
    pigment { rgb <0.35 + 0.6*rand(House_Seed), 0.30 + 0.4*rand(House_Seed), 0.25 + 0.4*rand(House_Seed)> }
    finish { ambient 0 diffuse 0.8 emission 0.15 }
  }
  #declare I = I + 1;
#end

#declare Iron = texture { pigment { rgb <0.05, 0.06, 0.06> } finish { ambient 0 diffuse 0.8 specular 0.3 roughness 0.03 } }
#declare Bar = 0.012;

// The railing: bars from the floor to the rail, closer and closer to the right.
union {
  #declare X = -2.6;
  #while (X < 2.6)
    cylinder { <X, 0, 0.5>, <X, 0.95, 0.5>, Bar }
    #declare X = X + 0.23 - 0.03*X;
  #end
  cylinder { <-2.7, 0.95, 0.5>, <2.7, 0.95, 0.5>, 2*Bar }
  cylinder { <-2.7, 0.12, 0.5>, <2.7, 0.12, 0.5>, Bar }
  texture { Iron }
}

// A wheel leans on it: a rim and spokes as thin as wire.
union {
  torus { 0.42, 0.016 rotate x*90 }
  #declare I = 0;
  #while (I < 16)
    cylinder { 0, y*0.42, 0.004 rotate z*22.5*I }
    #declare I = I + 1;
  #end
  sphere { 0, 0.035 }
  texture { pigment { rgb <0.75, 0.15, 0.10> } finish { ambient 0 diffuse 0.8 specular 0.3 roughness 0.03 } }
  translate y*0.436
  rotate <24, 30, 0>
  translate <-0.9, 0, 0.05>
}

// Reeds stand apart before it, leaning every way.
#declare Reed_Seed = seed(3);
#declare I = 0;
#while (I < 14)
  cone {
    0, 0.011, y*(0.5 + 0.4*rand(Reed_Seed)), 0.002
    rotate <-25 + 50*rand(Reed_Seed), 0, -25 + 50*rand(Reed_Seed)>
    translate <0.5 + 1.1*rand(Reed_Seed), 0, -0.9 + 0.8*rand(Reed_Seed)>
    pigment { rgb <0.75, 0.70, 0.30> }
    finish { ambient 0 diffuse 0.8 }
  }
  #declare I = I + 1;
#end
