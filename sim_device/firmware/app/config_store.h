/* Two copies of the configuration in flash, so that one of them is whole at every moment.
 *
 * Slot: magic u32, crc32 u32 (over everything from the schema hash to the end of the image),
 * schema hash, generation u32, image length u16, 0xFFFF, confirmed u32, void u32, image. The state
 * words are written once each: confirmed makes the slot count, void takes that back. */
#ifndef SPINDLE_CONFIG_STORE_H
#define SPINDLE_CONFIG_STORE_H

#include <stdint.h>

#include "ebl_registry.h" // EBL_IMAGE_LENGTH
#include "hal.h"          // hal

#define CONFIG_STORE_SLOTS 2
#define CONFIG_STORE_NO_SLOT 255 /* the factory default, which lives in code */

enum {
    CONFIG_STORE_OK = 0,
    CONFIG_STORE_NO_SPACE = -1,   /* the flash is too small for two slots */
    CONFIG_STORE_FLASH_FAIL = -2, /* erase or program refused */
    CONFIG_STORE_VERIFY_FAIL = -3 /* what was read back differs */
};

typedef struct {
    uint8_t image[EBL_IMAGE_LENGTH]; /* the active one */
    uint32_t crc32;                  /* of the image */
    uint32_t generation;             /* 0: never configured */
    uint8_t slot;                    /* where it lies, or CONFIG_STORE_NO_SLOT */
} config_store;

/* Picks the highest generation that is whole, confirmed, of this schema and within its ranges;
 * else the factory default. */
void config_store_boot(config_store *store, const hal *board);

/* Writes the image to the slot that is not active, reads it back, and only then makes it count
 * and active. On failure the active image is what it was, in RAM and in flash. */
int config_store_write(config_store *store, const hal *board, const uint8_t *image);

/* The factory's last step: writes the image as generation 1 if the flash was never written.
 * A flash that holds anything, even damage, is left as it is. */
int config_store_provision(const hal *board, const uint8_t *image);

/* The image before the active one. False where there is none. */
int config_store_previous(const config_store *store, const hal *board, uint8_t *image,
                          uint32_t *generation);

#endif
