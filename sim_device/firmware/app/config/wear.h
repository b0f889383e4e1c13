/* How often the configuration may be written, so that its flash outlives the bike.
 *
 * A block stands 10,000 erases and there are two, so 20,000 writes in ten years. 1,000 are free at
 * first, for a workshop's day or a test bench's week; each comes back after 16,800 s (4 h 40 min)
 * of operating time: 1,000 + 315,576,000 s / 16,800 s = 19,784 in ten years without a pause. Kept
 * is until when what was written would have taken at that pace, in each slot's header, so that a
 * restart gives nothing back. */
#ifndef SPINDLE_CONFIG_WEAR_H
#define SPINDLE_CONFIG_WEAR_H

#include <stdint.h>

#define CONFIG_WEAR_FREE_WRITES 1000u
#define CONFIG_WEAR_WRITE_S 16800u

/* Seconds of operating time until the next write; 0: now. */
uint32_t config_wear_wait_s(uint32_t worn_until_s, uint32_t operating_s);

/* How many may be written now, one after the other. */
uint16_t config_wear_writes_free(uint32_t worn_until_s, uint32_t operating_s);

/* `worn_until_s` after one more write. */
uint32_t config_wear_spend(uint32_t worn_until_s, uint32_t operating_s);

#endif
