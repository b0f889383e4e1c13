#include "config_slot.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_get_u32, ebl_put_u32
#include "ebl_frame.h"    // ebl_crc32
#include "flash_verify.h" // STORAGE_OK, flash_program_verified, flash_crc32

#define SLOT_MAGIC 0x334C4245u /* "EBL3" */
#define SLOT_VERSION 1
#define RECORD_VERSION 1

enum {
    AT_MAGIC = 0,
    AT_CRC = 4,
    AT_GENERATION = 8,
    AT_ERASES = 12,
    AT_WORN_UNTIL = 16,
    AT_VERSION = 20,
    HEADER_LENGTH = 24,
    AT_PROVISIONAL = 24,
    AT_CONFIRMED = 28,
    AT_VOID = 32,
    AT_TABLE = 36,
    ROW_LENGTH = 8,
    TABLE_LENGTH = CONFIG_RECORDS * ROW_LENGTH,
    SUMMARY_LENGTH = HEADER_LENGTH + TABLE_LENGTH, /* header and table, one behind the other */
    AT_COPY = AT_TABLE + TABLE_LENGTH,
    AT_RECORDS = AT_COPY + SUMMARY_LENGTH,
    SLOT_LENGTH = AT_RECORDS + EBL_IMAGE_LENGTH + EBL_PARAMETER_COUNT * CONFIG_ITEM_HEAD_LENGTH
};

#define WORD_ERASED 0xFFFFFFFFu
#define WORD_WRITTEN 0u
#define WORD_LENGTH 4

size_t config_slot_stride(const hal *board)
{
    size_t blocks;

    if (board->flash_block_size == 0) return 0;
    blocks = (SLOT_LENGTH + board->flash_block_size - 1) / board->flash_block_size;
    if (board->flash_size / board->flash_block_size < CONFIG_SLOTS * blocks) return 0;
    return blocks * board->flash_block_size;
}

static size_t slot_address(const hal *board, uint8_t slot_index)
{
    return slot_index * config_slot_stride(board);
}

static int word_is_written(uint32_t word)
{
    uint32_t cleared = ~word;

    return (cleared & (cleared - 1)) != 0; /* more than one bit */
}

static uint32_t summary_crc(const uint8_t *summary)
{
    return ebl_crc32(0, summary + AT_GENERATION, SUMMARY_LENGTH - AT_GENERATION);
}

static int summary_is_whole(const uint8_t *summary)
{
    return ebl_get_u32(summary + AT_MAGIC) == SLOT_MAGIC &&
           ebl_get_u32(summary + AT_CRC) == summary_crc(summary) &&
           ebl_get_u16(summary + AT_VERSION) == SLOT_VERSION;
}

static void summary_take(const uint8_t *summary, config_slot *slot)
{
    slot->generation = ebl_get_u32(summary + AT_GENERATION);
    slot->erases = ebl_get_u32(summary + AT_ERASES);
    slot->worn_until_s = ebl_get_u32(summary + AT_WORN_UNTIL);
    for (size_t i = 0; i < CONFIG_RECORDS; i++) {
        const uint8_t *row = summary + HEADER_LENGTH + i * ROW_LENGTH;

        slot->records[i].crc32 = ebl_get_u32(row);
        slot->records[i].length = ebl_get_u16(row + 4);
        slot->records[i].version = ebl_get_u16(row + 6);
    }
}

/* The header's fields, from whichever copy is whole. */
static int summary_find(const hal *board, size_t address, const uint8_t *head, config_slot *slot)
{
    uint8_t summary[SUMMARY_LENGTH];

    memcpy(summary, head, HEADER_LENGTH);
    memcpy(summary + HEADER_LENGTH, head + AT_TABLE, TABLE_LENGTH);
    if (!summary_is_whole(summary)) {
        if (board->flash_read(board->context, address + AT_COPY, summary, sizeof summary) < 0) {
            return 0;
        }
        if (!summary_is_whole(summary)) return 0;
    }
    summary_take(summary, slot);
    return 1;
}

static uint8_t slot_state(const uint8_t *head)
{
    if (word_is_written(ebl_get_u32(head + AT_VOID))) return EBL_SLOT_STATE_VOID;
    if (word_is_written(ebl_get_u32(head + AT_CONFIRMED))) return EBL_SLOT_STATE_CONFIRMED;
    if (word_is_written(ebl_get_u32(head + AT_PROVISIONAL))) return EBL_SLOT_STATE_PROVISIONAL;
    return EBL_SLOT_STATE_DAMAGED; /* whole, but its writer did not get to say so */
}

void config_slot_look(const hal *board, uint8_t slot_index, config_slot *slot)
{
    size_t address = slot_address(board, slot_index);
    uint8_t head[AT_COPY];

    memset(slot, 0, sizeof *slot);
    slot->state = EBL_SLOT_STATE_EMPTY;
    if (config_slot_stride(board) == 0) return;
    slot->state = EBL_SLOT_STATE_DAMAGED;
    slot->is_lost = 1;
    if (board->flash_read(board->context, address, head, sizeof head) < 0) return;
    slot->is_lost = 0;
    if (ebl_get_u32(head + AT_MAGIC) == WORD_ERASED) {
        slot->state = EBL_SLOT_STATE_EMPTY;
        return;
    }
    if (summary_find(board, address, head, slot)) {
        slot->state = slot_state(head);
    } else {
        slot->is_lost = slot_state(head) == EBL_SLOT_STATE_CONFIRMED;
    }
}

static size_t record_address(const hal *board, uint8_t slot_index, const config_slot *slot,
                             size_t record)
{
    size_t address = slot_address(board, slot_index) + AT_RECORDS;

    for (size_t i = 0; i < record; i++) address += slot->records[i].length;
    return address;
}

/* Where a whole record of this content lies in the slot; 0 where it does not: no record does. */
static size_t record_find(const hal *board, uint8_t slot_index, const config_slot *slot,
                          size_t record, const config_record *wanted)
{
    const config_record *own = &slot->records[record];
    size_t address = record_address(board, slot_index, slot, record);
    uint32_t crc = 0;

    if (slot->state == EBL_SLOT_STATE_EMPTY || slot->is_lost) return 0;
    if (own->crc32 != wanted->crc32 || own->length != wanted->length) return 0;
    if (wanted->version != RECORD_VERSION) return 0;
    if (address + wanted->length > slot_address(board, slot_index) + config_slot_stride(board)) {
        return 0;
    }
    if (flash_crc32(board, address, wanted->length, &crc) < 0 || crc != wanted->crc32) return 0;
    return address;
}

uint8_t config_slot_read(const hal *board, uint8_t slot_index, const config_slot *slot,
                         const config_slot *twin, uint8_t *image, config_tally *tally)
{
    uint8_t twin_index = slot_index == 0 ? 1 : 0;
    uint8_t lost = 0;

    for (size_t i = 0; i < CONFIG_RECORDS; i++) {
        const config_record *wanted = &slot->records[i];
        size_t address = record_find(board, slot_index, slot, i, wanted);

        if (address == 0) address = record_find(board, twin_index, twin, i, wanted);
        if (address == 0 || config_items_read(board, address, wanted->length, image, tally) < 0) {
            lost |= (uint8_t)(1u << i);
        }
    }
    return lost;
}

static int slot_erase(const hal *board, uint8_t slot_index)
{
    size_t stride = config_slot_stride(board);

    for (size_t at = 0; at < stride; at += board->flash_block_size) {
        if (board->flash_erase(board->context, slot_index * stride + at) < 0) {
            return STORAGE_FLASH_FAIL;
        }
    }
    return STORAGE_OK;
}

static int word_write(const hal *board, uint8_t slot_index, size_t at)
{
    uint8_t word[WORD_LENGTH];

    ebl_put_u32(word, WORD_WRITTEN);
    return flash_program_verified(board, slot_address(board, slot_index) + at, word, sizeof word);
}

int config_slot_confirm(const hal *board, uint8_t slot_index)
{
    return word_write(board, slot_index, AT_CONFIRMED);
}

int config_slot_void(const hal *board, uint8_t slot_index)
{
    return word_write(board, slot_index, AT_VOID);
}

/* Writes the items of one record and notes what they are. */
static int record_write(const hal *board, size_t address, uint8_t record, const uint8_t *image,
                        config_record *written)
{
    int result = STORAGE_OK;

    written->crc32 = 0;
    written->length = 0;
    written->version = RECORD_VERSION;
    for (size_t i = 0; i < EBL_PARAMETER_COUNT && result == STORAGE_OK; i++) {
        const ebl_parameter *row = &ebl_parameters[i];
        const uint8_t *values = image + row->image_offset;
        size_t values_length = (size_t)row->count * row->length;
        uint8_t head[CONFIG_ITEM_HEAD_LENGTH];

        if (row->record != record) continue;
        ebl_put_u16(head, row->id);
        head[2] = row->count;
        head[3] = row->length;
        written->crc32 = ebl_crc32(written->crc32, head, sizeof head);
        written->crc32 = ebl_crc32(written->crc32, values, values_length);
        result = flash_program_verified(board, address + written->length, head, sizeof head);
        if (result != STORAGE_OK) break;
        written->length = (uint16_t)(written->length + sizeof head);
        result = flash_program_verified(board, address + written->length, values, values_length);
        written->length = (uint16_t)(written->length + values_length);
    }
    return result;
}

static void summary_put(uint8_t *summary, const config_slot *slot)
{
    memset(summary, 0xFF, SUMMARY_LENGTH);
    ebl_put_u32(summary + AT_MAGIC, SLOT_MAGIC);
    ebl_put_u32(summary + AT_GENERATION, slot->generation);
    ebl_put_u32(summary + AT_ERASES, slot->erases);
    ebl_put_u32(summary + AT_WORN_UNTIL, slot->worn_until_s);
    ebl_put_u16(summary + AT_VERSION, SLOT_VERSION);
    for (size_t i = 0; i < CONFIG_RECORDS; i++) {
        uint8_t *row = summary + HEADER_LENGTH + i * ROW_LENGTH;

        ebl_put_u32(row, slot->records[i].crc32);
        ebl_put_u16(row + 4, slot->records[i].length);
        ebl_put_u16(row + 6, slot->records[i].version);
    }
    ebl_put_u32(summary + AT_CRC, summary_crc(summary));
}

/* The copy first: a slot whose magic is there is whole but for the word that makes it count. */
static int summary_write(const hal *board, uint8_t slot_index, const config_slot *slot)
{
    size_t address = slot_address(board, slot_index);
    uint8_t summary[SUMMARY_LENGTH];
    int result;

    summary_put(summary, slot);
    result = flash_program_verified(board, address + AT_COPY, summary, SUMMARY_LENGTH);
    if (result != STORAGE_OK) return result;
    result =
        flash_program_verified(board, address + AT_TABLE, summary + HEADER_LENGTH, TABLE_LENGTH);
    if (result != STORAGE_OK) return result;
    return flash_program_verified(board, address, summary, HEADER_LENGTH);
}

int config_slot_write(const hal *board, uint8_t slot_index, config_slot *slot, const uint8_t *image)
{
    size_t word = slot->state == EBL_SLOT_STATE_PROVISIONAL ? AT_PROVISIONAL : AT_CONFIRMED;
    int result = slot_erase(board, slot_index);

    for (uint8_t i = 0; i < CONFIG_RECORDS && result == STORAGE_OK; i++) {
        result = record_write(board, record_address(board, slot_index, slot, i), i, image,
                              &slot->records[i]);
    }
    if (result == STORAGE_OK) result = summary_write(board, slot_index, slot);
    if (result == STORAGE_OK) result = word_write(board, slot_index, word);
    if (result != STORAGE_OK) {
        /* The host is told that nothing changed, so a half-confirmed slot must not boot later. */
        (void)config_slot_void(board, slot_index);
    }
    return result;
}
