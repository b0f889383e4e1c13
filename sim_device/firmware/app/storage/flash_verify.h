/* Flash that is believed only after it was read back. */
#ifndef SPINDLE_FLASH_VERIFY_H
#define SPINDLE_FLASH_VERIFY_H

#include <stddef.h>
#include <stdint.h>

#include "hal.h" // hal

/* What becomes of writing. */
enum {
    STORAGE_OK = 0,
    STORAGE_NO_SPACE = -1,   /* the flash is too small */
    STORAGE_FLASH_FAIL = -2, /* erase or program refused */
    STORAGE_VERIFY_FAIL = -3 /* what was read back differs */
};

/* STORAGE_OK, STORAGE_FLASH_FAIL or STORAGE_VERIFY_FAIL. */
int flash_program_verified(const hal *board, size_t address, const uint8_t *bytes, size_t length);

/* Goes on with a check value over so many bytes of flash. Negative where it cannot be read. */
int flash_crc32(const hal *board, size_t address, size_t length, uint32_t *crc);

/* True if every byte reads as erased. */
int flash_is_blank(const hal *board, size_t address, size_t length);

#endif
