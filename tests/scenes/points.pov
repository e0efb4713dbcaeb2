// povgloss passes points.pov +W160 +H120 -o points.exr
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "points.inc"
camera { location Eye direction View right Right up Up }
light_source { <-3, 8, -5>, 1 }
object { Glossy }
object { Matte }
