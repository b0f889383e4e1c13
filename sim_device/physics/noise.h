/* Seeded randomness: one 64-bit word of state per source, so that sources never disturb another. */
#ifndef SPINDLE_NOISE_H
#define SPINDLE_NOISE_H

#include <stdint.h>

/* 0 <= value < 1. */
double noise_uniform(uint64_t *state);

/* Mean 0, standard deviation 1, never beyond 6: no amplifier jumps further. */
double noise_gaussian(uint64_t *state);

#endif
