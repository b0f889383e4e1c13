/* The receiver of the wireless torque sensor: five words of 2 ms make one reading of 10 ms.
 *
 * The board calls rotor_receiver_exchange at every enable (500 a second) with the 32 bits that
 * came, or with none. A word that fails its check or its turn is left out; the median of the rest
 * hides what slipped through. The law corrects for temperature (sensor.c): what is calibrated and
 * recorded is the reading as it came. Nothing is counted twice and nothing stops: counters wrap at
 * 2^32. */
#ifndef SPINDLE_ROTOR_RECEIVER_H
#define SPINDLE_ROTOR_RECEIVER_H

#include <stdint.h>

#define ROTOR_EXCHANGE_MS 2
#define ROTOR_WORDS_PER_READING 5
#define ROTOR_AGE_MS_MAX 60000

typedef struct {
    int16_t counts[ROTOR_WORDS_PER_READING]; /* of the reading under way */
    uint8_t good;                            /* words in it */
    uint8_t exchanges;                       /* of the reading under way */
    uint8_t sequence;                        /* due with the next word */
    uint8_t following;                       /* 0 until a word told the sequence */
    uint8_t rival;                           /* due after the last word that was out of turn */
    uint8_t rival_known;
    uint16_t age_ms;         /* of the reading given out */
    int8_t temperature_degc; /* of the last good word */
    float torque_raw_counts; /* the reading given out, as it came */
    uint32_t words_good;
    uint32_t words_bad;  /* came damaged: check or sequence wrong */
    uint32_t words_lost; /* did not come */
} rotor_receiver;

/* A receiver that has heard nothing yet: no torque, `temperature_degc` until told otherwise. */
void rotor_receiver_init(rotor_receiver *receiver, int8_t temperature_degc);

/* One enable. `present` 0: the carrier was silent and `word` says nothing. */
void rotor_receiver_exchange(rotor_receiver *receiver, int present, uint32_t word);

/* 1 if the check of these 32 bits is right. */
int rotor_word_is_sound(uint32_t word);

#endif
