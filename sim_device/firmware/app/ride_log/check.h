/* The check value over a part of a ride log, a few pages a poll. */
#ifndef SPINDLE_RIDE_LOG_CHECK_H
#define SPINDLE_RIDE_LOG_CHECK_H

#include <stdint.h>

#include "hal.h"   // hal
#include "store.h" // ride_log_store

typedef struct {
    uint8_t tid; /* of the request that waits for it; 0: nothing to do */
    uint8_t place;
    uint16_t message_id;
    uint32_t log_id;
    uint32_t offset;
    uint32_t end;
    uint32_t crc32;
    uint32_t expected; /* what the host has */
} ride_log_check;

enum { RIDE_LOG_CHECK_RUNNING = 0, RIDE_LOG_CHECK_DONE = 1, RIDE_LOG_CHECK_GONE = 2 };

/* Goes on for a moment. */
int ride_log_check_poll(ride_log_check *check, const ride_log_store *store, const hal *board);

#endif
