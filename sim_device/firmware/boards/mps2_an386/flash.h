/* The board's flash memories, kept in the AN386's PSRAM with the manners of flash: erasing sets a
 * block to 0xFF, programming only clears bits. QEMU can keep that memory in a file, and so from one
 * run to the next. */
#ifndef SPINDLE_MPS2_FLASH_H
#define SPINDLE_MPS2_FLASH_H

#include <stdint.h>

#include "hal.h" // hal

/* What the factory and earlier boots left; a test bench may write it before power on. */
typedef struct {
    uint32_t magic; /* FLASH_MAGIC; anything else is a memory that was never erased */
    uint32_t boots;
    uint8_t uid[12];
    uint8_t unlock_key_present;
    uint8_t market_number;
    uint8_t market_present; /* 0: nobody said for which market, and none is assumed */
    uint8_t reserved;
    uint8_t unlock_key[32];
    uint32_t serial_baud; /* the line's first rate, others to follow; 0: one that is never told */
} flash_identity;

#define FLASH_MAGIC 0x31364250u

/* Erases a memory that never was, counts the boot, and fills in the part of `board` that is about
 * flash and identity. */
const flash_identity *flash_connect(hal *board);

#endif
