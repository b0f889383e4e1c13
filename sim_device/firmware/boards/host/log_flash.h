/* A serial flash in memory: an erase takes 40 ms of its board's time, a page 1 ms, and it can lose
 * power after any byte. */
#ifndef SPINDLE_LOG_FLASH_H
#define SPINDLE_LOG_FLASH_H

#include <stddef.h>
#include <stdint.h>

#include "hal.h" // hal

typedef struct {
    uint8_t *bytes;
    size_t block_size;
    size_t size;
    const uint64_t *clock_us;
    uint64_t busy_until_us;
    uint32_t changes;    /* operations since it was opened */
    size_t changed_from; /* what changed since `log_flash_changed`: from here up to, not with, */
    size_t changed_to;   /* there */
    uint32_t steps;      /* bytes erased or programmed since power on */
    uint32_t steps_left;
    size_t worn_address; /* of a block that is never erased again; SIZE_MAX: none */
} log_flash;

/* `image` of `size` bytes, or NULL for an erased one. 0, or negative without memory. */
int log_flash_open(log_flash *flash, size_t block_size, size_t size, const uint8_t *image);
void log_flash_close(log_flash *flash);

/* Fills in the part of `board` that is about logs. */
void log_flash_connect(log_flash *flash, hal *board, const uint64_t *clock_us);

void log_flash_power_on(log_flash *flash);

/* Where all lies that changed since the last call, as an address and a length. */
size_t log_flash_changed(log_flash *flash, size_t *address);

#endif
