/* What the unit keeps of unlocking: the maker's public key, and the attempts that went wrong.
 *
 * The last block of the configuration's flash holds the key, written once by the factory. The two
 * before it take attempts in turn, as records that are only ever added: sequence u32, failures u32,
 * crc32. The newest whole record counts; a record the power cut short is passed over. */
#ifndef SPINDLE_UNLOCK_STORE_H
#define SPINDLE_UNLOCK_STORE_H

#include <stdint.h>

#include "hal.h" // hal

#define UNLOCK_STORE_BLOCKS 3
#define UNLOCK_KEY_LENGTH 32 /* of Ed25519 */

typedef struct {
    uint8_t key[UNLOCK_KEY_LENGTH];
    uint8_t has_key;
    uint8_t block;     /* that takes records now, 0 or 1 */
    uint16_t next;     /* place of the next record in it */
    uint32_t sequence; /* of the newest record, one more with each */
    uint32_t failures; /* attempts since the last that was right */
} unlock_store;

/* No key where the flash has no room beside `reserved` bytes of configuration. */
void unlock_store_boot(unlock_store *store, const hal *board, size_t reserved);

/* Writes the number down and reads it back; only then is it the store's. 0, or negative with the
 * store as it was. */
int unlock_store_failures_write(unlock_store *store, const hal *board, uint32_t failures);

/* The factory's step: the key, if there is none. Negative where it cannot be kept. */
int unlock_store_provision(const hal *board, size_t reserved, const uint8_t *key);

#endif
