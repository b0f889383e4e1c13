/* Two copies of the configuration in flash, so that one of them is whole at every moment.
 *
 * Slot: magic u32, crc32 u32 (over everything from the layout to the erase count, and the image),
 * layout u32, generation u32, image length u16, 0xFFFF, erases u32, then three state words that are
 * written once each (provisional, confirmed, void), then the image. A slot counts once it is
 * confirmed; one that is only provisional is on trial and counts until the next reset; void takes
 * either back. */
#ifndef SPINDLE_CONFIG_STORE_H
#define SPINDLE_CONFIG_STORE_H

#include <stddef.h>
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
    uint8_t on_trial;                /* not confirmed: a reset returns to the other slot */
    uint32_t returned_generation;    /* what `config_store_boot` found on trial and took back */
} config_store;

typedef struct {
    uint8_t state; /* ebl_slot_state */
    uint32_t generation;
    uint32_t erases;
} config_slot;

/* Picks the highest generation that is whole, confirmed, of this layout and within its ranges;
 * else the factory default. A slot on trial is made void. */
void config_store_boot(config_store *store, const hal *board);

/* Writes the image to the slot that is not active, reads it back, and only then makes it active: on
 * trial, or for good. On failure the active image is what it was, in RAM and in flash. */
int config_store_write(config_store *store, const hal *board, const uint8_t *image, int on_trial);

/* Makes what is on trial count for good. On failure it stays on trial. */
int config_store_confirm(config_store *store, const hal *board);

/* Takes what is on trial back: the other slot is active again, in RAM even if the flash fails. */
void config_store_return(config_store *store, const hal *board);

/* The factory's last step: writes the image as generation 1 if the flash was never written.
 * A flash that holds anything, even damage, is left as it is. */
int config_store_provision(const hal *board, const uint8_t *image);

/* The image before the active one. False where there is none; `image` then is nothing. */
int config_store_previous(const config_store *store, const hal *board, uint8_t *image,
                          uint32_t *generation);

/* What a slot holds, for people who ask about wear. */
void config_store_slot(const hal *board, uint8_t slot_index, config_slot *seen);

/* Bytes of flash that the slots take, from its start: others begin here. */
size_t config_store_flash_bytes(const hal *board);

#endif
