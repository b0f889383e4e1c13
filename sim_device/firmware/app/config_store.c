#include "config_store.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_get_u32, ebl_put_u32
#include "ebl_frame.h"    // ebl_crc32
#include "flash_verify.h" // flash_program_verified
#include "parameters.h"   // parameters_default_image, parameters_layout_crc32

#define SLOT_MAGIC 0x324C4245u /* "EBL2" */

enum {
    AT_MAGIC = 0,
    AT_CRC = 4,
    AT_LAYOUT = 8,
    AT_GENERATION = 12,
    AT_LENGTH = 16,
    AT_ERASES = 20,
    HEADER_LENGTH = 24,
    AT_PROVISIONAL = 24,
    AT_CONFIRMED = 28,
    AT_VOID = 32,
    AT_IMAGE = 36,
    SLOT_LENGTH = AT_IMAGE + EBL_IMAGE_LENGTH
};

#define WORD_ERASED 0xFFFFFFFFu
#define WORD_WRITTEN 0u
#define WORD_LENGTH 4

/* Bytes from one slot to the next: whole blocks. 0 where the flash cannot hold two slots. */
static size_t slot_stride(const hal *board)
{
    size_t blocks;

    if (board->flash_block_size == 0) return 0;
    blocks = (SLOT_LENGTH + board->flash_block_size - 1) / board->flash_block_size;
    if (board->flash_size / board->flash_block_size < CONFIG_STORE_SLOTS * blocks) return 0;
    return blocks * board->flash_block_size;
}

size_t config_store_flash_bytes(const hal *board)
{
    return CONFIG_STORE_SLOTS * slot_stride(board);
}

static uint32_t slot_crc(const uint8_t *header, const uint8_t *image)
{
    uint32_t crc = ebl_crc32(0, header + AT_LAYOUT, HEADER_LENGTH - AT_LAYOUT);

    return ebl_crc32(crc, image, EBL_IMAGE_LENGTH);
}

/* A table that an earlier firmware took gets its points moved apart here, and not on the flash. */
static int slot_is_whole(const uint8_t *head, uint8_t *image)
{
    if (ebl_get_u32(head + AT_MAGIC) != SLOT_MAGIC ||
        ebl_get_u32(head + AT_LAYOUT) != parameters_layout_crc32() ||
        ebl_get_u16(head + AT_LENGTH) != EBL_IMAGE_LENGTH ||
        ebl_get_u32(head + AT_CRC) != slot_crc(head, image)) {
        return 0;
    }
    (void)parameters_points_spread(image);
    return parameters_image_is_valid(image);
}

/* A state word that was cut in half says as little as one that was never written, but for void:
 * whoever began to take a slot back meant it. */
static uint8_t slot_state(const uint8_t *head, uint8_t *image)
{
    if (ebl_get_u32(head + AT_MAGIC) == WORD_ERASED) return EBL_SLOT_STATE_EMPTY;
    if (!slot_is_whole(head, image)) return EBL_SLOT_STATE_DAMAGED;
    if (ebl_get_u32(head + AT_VOID) != WORD_ERASED) return EBL_SLOT_STATE_VOID;
    if (ebl_get_u32(head + AT_CONFIRMED) == WORD_WRITTEN) return EBL_SLOT_STATE_CONFIRMED;
    if (ebl_get_u32(head + AT_PROVISIONAL) == WORD_WRITTEN) return EBL_SLOT_STATE_PROVISIONAL;
    return EBL_SLOT_STATE_DAMAGED;
}

/* The slot's state, what lies before its image, and the image. */
static uint8_t slot_read(const hal *board, uint8_t slot_index, uint8_t *head, uint8_t *image)
{
    size_t stride = slot_stride(board);
    size_t address = slot_index * stride;

    if (stride == 0) return EBL_SLOT_STATE_EMPTY;
    if (board->flash_read(board->context, address, head, AT_IMAGE) < 0 ||
        board->flash_read(board->context, address + AT_IMAGE, image, EBL_IMAGE_LENGTH) < 0) {
        return EBL_SLOT_STATE_DAMAGED;
    }
    return slot_state(head, image);
}

static int word_write(const hal *board, uint8_t slot_index, size_t at)
{
    uint8_t word[WORD_LENGTH];

    ebl_put_u32(word, WORD_WRITTEN);
    return flash_program_verified(board, slot_index * slot_stride(board) + at, word, sizeof word);
}

/* The confirmed slot of the highest generation, or the factory default. */
static void slot_choose(config_store *store, const hal *board)
{
    uint8_t head[AT_IMAGE];
    uint8_t image[EBL_IMAGE_LENGTH];

    parameters_default_image(store->image);
    store->generation = 0;
    store->slot = CONFIG_STORE_NO_SLOT;
    store->on_trial = 0;
    for (uint8_t index = 0; index < CONFIG_STORE_SLOTS; index++) {
        uint32_t generation;

        if (slot_read(board, index, head, image) != EBL_SLOT_STATE_CONFIRMED) continue;
        generation = ebl_get_u32(head + AT_GENERATION);
        if (store->slot != CONFIG_STORE_NO_SLOT && generation <= store->generation) continue;
        memcpy(store->image, image, sizeof image);
        store->generation = generation;
        store->slot = index;
    }
    store->crc32 = ebl_crc32(0, store->image, EBL_IMAGE_LENGTH);
}

void config_store_boot(config_store *store, const hal *board)
{
    store->returned_generation = 0;
    for (uint8_t index = 0; index < CONFIG_STORE_SLOTS; index++) {
        config_slot seen;

        config_store_slot(board, index, &seen);
        if (seen.state != EBL_SLOT_STATE_PROVISIONAL) continue;
        store->returned_generation = seen.generation;
        (void)word_write(board, index, AT_VOID);
    }
    slot_choose(store, board);
}

static int slot_erase(const hal *board, uint8_t slot_index)
{
    size_t stride = slot_stride(board);

    for (size_t at = 0; at < stride; at += board->flash_block_size) {
        if (board->flash_erase(board->context, slot_index * stride + at) < 0) {
            return CONFIG_STORE_FLASH_FAIL;
        }
    }
    return CONFIG_STORE_OK;
}

/* Image, then header, then the one word that makes the slot count. */
static int slot_write(const hal *board, uint8_t slot_index, const config_slot *slot,
                      const uint8_t *image)
{
    uint8_t header[HEADER_LENGTH];
    size_t address = slot_index * slot_stride(board);
    size_t state_word = slot->state == EBL_SLOT_STATE_PROVISIONAL ? AT_PROVISIONAL : AT_CONFIRMED;
    int result = slot_erase(board, slot_index);

    if (result != CONFIG_STORE_OK) return result;
    memset(header, 0xFF, sizeof header);
    ebl_put_u32(header + AT_MAGIC, SLOT_MAGIC);
    ebl_put_u32(header + AT_LAYOUT, parameters_layout_crc32());
    ebl_put_u32(header + AT_GENERATION, slot->generation);
    ebl_put_u16(header + AT_LENGTH, EBL_IMAGE_LENGTH);
    ebl_put_u32(header + AT_ERASES, slot->erases);
    ebl_put_u32(header + AT_CRC, slot_crc(header, image));
    result = flash_program_verified(board, address + AT_IMAGE, image, EBL_IMAGE_LENGTH);
    if (result == CONFIG_STORE_OK) {
        result = flash_program_verified(board, address, header, HEADER_LENGTH);
    }
    if (result == CONFIG_STORE_OK) result = word_write(board, slot_index, state_word);
    if (result != CONFIG_STORE_OK) {
        /* The host is told that nothing changed, so a half-confirmed slot must not boot later. */
        (void)word_write(board, slot_index, AT_VOID);
    }
    return result;
}

/* How often the slot was erased so far; a damaged one cannot tell and is taken for its twin. */
static uint32_t erases_so_far(const hal *board, uint8_t slot_index)
{
    config_slot seen;

    config_store_slot(board, slot_index, &seen);
    if (seen.state == EBL_SLOT_STATE_DAMAGED)
        config_store_slot(board, slot_index == 0 ? 1 : 0, &seen);
    return seen.erases;
}

int config_store_write(config_store *store, const hal *board, const uint8_t *image, int on_trial)
{
    uint8_t target = store->slot == 0 ? 1 : 0;
    config_slot slot = {EBL_SLOT_STATE_CONFIRMED, store->generation + 1, 0};
    int result;

    if (slot_stride(board) == 0) return CONFIG_STORE_NO_SPACE;
    if (on_trial) slot.state = EBL_SLOT_STATE_PROVISIONAL;
    slot.erases = erases_so_far(board, target) + 1;
    result = slot_write(board, target, &slot, image);
    if (result != CONFIG_STORE_OK) return result;

    memcpy(store->image, image, EBL_IMAGE_LENGTH);
    store->crc32 = ebl_crc32(0, image, EBL_IMAGE_LENGTH);
    store->generation++;
    store->slot = target;
    store->on_trial = on_trial ? 1 : 0;
    return CONFIG_STORE_OK;
}

int config_store_confirm(config_store *store, const hal *board)
{
    int result = word_write(board, store->slot, AT_CONFIRMED);

    if (result == CONFIG_STORE_OK) store->on_trial = 0;
    return result;
}

void config_store_return(config_store *store, const hal *board)
{
    (void)word_write(board, store->slot, AT_VOID);
    slot_choose(store, board);
}

int config_store_provision(const hal *board, const uint8_t *image)
{
    const config_slot first = {EBL_SLOT_STATE_CONFIRMED, 1, 1};

    if (slot_stride(board) == 0) return CONFIG_STORE_NO_SPACE;
    if (!flash_is_blank(board, 0, config_store_flash_bytes(board))) return CONFIG_STORE_OK;
    return slot_write(board, 0, &first, image);
}

int config_store_previous(const config_store *store, const hal *board, uint8_t *image,
                          uint32_t *generation)
{
    uint8_t head[AT_IMAGE];
    uint8_t other = store->slot == 0 ? 1 : 0;

    if (store->slot == CONFIG_STORE_NO_SLOT) return 0;
    if (slot_read(board, other, head, image) != EBL_SLOT_STATE_CONFIRMED) return 0;
    *generation = ebl_get_u32(head + AT_GENERATION);
    return *generation < store->generation;
}

void config_store_slot(const hal *board, uint8_t slot_index, config_slot *seen)
{
    uint8_t head[AT_IMAGE];
    uint8_t image[EBL_IMAGE_LENGTH];

    seen->state = slot_read(board, slot_index, head, image);
    seen->generation = 0;
    seen->erases = 0;
    if (seen->state == EBL_SLOT_STATE_EMPTY || seen->state == EBL_SLOT_STATE_DAMAGED) return;
    seen->generation = ebl_get_u32(head + AT_GENERATION);
    seen->erases = ebl_get_u32(head + AT_ERASES);
}
