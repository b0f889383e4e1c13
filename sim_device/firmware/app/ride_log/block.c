#include "block.h"

#include <string.h>

#include "ebl_bytes.h" // ebl_put_u32
#include "ebl_frame.h" // ebl_crc32

#define MAGIC 0x4C4C4245u /* "EBLL" */
#define VERSION 1

enum {
    AT_MAGIC = 0,
    AT_VERSION = 4,
    AT_TYPE = 5,
    AT_LENGTH = 6,
    AT_LOG_ID = 8,
    AT_BOOT_ID = 12,
    AT_SEQ = 16,
    AT_T0 = 20,
    AT_N = 28,
    AT_SCHEMA_ID = 30
};

uint32_t ride_log_block_seal(uint8_t *page, const ride_log_header *header)
{
    size_t end = RIDE_LOG_AT_PAYLOAD + (size_t)header->length;
    uint32_t crc;

    ebl_put_u32(page + AT_MAGIC, MAGIC);
    page[AT_VERSION] = VERSION;
    page[AT_TYPE] = header->type;
    ebl_put_u16(page + AT_LENGTH, header->length);
    ebl_put_u32(page + AT_LOG_ID, header->log_id);
    ebl_put_u32(page + AT_BOOT_ID, header->boot_id);
    ebl_put_u32(page + AT_SEQ, header->seq);
    ebl_put_u64(page + AT_T0, header->t0_us);
    ebl_put_u16(page + AT_N, header->n);
    ebl_put_u16(page + AT_SCHEMA_ID, header->schema_id);
    crc = ebl_crc32(0, page, end);
    ebl_put_u32(page + end, crc);
    memset(page + end + 4, 0xFF, RIDE_LOG_PAGE_BYTES - end - 4);
    return crc;
}

int ride_log_header_get(ride_log_header *header, const uint8_t *page)
{
    header->type = page[AT_TYPE];
    header->length = ebl_get_u16(page + AT_LENGTH);
    header->log_id = ebl_get_u32(page + AT_LOG_ID);
    header->boot_id = ebl_get_u32(page + AT_BOOT_ID);
    header->seq = ebl_get_u32(page + AT_SEQ);
    header->t0_us = ebl_get_u64(page + AT_T0);
    header->n = ebl_get_u16(page + AT_N);
    header->schema_id = ebl_get_u16(page + AT_SCHEMA_ID);
    return ebl_get_u32(page + AT_MAGIC) == MAGIC && page[AT_VERSION] == VERSION &&
           header->length <= RIDE_LOG_PAYLOAD_BYTES && header->log_id != 0;
}

int ride_log_block_get(ride_log_header *header, uint32_t *crc32, const uint8_t *page)
{
    if (!ride_log_header_get(header, page)) return 0;
    *crc32 = ebl_get_u32(page + RIDE_LOG_AT_PAYLOAD + header->length);
    return *crc32 == ebl_crc32(0, page, RIDE_LOG_AT_PAYLOAD + (size_t)header->length);
}
