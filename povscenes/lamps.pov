// povgloss render lamps.pov +W640 +H480 +A0.3 -o lamps.png
// Small lamps a hundred times as bright as white over a glossy table at night: in the blur each is a pool of light that is
// thousands of times its own size.
#version 3.7;
#include "povgloss.inc"
global_settings { assumed_gamma 1.0 }

camera {
  location <0, 1.9, -6>
  up y
  right x*image_width/image_height
  angle 46
  look_at <0, 0.55, 0>
}

background { rgb <0.010, 0.012, 0.025> }
light_source { <-4, 8, -6> rgb 0.25 }

box {
  <-6, -0.2, -5>, <6, 0, 4>
  pigment { rgb <0.06, 0.04, 0.035> }
  finish { ambient 0 diffuse 0.6 reflection { 0.15, 0.8 fresnel } Gloss(300) }
  interior { ior 1.5 }
}

// Bulbs on a wire, the brighter the higher.
#declare I = 0;
#while (I < 9)
  #declare Place = <-2.4 + 0.6*I, 0.75 + 0.55*abs(sin(I*1.3)), 1.2 - 0.5*mod(I, 3)>;
  sphere { Place, 0.045 pigment { rgb <1, 0.55 + 0.05*I, 0.25 + 0.08*I> } finish { ambient 0 diffuse 0 emission 100 } no_shadow }
  light_source { Place rgb <0.16, 0.12, 0.08> fade_distance 1 fade_power 2 }
  cylinder { Place + y*0.045, <Place.x, 2.6, Place.z>, 0.012 pigment { rgb 0.05 } no_shadow }
  #declare I = I + 1;
#end

cone { <-1.3, 0, 0>, 0.45, <-1.3, 1.2, 0>, 0 pigment { rgb <0.75, 0.30, 0.22> } finish { ambient 0 diffuse 0.8 } }
box { <-0.35, 0, -0.35>, <0.35, 0.6, 0.35> rotate y*30 pigment { rgb <0.30, 0.45, 0.65> } finish { ambient 0 diffuse 0.8 } }
sphere { <1.4, 0.45, -0.3>, 0.45 pigment { rgb <0.8, 0.75, 0.6> } finish { ambient 0 diffuse 0.8 } }
