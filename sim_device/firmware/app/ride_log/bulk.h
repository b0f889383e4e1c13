/* Sends one ride log in a window: what the host has not acknowledged is sent again, nothing else.
 *
 * Chunk k lies at byte k x chunk of the log; a chunk is told from another by its place alone. */
#ifndef SPINDLE_RIDE_LOG_BULK_H
#define SPINDLE_RIDE_LOG_BULK_H

#include <stddef.h>
#include <stdint.h>

#include "hal.h"   // hal
#include "store.h" // ride_log_store

#define RIDE_LOG_WINDOW_MAX 32

typedef struct {
    uint8_t session; /* 0: nothing is being sent */
    uint8_t place;
    uint8_t window;
    uint8_t timing;    /* a chunk is being timed */
    uint16_t chunk;    /* bytes */
    uint16_t seq;      /* of the next frame */
    uint32_t log_id;   /* of the log at `place`, in case it goes */
    uint32_t total;    /* chunks of the log */
    uint32_t base;     /* the oldest chunk that is not acknowledged */
    uint32_t next;     /* the next one that was never sent */
    uint32_t received; /* bit k: the host has chunk base + k */
    uint32_t resend;   /* bit k: chunk base + k is to be sent again */
    uint32_t timed;    /* the chunk whose round trip is being measured */
    uint64_t timed_us;
    uint64_t heard_us;
    uint32_t round_trip_us;
    uint32_t frames_sent;
    uint32_t frames_repeated;
    uint64_t sent_us[RIDE_LOG_WINDOW_MAX]; /* of chunk k at k % 32 */
} ride_log_bulk;

/* Largest chunk for frames of `mtu` bytes: a power of two up to a page. */
uint16_t ride_log_bulk_chunk(uint16_t mtu);

/* Begins to send log `place` from `offset`, which is a multiple of the chunk. */
void ride_log_bulk_open(ride_log_bulk *bulk, const ride_log_store *store, uint8_t place,
                        uint32_t offset, uint16_t chunk, uint8_t window, uint8_t session,
                        uint64_t now_us);

/* False where the acknowledgement makes no sense; then nothing changes. */
int ride_log_bulk_ack(ride_log_bulk *bulk, uint32_t base, uint64_t bitmap, uint64_t now_us);

void ride_log_bulk_end(ride_log_bulk *bulk);

/* Seconds, rounded up, until a session ends by itself if nothing is acknowledged; 0 without one. */
uint16_t ride_log_bulk_left_s(const ride_log_bulk *bulk, uint64_t now_us);

/* Ends a session nobody listens to, or whose log is gone. */
void ride_log_bulk_poll(ride_log_bulk *bulk, const ride_log_store *store, uint64_t now_us);

/* The next frame, header and payload; 0 where there is nothing to send now. */
size_t ride_log_bulk_frame(ride_log_bulk *bulk, const ride_log_store *store, const hal *board,
                           uint8_t *frame, size_t capacity);

#endif
