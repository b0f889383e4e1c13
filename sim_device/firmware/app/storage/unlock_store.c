#include "unlock_store.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_get_u32, ebl_put_u32
#include "ebl_frame.h"    // ebl_crc32
#include "flash_verify.h" // flash_program_verified, flash_is_blank

#define KEY_MAGIC 0x4B4C4245u /* "EBLK" */

enum {
    KEY_AT = 4,
    KEY_CRC_AT = KEY_AT + UNLOCK_KEY_LENGTH,
    KEY_RECORD_LENGTH = KEY_CRC_AT + 4,
    FAILURES_AT = 4,
    RECORD_CRC_AT = 8,
    RECORD_LENGTH = 12
};

static int has_room(const hal *board, size_t reserved)
{
    return board->flash_block_size >= KEY_RECORD_LENGTH &&
           board->flash_size >= reserved + UNLOCK_STORE_BLOCKS * board->flash_block_size;
}

static size_t block_address(const hal *board, unsigned block)
{
    return board->flash_size - (UNLOCK_STORE_BLOCKS - block) * board->flash_block_size;
}

static size_t key_address(const hal *board) { return board->flash_size - board->flash_block_size; }

static int is_erased(const uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (bytes[i] != 0xFF) return 0;
    }
    return 1;
}

static int key_read(const hal *board, uint8_t *key)
{
    uint8_t record[KEY_RECORD_LENGTH];

    if (board->flash_read(board->context, key_address(board), record, sizeof record) < 0) return 0;
    if (ebl_get_u32(record) != KEY_MAGIC) return 0;
    if (ebl_get_u32(record + KEY_CRC_AT) != ebl_crc32(0, record, KEY_CRC_AT)) return 0;
    memcpy(key, record + KEY_AT, UNLOCK_KEY_LENGTH);
    return 1;
}

/* Takes a block's newest record if it is newer than what the store has. False where the flash
 * cannot be read. */
static int block_scan(unlock_store *store, const hal *board, uint8_t block)
{
    size_t places = board->flash_block_size / RECORD_LENGTH;
    uint16_t next = 0;
    int newer = 0;

    for (size_t place = 0; place < places; place++) {
        uint8_t record[RECORD_LENGTH];
        size_t address = block_address(board, block) + place * RECORD_LENGTH;

        if (board->flash_read(board->context, address, record, sizeof record) < 0) return 0;
        if (is_erased(record, sizeof record)) continue;
        next = (uint16_t)(place + 1);
        if (ebl_get_u32(record + RECORD_CRC_AT) != ebl_crc32(0, record, RECORD_CRC_AT)) continue;
        if (ebl_get_u32(record) <= store->sequence) continue;
        store->sequence = ebl_get_u32(record);
        store->failures = ebl_get_u32(record + FAILURES_AT);
        newer = 1;
    }
    if (newer || block == store->block) {
        store->block = block;
        store->next = next;
    }
    return 1;
}

void unlock_store_boot(unlock_store *store, const hal *board, size_t reserved)
{
    memset(store, 0, sizeof *store);
    if (!has_room(board, reserved) || !key_read(board, store->key)) return;
    store->has_key = (uint8_t)(block_scan(store, board, 0) && block_scan(store, board, 1));
}

/* Makes room for one record; a full block gives way to the other one, erased. */
static int place_take(unlock_store *store, const hal *board, size_t *address)
{
    if (((size_t)store->next + 1) * RECORD_LENGTH > board->flash_block_size) {
        uint8_t other = (uint8_t)(1 - store->block);

        if (board->flash_erase(board->context, block_address(board, other)) < 0) return -1;
        store->block = other;
        store->next = 0;
    }
    *address = block_address(board, store->block) + (size_t)store->next * RECORD_LENGTH;
    store->next++;
    return 0;
}

int unlock_store_failures_write(unlock_store *store, const hal *board, uint32_t failures)
{
    uint8_t record[RECORD_LENGTH];
    size_t address;

    ebl_put_u32(record, store->sequence + 1);
    ebl_put_u32(record + FAILURES_AT, failures);
    ebl_put_u32(record + RECORD_CRC_AT, ebl_crc32(0, record, RECORD_CRC_AT));
    if (place_take(store, board, &address) < 0) return -1;
    if (flash_program_verified(board, address, record, sizeof record) < 0) return -1;
    store->sequence++;
    store->failures = failures;
    return 0;
}

int unlock_store_provision(const hal *board, size_t reserved, const uint8_t *key)
{
    uint8_t record[KEY_RECORD_LENGTH];

    if (!has_room(board, reserved)) return -1;
    if (!flash_is_blank(board, key_address(board), sizeof record)) {
        uint8_t kept[UNLOCK_KEY_LENGTH];

        return key_read(board, kept) && memcmp(kept, key, sizeof kept) == 0 ? 0 : -1;
    }
    ebl_put_u32(record, KEY_MAGIC);
    memcpy(record + KEY_AT, key, UNLOCK_KEY_LENGTH);
    ebl_put_u32(record + KEY_CRC_AT, ebl_crc32(0, record, KEY_CRC_AT));
    return flash_program_verified(board, key_address(board), record, sizeof record);
}
