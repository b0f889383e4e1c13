#include "config_slot_ebl2.h"

#include "ebl_bytes.h"    // ebl_get_u32
#include "ebl_frame.h"    // ebl_crc32
#include "flash_verify.h" // flash_crc32

#define MAGIC 0x324C4245u /* "EBL2" */

enum {
    AT_MAGIC = 0,
    AT_CRC = 4,
    AT_LAYOUT = 8,
    AT_GENERATION = 12,
    AT_LENGTH = 16,
    AT_ERASES = 20,
    HEADER_LENGTH = 24,
    AT_IMAGE = 36
};

/* The parameters of that time. Their layouts grew at the end, so that each is a beginning of the
 * last one. */
static const struct {
    uint16_t id;
    uint8_t type; /* ebl_type */
    uint8_t count;
    uint8_t length;
} rows[] = {
    {0x0100, EBL_TYPE_F32, 1, 4},   {0x0101, EBL_TYPE_F32, 1, 4},   {0x0102, EBL_TYPE_F32, 1, 4},
    {0x0103, EBL_TYPE_U16, 1, 2},   {0x0104, EBL_TYPE_F32, 1, 4},   {0x0200, EBL_TYPE_U8, 1, 1},
    {0x0201, EBL_TYPE_TEXT, 5, 16}, {0x0202, EBL_TYPE_U8, 5, 1},    {0x0203, EBL_TYPE_F32, 5, 4},
    {0x0204, EBL_TYPE_F32, 1, 4},   {0x0205, EBL_TYPE_F32, 1, 4},   {0x0206, EBL_TYPE_F32, 1, 4},
    {0x0207, EBL_TYPE_F32, 1, 4},   {0x0208, EBL_TYPE_F32, 1, 4},   {0x0300, EBL_TYPE_TEXT, 1, 24},
    {0x0301, EBL_TYPE_U8, 1, 1},    {0x0302, EBL_TYPE_F32, 5, 4},   {0x0303, EBL_TYPE_F32, 5, 4},
    {0x0304, EBL_TYPE_F32, 5, 4},   {0x0305, EBL_TYPE_U8, 25, 1},   {0x0306, EBL_TYPE_U8, 1, 1},
    {0x0400, EBL_TYPE_F32, 1, 4},   {0x0401, EBL_TYPE_F32, 1, 4},   {0x0402, EBL_TYPE_F32, 1, 4},
    {0x0403, EBL_TYPE_F32, 1, 4},   {0x0404, EBL_TYPE_F32, 1, 4},   {0x0405, EBL_TYPE_F32, 1, 4},
    {0x0406, EBL_TYPE_U16, 1, 2},   {0x0500, EBL_TYPE_F32, 1, 4},   {0x0501, EBL_TYPE_U8, 1, 1},
    {0x0502, EBL_TYPE_U8, 1, 1},    {0x0503, EBL_TYPE_F32, 1, 4},   {0x0510, EBL_TYPE_F32, 1, 4},
    {0x0511, EBL_TYPE_F32, 1, 4},   {0x0600, EBL_TYPE_U8, 5, 1},    {0x0601, EBL_TYPE_U8, 5, 1},
    {0x0602, EBL_TYPE_U16, 5, 2},   {0x0603, EBL_TYPE_U16, 5, 2},   {0x0604, EBL_TYPE_U8, 5, 1},
    {0x0605, EBL_TYPE_F32, 1, 4},   {0x0610, EBL_TYPE_TEXT, 1, 24}, {0x0611, EBL_TYPE_U8, 1, 1},
    {0x0612, EBL_TYPE_F32, 5, 4},   {0x0613, EBL_TYPE_U8, 25, 1},   {0x0620, EBL_TYPE_U8, 1, 1},
    {0x0621, EBL_TYPE_F32, 1, 4},
};

#define ROWS (sizeof rows / sizeof rows[0])

/* The layout's check value of an image of this length, as the slot has it; 0 where no layout has
 * that length. */
static uint32_t layout_crc32(uint16_t image_length)
{
    uint32_t crc = 0;
    uint16_t offset = 0;

    for (size_t i = 0; i < ROWS && offset < image_length; i++) {
        uint8_t bytes[8];

        ebl_put_u16(bytes, rows[i].id);
        bytes[2] = rows[i].type;
        bytes[3] = rows[i].count;
        ebl_put_u16(bytes + 4, rows[i].length);
        ebl_put_u16(bytes + 6, offset);
        crc = ebl_crc32(crc, bytes, sizeof bytes);
        offset = (uint16_t)(offset + rows[i].count * rows[i].length);
    }
    return offset == image_length ? crc : 0;
}

uint32_t ebl2_generation(const uint8_t *head) { return ebl_get_u32(head + AT_GENERATION); }

uint32_t ebl2_erases(const uint8_t *head) { return ebl_get_u32(head + AT_ERASES); }

uint16_t ebl2_image_length(const uint8_t *head) { return ebl_get_u16(head + AT_LENGTH); }

int ebl2_is_whole(const hal *board, size_t address, const uint8_t *head)
{
    uint32_t crc = ebl_crc32(0, head + AT_LAYOUT, HEADER_LENGTH - AT_LAYOUT);
    uint16_t length = ebl2_image_length(head);

    if (ebl_get_u32(head + AT_MAGIC) != MAGIC) return 0;
    if (ebl_get_u32(head + AT_LAYOUT) != layout_crc32(length)) return 0;
    if (flash_crc32(board, address + AT_IMAGE, length, &crc) < 0) return 0;
    return crc == ebl_get_u32(head + AT_CRC);
}

int ebl2_image_read(const hal *board, size_t address, uint16_t image_length, uint8_t *image,
                    config_tally *tally)
{
    size_t at = 0;

    for (size_t i = 0; i < ROWS && at < image_length; i++) {
        const config_item item = {rows[i].id, rows[i].count, rows[i].length,
                                  address + AT_IMAGE + at};

        if (config_value_read(board, &item, image, tally) < 0) return -1;
        at += (size_t)rows[i].count * rows[i].length;
    }
    return 0;
}
