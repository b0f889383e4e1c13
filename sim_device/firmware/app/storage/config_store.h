/* Two copies of the configuration in flash, so that one of them is whole at every moment, each in
 * four records (config_slot.h): market, factory, calibration, tunable.
 *
 * What of the newest copy is damaged and has no twin is lost: its parameters show their defaults,
 * and the unit holds itself back until somebody who may writes the configuration anew. */
#ifndef SPINDLE_CONFIG_STORE_H
#define SPINDLE_CONFIG_STORE_H

#include <stddef.h>
#include <stdint.h>

#include "config_items.h" // config_tally
#include "config_slot.h"  // config_slot
#include "ebl_registry.h" // EBL_IMAGE_LENGTH
#include "hal.h"          // hal

#define CONFIG_STORE_NO_SLOT 255 /* the defaults, which live in code */

/* Lost, only the maker can say what they were. */
#define CONFIG_STORE_MAKERS_RECORDS ((1u << EBL_RECORD_MARKET) | (1u << EBL_RECORD_FACTORY))

typedef struct {
    uint8_t image[EBL_IMAGE_LENGTH]; /* the active one */
    uint32_t crc32;                  /* of the image */
    uint32_t generation;             /* 0: never configured */
    uint8_t slot;                    /* where it lies, or CONFIG_STORE_NO_SLOT */
    uint8_t on_trial;                /* not confirmed: a reset returns to the other slot */
    uint8_t lost;                    /* records that are, or may be, not what was written: a bit
                                        for each ebl_record */
    uint8_t is_provisioned;          /* 0: the factory has not been there; all is lost then */
    config_tally tally;              /* what the boot made of another firmware's image */
    uint32_t worn_until_s;           /* config/wear.h */
    uint32_t returned_generation;    /* what `config_store_boot` found on trial and took back */
} config_store;

/* Picks the confirmed slot of the highest generation and reads it by the ids of its parameters. A
 * slot on trial is made void. */
void config_store_boot(config_store *store, const hal *board);

/* Writes the image to the slot that is not active, reads it back, and only then makes it active: on
 * trial, or for good. On failure the active image is what it was, in RAM and in flash. */
int config_store_write(config_store *store, const hal *board, const uint8_t *image, int on_trial);

/* Makes what is on trial count for good. On failure it stays on trial; should the supply fail
 * before the trial is over, it may count all the same. */
int config_store_confirm(config_store *store, const hal *board);

/* Takes what is on trial back: the other slot is active again, in RAM even if the flash fails. */
void config_store_return(config_store *store, const hal *board);

/* The factory's last step: writes the image as generation 1 unless a configuration was there
 * before, however damaged: then the flash is left as it is. */
int config_store_provision(const hal *board, const uint8_t *image);

/* The image before the active one. False where there is none; `image` then is nothing. */
int config_store_previous(const config_store *store, const hal *board, uint8_t *image,
                          uint32_t *generation);

/* Bytes of flash that the slots take, from its start: others begin here. */
size_t config_store_flash_bytes(const hal *board);

#endif
