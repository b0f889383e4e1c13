/* The wireless link from the spindle to the housing: 500 words of 32 bits a second (thesis 3.2).
 *
 * A word: bits 31 to 16 torque in counts, 15 to 8 temperature in degrees, 7 to 4 sequence, 3 to 0
 * check (thesis_checks I-21). Bits are hit at random, and in bursts once a turn where the coils run
 * out of true (Gilbert and Elliott's two states); below the coupling threshold the rotor has no
 * power. What left and what was hit is counted here as truth; the receiver counts what it
 * notices. */
#ifndef SPINDLE_ROTOR_LINK_H
#define SPINDLE_ROTOR_LINK_H

#include <stdint.h>

#define ROTOR_LINK_PERIOD_MS 2

typedef struct {
    double bit_error_rate;       /* between bursts */
    double burst_bit_error_rate; /* inside one */
    double burst_share;          /* of turns that bring a burst; 0: none */
    double burst_words;          /* mean length */
    double burst_angle_deg;      /* where on the turn */
    double coupling;             /* 1: coils in line */
    double coupling_min;         /* below it the rotor browns out */
    double restart_s;            /* until the rotor speaks again */
} rotor_link_config;

typedef struct {
    uint64_t random;
    double bits_to_error; /* until the next one, drawn for error_rate */
    double error_rate;
    double restart_left_s;
    double last_angle_deg;
    uint32_t in_flight; /* sent, arrives with the next exchange */
    int in_flight_present;
    uint32_t word; /* what the last exchange brought */
    int present;   /* 0: silence */
    int arrived;   /* 1 right after an exchange */
    int in_burst;
    uint8_t sequence;
    uint32_t exchanges;
    uint32_t words_damaged;
    uint32_t words_silent;
} rotor_link_state;

/* A link that has been running; without load so far. */
void rotor_link_reset(rotor_link_state *state, int8_t temperature_degc);
void rotor_link_seed(rotor_link_state *state, uint64_t seed);

/* One exchange of 2 ms: brings the word of the one before and sends the next. `lost` switches the
 * carrier off. */
void rotor_link_exchange(const rotor_link_config *config, rotor_link_state *state, int16_t counts,
                         int8_t temperature_degc, double crank_angle_deg, int lost);

/* The word as the rotor sends it. */
uint32_t rotor_link_word(int16_t counts, int8_t temperature_degc, uint8_t sequence);

#endif
