/* One of the two copies of the configuration in flash.
 *
 * Slot: magic u32 "EBL3", crc32 u32 (over what follows up to the state words, and the table of
 * records), generation u32, erases u32, worn_until_s u32, version u16, 0xFFFF; three state words
 * u32 that are written once each (provisional, confirmed, void); the table of the four records
 * (crc32 u32, length u16, version u16 each); a second copy of all but the state words; the records,
 * items of config_items.h one after the other. A slot counts once it is confirmed; one that is only
 * provisional is on trial and counts until the next reset; void takes either back.
 *
 * A state word counts as written when two of its bits are: a bit that flips changes nothing, and
 * one that was cut in half is what its writer meant. A bit that flips in one copy of the header
 * leaves the other; one in a record leaves the twin slot's, if that is the same. */
#ifndef SPINDLE_CONFIG_SLOT_H
#define SPINDLE_CONFIG_SLOT_H

#include <stddef.h>
#include <stdint.h>

#include "config_items.h" // config_tally
#include "ebl_registry.h" // EBL_RECORD_MARKET
#include "hal.h"          // hal

#define CONFIG_SLOTS 2
#define CONFIG_RECORDS 4
#define CONFIG_RECORDS_ALL 0x0Fu /* a bit for each ebl_record */

typedef struct {
    uint32_t crc32;
    uint16_t length;
    uint16_t version;
} config_record;

typedef struct {
    uint8_t state;   /* ebl_slot_state */
    uint8_t is_lost; /* it counted, and nothing of it can be read */
    uint32_t generation;
    uint32_t erases;
    uint32_t worn_until_s; /* config/wear.h */
    config_record records[CONFIG_RECORDS];
} config_slot;

/* Bytes from one slot to the next: whole blocks. 0 where the flash cannot hold two slots. */
size_t config_slot_stride(const hal *board);

/* What the slot says of itself. */
void config_slot_look(const hal *board, uint8_t slot_index, config_slot *slot);

/* Reads the values of these records (a bit each) over the image. What could not be read is
 * returned. `twin`: the other slot, which may have the same records. */
uint8_t config_slot_read(const hal *board, uint8_t slot_index, const config_slot *slot,
                         const config_slot *twin, uint8_t *image, config_tally *tally);

/* Erases the slot and writes image and header, then the word that makes it count: on trial where
 * `slot->state` says PROVISIONAL, else for good. `slot->records` is filled in. Returns a
 * STORAGE_ result; a slot that failed is void. */
int config_slot_write(const hal *board, uint8_t slot_index, config_slot *slot,
                      const uint8_t *image);

/* The words that are written later. Return a STORAGE_ result. */
int config_slot_confirm(const hal *board, uint8_t slot_index);
int config_slot_void(const hal *board, uint8_t slot_index);

#endif
