#include "noise.h"

#define BITS_21 0x1FFFFFu
#define UNIT_21 (1.0 / 2097152.0)
#define UNIT_53 (1.0 / 9007199254740992.0)

/* splitmix64: every seed, zero included, starts a full-period sequence. */
static uint64_t draw(uint64_t *state)
{
    *state += 0x9E3779B97F4A7C15u;
    uint64_t bits = *state;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
    return bits ^ (bits >> 31);
}

double noise_uniform(uint64_t *state) { return (double)(draw(state) >> 11) * UNIT_53; }

/* Sum of twelve uniforms, three to a draw. */
double noise_gaussian(uint64_t *state)
{
    uint64_t sum = 0;
    for (int k = 0; k < 4; k++) {
        const uint64_t bits = draw(state);
        sum += (bits & BITS_21) + (bits >> 21 & BITS_21) + (bits >> 42 & BITS_21);
    }
    /* Twelve lower ends of cells 2^-21 wide: half a cell each brings the mean to 6. */
    return ((double)sum + 6.0) * UNIT_21 - 6.0;
}
