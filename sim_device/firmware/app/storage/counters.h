/* What the unit learns of itself while it is used: distance, operating time, wear.
 *
 * Kept in a log of its own behind the configuration's slots and outside its CRC: two areas of whole
 * blocks, records of 20 bytes one after the other (sequence, distance, operating time, erases of
 * the ride logs' blocks, CRC-32 of the four, u32 each). The newest whole record counts, so a power
 * cut costs what was counted since the one before. An area is erased when the other is full, and
 * only at a standstill. */
#ifndef SPINDLE_COUNTERS_H
#define SPINDLE_COUNTERS_H

#include <stddef.h>
#include <stdint.h>

#include "hal.h" // hal

#define COUNTERS_BLOCKS 2 /* of flash */

typedef struct {
    uint32_t distance_m;
    uint32_t operating_s;
    uint32_t log_erases;   /* blocks of the ride logs' flash */
    float distance_rest_m; /* below a metre */
    uint8_t steps;         /* of the second that has begun */
    float speed_kmh;       /* the latest */
    uint32_t saved_distance_m;
    uint32_t saved_operating_s;
    uint32_t sequence; /* of the newest record */
    size_t address;    /* of the first area; both end at the flash's end or earlier */
    size_t area_bytes; /* 0: no flash is left for counters */
    size_t next;       /* place of the next record, counted through both areas */
    uint64_t save_due_us;
} counters;

/* Reads the newest record. The log begins at `address`. */
void counters_boot(counters *state, const hal *board, size_t address);

/* One control step at this speed, and what the wheel rolled in it. */
void counters_step(counters *state, float speed_kmh, float way_m);

/* Saves once a minute while the wheel turns, and every ten minutes while it stands: ten years of
 * standing are 526,000 records, 5,200 erases of an area of 1 KB; a block stands 10,000. */
void counters_poll(counters *state, const hal *board, uint64_t now_us);

#endif
