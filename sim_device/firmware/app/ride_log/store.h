/* Which ride logs lie where in flash: a directory in RAM, rebuilt from the blocks at every boot.
 *
 * The flash is a ring of erase blocks. A log takes the next free one whenever it needs another, so
 * its blocks follow each other around the ring with those of older logs in between. */
#ifndef SPINDLE_RIDE_LOG_STORE_H
#define SPINDLE_RIDE_LOG_STORE_H

#include <stddef.h>
#include <stdint.h>

#include "hal.h"   // hal
#include "block.h" // RIDE_LOG_PAGE_BYTES

#define RIDE_LOG_LOGS_MAX 24
#define RIDE_LOG_BLOCKS_MAX 1024
#define RIDE_LOG_NONE 255
#define RIDE_LOG_NO_BLOCK 65535
#define RIDE_LOG_REFUSED 254 /* owner of a block that the flash would not erase */

typedef struct {
    uint32_t id;         /* 0: no log */
    uint32_t generation; /* check value of its first block */
    uint32_t boot_id;
    uint32_t pages;
    uint64_t t0_us;
    uint64_t t1_us;
    uint16_t first_block;
    uint8_t flags;   /* EBL_LOG_ bits */
    uint8_t refused; /* its first block could not be erased: it stays */
} ride_log_entry;

typedef struct {
    ride_log_entry logs[RIDE_LOG_LOGS_MAX];
    uint8_t owner[RIDE_LOG_BLOCKS_MAX]; /* place in `logs`, NONE or REFUSED */
    uint16_t blocks;
    uint16_t pages_per_block;
    uint16_t head; /* where the search for a free block begins */
    uint32_t next_id;
    uint32_t overwritten; /* unconfirmed logs given up since boot */
    uint8_t erases;       /* of blocks, until the unit's counters have them */
} ride_log_store;

/* Reads the flash. row_period_us: how long a row of a DATA block lasts. page: room to read one. */
void ride_log_store_boot(ride_log_store *store, const hal *board, uint32_t row_period_us,
                         uint8_t *page);

/* Place of a log, or RIDE_LOG_NONE. A generation of another log of the same id is not found. */
uint8_t ride_log_store_find(const ride_log_store *store, uint32_t id, uint32_t generation);

/* Place of the log that is `number`-th from the oldest, or RIDE_LOG_NONE. */
uint8_t ride_log_store_by_age(const ride_log_store *store, uint16_t number);
uint16_t ride_log_store_count(const ride_log_store *store);

uint8_t ride_log_store_free_place(const ride_log_store *store);

/* The next free block from the head on, before it comes round to `limit` (RIDE_LOG_NO_BLOCK: the
 * whole ring); RIDE_LOG_NO_BLOCK where there is none. */
uint16_t ride_log_store_free_block(const ride_log_store *store, uint16_t limit);

/* True if the block comes before `limit` when going round from the head. */
int ride_log_store_is_before(const ride_log_store *store, uint16_t block, uint16_t limit);

/* The log to be given up next: the oldest confirmed one, else the oldest; never one that is being
 * recorded, nor one whose first block the flash would not erase. RIDE_LOG_NONE where there is
 * none. */
uint8_t ride_log_store_victim(const ride_log_store *store);

/* Begins to erase a block, and counts it. Negative where the flash refuses; the block, or the log
 * that begins in it, is then passed over until `forgive`. */
int ride_log_store_erase(ride_log_store *store, const hal *board, uint16_t block);

/* Everything that was refused may be tried again. */
void ride_log_store_forgive(ride_log_store *store);

/* Forgets a log whose first block has been erased. */
void ride_log_store_release(ride_log_store *store, uint8_t place);

/* Bytes of a log as the host sees them: 0xFF where a block is lost. 0, or negative if the flash
 * cannot be read now. The range must not leave its page. */
int ride_log_store_read(const ride_log_store *store, const hal *board, uint8_t place,
                        uint32_t offset, uint8_t *bytes, size_t length);

/* Programs the word that says a host has the log. 0, or negative. */
int ride_log_store_confirm(ride_log_store *store, const hal *board, uint8_t place);

uint32_t ride_log_store_length(const ride_log_store *store, uint8_t place);
size_t ride_log_store_address(const ride_log_store *store, const hal *board, uint16_t block,
                              uint32_t page);

#endif
