/* One block of a ride log: 512 bytes of flash that stand alone (SPEC chapter 11). */
#ifndef SPINDLE_RIDE_LOG_BLOCK_H
#define SPINDLE_RIDE_LOG_BLOCK_H

#include <stdint.h>

#define RIDE_LOG_PAGE_BYTES 512
#define RIDE_LOG_AT_PAYLOAD 32
#define RIDE_LOG_AT_STATE 508      /* the unit's own word: not part of the block */
#define RIDE_LOG_PAYLOAD_BYTES 472 /* at most: header, check value and state word are beside it */

enum {
    RIDE_LOG_CONFIG = 1,
    RIDE_LOG_SCHEMA = 2,
    RIDE_LOG_DATA = 3,
    RIDE_LOG_EVENT = 4,
    RIDE_LOG_SYNC = 5,
    RIDE_LOG_END = 6,
    RIDE_LOG_CONFIG_REST = 7
};

typedef struct {
    uint8_t type; /* RIDE_LOG_ */
    uint16_t length;
    uint32_t log_id;
    uint32_t boot_id;
    uint32_t seq;
    uint64_t t0_us;
    uint16_t n;
    uint16_t schema_id;
} ride_log_header;

/* Writes the header before the payload that is there already, the check value and 0xFF behind it.
 * Returns the check value. */
uint32_t ride_log_block_seal(uint8_t *page, const ride_log_header *header);

/* True if the first 32 bytes are those of a block; the check value is not looked at. */
int ride_log_header_get(ride_log_header *header, const uint8_t *page);

/* True with the header of a whole block, and its check value. */
int ride_log_block_get(ride_log_header *header, uint32_t *crc32, const uint8_t *page);

#endif
