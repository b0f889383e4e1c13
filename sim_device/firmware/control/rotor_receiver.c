#include "rotor_receiver.h"

#define SEQUENCE_MASK 15u

/* From the measurement in the spindle to the end of the exchange that brings it. */
#define DELAY_MS ROTOR_EXCHANGE_MS

/* CRC-4, x^4 + x + 1, start 15, four bits at a time: finds every single and double bit in a word of
 * this length but for pairs 15 apart, and 15 of 16 of whatever else happens. */
int rotor_word_is_sound(uint32_t word)
{
    static const uint8_t step[16] = {0, 3, 6, 5, 12, 15, 10, 9, 11, 8, 13, 14, 7, 4, 1, 2};
    uint32_t check = 15;
    int shift;

    for (shift = 28; shift >= 4; shift -= 4) check = step[check ^ (word >> shift & 15u)];
    return check == (word & 15u);
}

void rotor_receiver_init(rotor_receiver *receiver, int8_t temperature_degc)
{
    const rotor_receiver silent = {0};

    *receiver = silent;
    receiver->temperature_degc = temperature_degc;
}

static void take(rotor_receiver *receiver, uint32_t word)
{
    uint32_t unsigned_counts = word >> 16;
    int32_t counts = (int32_t)unsigned_counts - (unsigned_counts > 32767u ? 65536 : 0);
    int32_t degrees = (int32_t)(word >> 8 & 255u);
    uint8_t place = receiver->good;

    receiver->temperature_degc = (int8_t)(degrees > 127 ? degrees - 256 : degrees);
    while (place > 0 && receiver->counts[place - 1] > counts) {
        receiver->counts[place] = receiver->counts[place - 1];
        place--;
    }
    receiver->counts[place] = (int16_t)counts;
    receiver->good++;
    receiver->words_good++;
}

/* A word out of turn is damage that the check missed, or a rotor that started anew: it is not
 * believed, but one that follows it is. */
static void judge(rotor_receiver *receiver, uint32_t word)
{
    uint8_t sequence = (uint8_t)(word >> 4 & SEQUENCE_MASK);
    int in_turn = !receiver->following || sequence == receiver->sequence ||
                  (receiver->rival_known && sequence == receiver->rival);

    if (!rotor_word_is_sound(word)) {
        receiver->words_bad++;
    } else if (!in_turn) {
        receiver->words_bad++;
        receiver->rival = sequence;
        receiver->rival_known = 1;
    } else {
        receiver->sequence = sequence;
        receiver->following = 1;
        receiver->rival_known = 0;
        take(receiver, word);
    }
}

void rotor_receiver_exchange(rotor_receiver *receiver, int present, uint32_t word)
{
    if (present) {
        judge(receiver, word);
    } else {
        receiver->words_lost++;
    }
    receiver->sequence = (uint8_t)((receiver->sequence + 1u) & SEQUENCE_MASK);
    receiver->rival = (uint8_t)((receiver->rival + 1u) & SEQUENCE_MASK);
    if (receiver->age_ms < ROTOR_AGE_MS_MAX) {
        receiver->age_ms = (uint16_t)(receiver->age_ms + ROTOR_EXCHANGE_MS);
    }
    receiver->exchanges++;
    if (receiver->exchanges < ROTOR_WORDS_PER_READING) return;
    receiver->exchanges = 0;
    if (receiver->good > 0) {
        receiver->torque_raw_counts = (float)receiver->counts[receiver->good / 2];
        receiver->age_ms = DELAY_MS;
    }
    receiver->good = 0;
}
