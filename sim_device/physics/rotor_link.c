#include "rotor_link.h"

#include <math.h>

#include "noise.h" // noise_uniform

#define WORD_BITS 32.0
#define NEVER 1e300

/* CRC-4 with x^4 + x + 1 over the upper 28 bits, four bits at a time; start value 15, so that a
 * line that is all zeros is no word. */
static uint32_t check_of(uint32_t word)
{
    static const uint8_t STEP[16] = {0, 3, 6, 5, 12, 15, 10, 9, 11, 8, 13, 14, 7, 4, 1, 2};
    uint32_t check = 15;
    for (int shift = 28; shift >= 4; shift -= 4) check = STEP[check ^ (word >> shift & 15u)];
    return check;
}

uint32_t rotor_link_word(int16_t counts, int8_t temperature_degc, uint8_t sequence)
{
    const uint32_t word = (uint32_t)(uint16_t)counts << 16 |
                          (uint32_t)(uint8_t)temperature_degc << 8 |
                          (uint32_t)(sequence & 15u) << 4;
    return word | check_of(word);
}

void rotor_link_reset(rotor_link_state *state, int8_t temperature_degc)
{
    const rotor_link_state running = {
        .bits_to_error = NEVER,
        .in_flight = rotor_link_word(0, temperature_degc, 15),
        .in_flight_present = 1,
    };
    *state = running;
}

void rotor_link_seed(rotor_link_state *state, uint64_t seed)
{
    state->random = seed;
    state->error_rate = 0.0; /* the next exchange draws a gap from the new noise */
    state->bits_to_error = NEVER;
}

/* The gap to the next error is geometric, so a word without one costs nothing. */
static void gap_draw(rotor_link_state *state, double rate)
{
    state->error_rate = rate;
    state->bits_to_error = NEVER;
    if (rate > 0.0) {
        state->bits_to_error = floor(log1p(-noise_uniform(&state->random)) / log1p(-rate));
    }
}

static uint32_t errors_draw(rotor_link_state *state, double rate)
{
    uint32_t flipped = 0;
    if (rate != state->error_rate) gap_draw(state, rate);
    while (state->bits_to_error < WORD_BITS) {
        const double at = state->bits_to_error;
        flipped |= 1u << (unsigned)at;
        gap_draw(state, rate);
        state->bits_to_error += at + 1.0;
    }
    state->bits_to_error -= WORD_BITS;
    return flipped;
}

/* Passing the bad place on the turn may open a burst; its length is geometric. */
static void burst_step(const rotor_link_config *config, rotor_link_state *state, double angle_deg)
{
    const double before = fmod(state->last_angle_deg - config->burst_angle_deg + 720.0, 360.0);
    const double now = fmod(angle_deg - config->burst_angle_deg + 720.0, 360.0);
    state->last_angle_deg = angle_deg;
    if (!(config->burst_share > 0.0)) {
        state->in_burst = 0;
        return;
    }
    if (state->in_burst) {
        state->in_burst = noise_uniform(&state->random) * config->burst_words >= 1.0;
    }
    if (before > 270.0 && now < 90.0) {
        state->in_burst |= noise_uniform(&state->random) < config->burst_share;
    }
}

static int powered(const rotor_link_config *config, rotor_link_state *state, int lost)
{
    if (lost || config->coupling < config->coupling_min) {
        state->restart_left_s = config->restart_s;
        return 0;
    }
    if (state->restart_left_s > 0.0) {
        state->restart_left_s -= ROTOR_LINK_PERIOD_MS * 1e-3;
        if (state->restart_left_s > 0.0) return 0;
        state->sequence = 0; /* a processor that has just started */
    }
    return 1;
}

void rotor_link_exchange(const rotor_link_config *config, rotor_link_state *state, int16_t counts,
                         int8_t temperature_degc, double crank_angle_deg, int lost)
{
    burst_step(config, state, crank_angle_deg);
    const double rate = state->in_burst ? config->burst_bit_error_rate : config->bit_error_rate;
    state->exchanges++;
    state->arrived = 1;
    state->word = state->in_flight;
    state->present = state->in_flight_present;
    if (state->present) {
        const uint32_t flipped =
            rate > 0.0 || state->error_rate > 0.0 ? errors_draw(state, rate) : 0;
        state->word ^= flipped;
        state->words_damaged += flipped != 0;
    } else {
        state->words_silent++;
    }
    state->in_flight_present = powered(config, state, lost);
    state->in_flight = rotor_link_word(counts, temperature_degc, state->sequence);
    state->sequence = (uint8_t)((state->sequence + 1u) & 15u);
}
