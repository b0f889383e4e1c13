#include "config_store.h"

#include <string.h>

#include "ebl_bytes.h"  // ebl_get_u32, ebl_put_u32
#include "ebl_frame.h"  // ebl_crc32
#include "parameters.h" // parameters_default_image, parameters_image_is_valid

#define SLOT_MAGIC 0x534C4245u /* "EBLS" */

enum {
    AT_MAGIC = 0,
    AT_CRC = 4,
    AT_SCHEMA_HASH = 8,
    AT_GENERATION = 16,
    AT_LENGTH = 20,
    HEADER_LENGTH = 24,
    AT_CONFIRMED = 24,
    AT_VOID = 28,
    AT_IMAGE = 32,
    SLOT_LENGTH = AT_IMAGE + EBL_IMAGE_LENGTH
};

#define WORD_ERASED 0xFFFFFFFFu
#define WORD_WRITTEN 0u

/* Bytes from one slot to the next: whole blocks. 0 where the flash cannot hold two slots. */
static size_t slot_stride(const hal *board)
{
    size_t blocks;

    if (board->flash_block_size == 0) return 0;
    blocks = (SLOT_LENGTH + board->flash_block_size - 1) / board->flash_block_size;
    if (board->flash_size / board->flash_block_size < CONFIG_STORE_SLOTS * blocks) return 0;
    return blocks * board->flash_block_size;
}

static uint32_t slot_crc(const uint8_t *slot)
{
    uint32_t crc = ebl_crc32(0, slot + AT_SCHEMA_HASH, HEADER_LENGTH - AT_SCHEMA_HASH);

    return ebl_crc32(crc, slot + AT_IMAGE, EBL_IMAGE_LENGTH);
}

static int slot_is_good(const uint8_t *slot)
{
    return ebl_get_u32(slot + AT_MAGIC) == SLOT_MAGIC &&
           memcmp(slot + AT_SCHEMA_HASH, ebl_schema_hash, EBL_SCHEMA_HASH_LENGTH) == 0 &&
           ebl_get_u16(slot + AT_LENGTH) == EBL_IMAGE_LENGTH &&
           ebl_get_u32(slot + AT_CONFIRMED) == WORD_WRITTEN &&
           ebl_get_u32(slot + AT_VOID) == WORD_ERASED &&
           ebl_get_u32(slot + AT_CRC) == slot_crc(slot) &&
           parameters_image_is_valid(slot + AT_IMAGE);
}

/* True with the image and generation of a good slot. */
static int slot_read(const hal *board, uint8_t slot_index, uint8_t *image, uint32_t *generation)
{
    uint8_t slot[SLOT_LENGTH];
    size_t stride = slot_stride(board);

    if (stride == 0) return 0;
    if (board->flash_read(board->context, slot_index * stride, slot, SLOT_LENGTH) < 0) return 0;
    if (!slot_is_good(slot)) return 0;
    memcpy(image, slot + AT_IMAGE, EBL_IMAGE_LENGTH);
    *generation = ebl_get_u32(slot + AT_GENERATION);
    return 1;
}

void config_store_boot(config_store *store, const hal *board)
{
    parameters_default_image(store->image);
    store->generation = 0;
    store->slot = CONFIG_STORE_NO_SLOT;
    for (uint8_t slot = 0; slot < CONFIG_STORE_SLOTS; slot++) {
        uint8_t image[EBL_IMAGE_LENGTH];
        uint32_t generation;

        if (!slot_read(board, slot, image, &generation)) continue;
        if (store->slot != CONFIG_STORE_NO_SLOT && generation <= store->generation) continue;
        memcpy(store->image, image, EBL_IMAGE_LENGTH);
        store->generation = generation;
        store->slot = slot;
    }
    store->crc32 = ebl_crc32(0, store->image, EBL_IMAGE_LENGTH);
}

/* Programs and reads back, a piece at a time so that the stack stays small. */
static int program_and_verify(const hal *board, size_t address, const uint8_t *bytes, size_t length)
{
    uint8_t piece[32];

    if (board->flash_program(board->context, address, bytes, length) < 0) {
        return CONFIG_STORE_FLASH_FAIL;
    }
    for (size_t at = 0; at < length; at += sizeof piece) {
        size_t count = length - at < sizeof piece ? length - at : sizeof piece;

        if (board->flash_read(board->context, address + at, piece, count) < 0) {
            return CONFIG_STORE_FLASH_FAIL;
        }
        if (memcmp(piece, bytes + at, count) != 0) return CONFIG_STORE_VERIFY_FAIL;
    }
    return CONFIG_STORE_OK;
}

static int slot_erase(const hal *board, size_t address, size_t stride)
{
    for (size_t at = 0; at < stride; at += board->flash_block_size) {
        if (board->flash_erase(board->context, address + at) < 0) return CONFIG_STORE_FLASH_FAIL;
    }
    return CONFIG_STORE_OK;
}

/* Image, then header, then the one word that makes the slot count. */
static int slot_write(const hal *board, size_t address, const uint8_t *header, const uint8_t *image)
{
    uint8_t word[4];
    int result = program_and_verify(board, address + AT_IMAGE, image, EBL_IMAGE_LENGTH);

    if (result == CONFIG_STORE_OK) {
        result = program_and_verify(board, address, header, HEADER_LENGTH);
    }
    ebl_put_u32(word, WORD_WRITTEN);
    if (result == CONFIG_STORE_OK) {
        result = program_and_verify(board, address + AT_CONFIRMED, word, sizeof word);
    }
    if (result != CONFIG_STORE_OK) {
        /* The host is told that nothing changed, so a half-confirmed slot must not boot later. */
        (void)board->flash_program(board->context, address + AT_VOID, word, sizeof word);
    }
    return result;
}

int config_store_write(config_store *store, const hal *board, const uint8_t *image)
{
    uint8_t header[HEADER_LENGTH];
    uint8_t target = store->slot == 0 ? 1 : 0;
    uint32_t crc;
    size_t stride = slot_stride(board);
    int result;

    if (stride == 0) return CONFIG_STORE_NO_SPACE;
    memset(header, 0xFF, sizeof header);
    ebl_put_u32(header + AT_MAGIC, SLOT_MAGIC);
    memcpy(header + AT_SCHEMA_HASH, ebl_schema_hash, EBL_SCHEMA_HASH_LENGTH);
    ebl_put_u32(header + AT_GENERATION, store->generation + 1);
    ebl_put_u16(header + AT_LENGTH, EBL_IMAGE_LENGTH);
    crc = ebl_crc32(0, header + AT_SCHEMA_HASH, HEADER_LENGTH - AT_SCHEMA_HASH);
    ebl_put_u32(header + AT_CRC, ebl_crc32(crc, image, EBL_IMAGE_LENGTH));

    result = slot_erase(board, target * stride, stride);
    if (result == CONFIG_STORE_OK) result = slot_write(board, target * stride, header, image);
    if (result != CONFIG_STORE_OK) return result;

    memcpy(store->image, image, EBL_IMAGE_LENGTH);
    store->crc32 = ebl_crc32(0, image, EBL_IMAGE_LENGTH);
    store->generation++;
    store->slot = target;
    return CONFIG_STORE_OK;
}

static int flash_is_blank(const hal *board, size_t length)
{
    uint8_t piece[32];

    for (size_t at = 0; at < length; at += sizeof piece) {
        size_t count = length - at < sizeof piece ? length - at : sizeof piece;

        if (board->flash_read(board->context, at, piece, count) < 0) return 0;
        for (size_t i = 0; i < count; i++) {
            if (piece[i] != 0xFF) return 0;
        }
    }
    return 1;
}

int config_store_provision(const hal *board, const uint8_t *image)
{
    config_store store;

    if (!flash_is_blank(board, CONFIG_STORE_SLOTS * slot_stride(board))) return CONFIG_STORE_OK;
    config_store_boot(&store, board);
    return config_store_write(&store, board, image);
}

int config_store_previous(const config_store *store, const hal *board, uint8_t *image,
                          uint32_t *generation)
{
    if (store->slot == CONFIG_STORE_NO_SLOT) return 0;
    return slot_read(board, store->slot == 0 ? 1 : 0, image, generation) &&
           *generation < store->generation;
}
