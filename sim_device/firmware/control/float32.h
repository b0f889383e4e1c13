/* The few float32 operations the law needs, so that it never calls into libm. */
#ifndef SPINDLE_FLOAT32_H
#define SPINDLE_FLOAT32_H

/* False for NaN and both infinities; needs a build without fast-math. */
static inline int float32_is_finite(float value) { return value - value == 0.0f; }

/* Quiet NaN: the value of what is not known. */
static inline float float32_missing(void) { return __builtin_nanf(""); }

/* A NaN as the first value stays one: what is computed comes first, what it is held against second,
 * so that no limit makes a number of what is none. */
static inline float float32_min(float value, float most) { return value > most ? most : value; }

static inline float float32_max(float value, float least) { return value < least ? least : value; }

static inline float float32_abs(float value) { return value < 0.0f ? -value : value; }

static inline float float32_clamp(float value, float low, float high)
{
    return float32_max(float32_min(value, high), low);
}

/* One instruction where the compiler is told -fno-math-errno; `value` must not be negative. */
static inline float float32_sqrt(float value) { return __builtin_sqrtf(value); }

#endif
