/* cos^p(theta) from tan^2(theta), in float and without branches: for the inner loops that are compiled once per
 * instruction set. */
#ifndef POVGLOSS_FILTER_WEIGHT_H
#define POVGLOSS_FILTER_WEIGHT_H

#include <stdint.h>
#include <string.h>

#define ALWAYS_INLINE static inline __attribute__((always_inline))
#define CONCATENATE_(a, b) a##b
#define CONCATENATE(a, b) CONCATENATE_(a, b)

/* Below this power of two a weight is 0: sums with it would run into denormals. */
#define LOWEST_POWER (-120.0f)

ALWAYS_INLINE uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

ALWAYS_INLINE float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* log2(1 + t), t from 0 to 2^100, relative error 3e-7. 1 + t = 2^e m with m about 1; z = m - 1 is found without
 * rounding 1 + t, so that it stays accurate for the smallest t. */
ALWAYS_INLINE float log2_of_1_plus(float t)
{
    const uint32_t sqrt_half = 0x3f3504f3;
    int32_t e = (int32_t)(bits_of(1.0f + t) - sqrt_half) >> 23;
    float scale = float_of(0x3f800000u - ((uint32_t)e << 23));
    float z = t * scale + (scale - 1.0f);
    float p = -0.145811617f;
    p = p * z + 0.234042332f;
    p = p * z - 0.24887687f;
    p = p * z + 0.287098706f;
    p = p * z - 0.360239625f;
    p = p * z + 0.480923235f;
    p = p * z - 0.721352816f;
    p = p * z + 1.4426949f;
    return p * z + (float)e;
}

/* 2^power, power at most 0, relative error 2e-7; exactly 1 at 0; 0 at LOWEST_POWER and below, and for NaN. */
ALWAYS_INLINE float power_to_weight(float power)
{
    const float round = 12582912.0f; /* 1.5 * 2^23: adding it rounds to an integer, which its low bits then hold */
    float y = power > LOWEST_POWER ? power : LOWEST_POWER;
    float shifted = y + round;
    float r = y - (shifted - round);
    float p = 0.00132647273f;
    p = p * r + 0.00967151299f;
    p = p * r + 0.0555073358f;
    p = p * r + 0.240222424f;
    p = p * r + 0.693147004f;
    p = p * r + 1.0f;
    p = float_of(bits_of(p) + (bits_of(shifted) << 23));
    return power > LOWEST_POWER ? p : 0.0f;
}

#endif
