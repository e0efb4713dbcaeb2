/* The space in which a renderer adds light: a power of linear light, or the sRGB curve (GBUFFER_GAMMA_SRGB). */
#ifndef POVGLOSS_GAMMA_H
#define POVGLOSS_GAMMA_H

/* Linear light to the working space: v^(1/gamma). A gamma of 0 or 1 is linear; negative values keep their sign; the
 * sRGB curve (IEC 61966-2-1) goes on beyond 1. */
double gamma_encode(double gamma, double linear);

/* The inverse. */
double gamma_decode(double gamma, double encoded);

#endif
