#include "pages.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_put_u32
#include "ebl_registry.h" // ebl_channels

#define ROW_PERIOD_US 100000u
#define UID_LENGTH 12
#define SYNC_UNCERTAINTY_MS 1000 /* hosts set the clock of a bike, not of a laboratory */

enum {
    CONFIG_AT_SCHEMA_HASH = UID_LENGTH,
    CONFIG_AT_GENERATION = CONFIG_AT_SCHEMA_HASH + EBL_SCHEMA_HASH_LENGTH,
    CONFIG_AT_CRC = CONFIG_AT_GENERATION + 4,
    CONFIG_AT_IMAGE = CONFIG_AT_CRC + 4,
    CONFIG_IMAGE_LENGTH = RIDE_LOG_PAYLOAD_BYTES - CONFIG_AT_IMAGE,
    REST_AT_IMAGE = 4,
    REST_LENGTH = REST_AT_IMAGE + EBL_IMAGE_LENGTH - CONFIG_IMAGE_LENGTH,
    SCHEMA_HEAD_LENGTH = 5,
    SCHEMA_CHANNEL_LENGTH = 5,
    SCHEMA_LENGTH = SCHEMA_HEAD_LENGTH + SCHEMA_CHANNEL_LENGTH * EBL_CHANNEL_COUNT,
    EVENT_LENGTH = 11,
    EVENT_HIGH_LENGTH = 2,
    SYNC_LENGTH = 12,
    END_LENGTH = 13
};

/* Whatever the registry becomes, a block must hold these whole. */
typedef char there_is_a_rest[EBL_IMAGE_LENGTH > CONFIG_IMAGE_LENGTH ? 1 : -1];
typedef char rest_fits[REST_LENGTH <= RIDE_LOG_PAYLOAD_BYTES ? 1 : -1];
typedef char schema_fits[SCHEMA_LENGTH <= RIDE_LOG_PAYLOAD_BYTES ? 1 : -1];
typedef char events_fit
    [(EVENT_LENGTH + EVENT_HIGH_LENGTH) * RIDE_LOG_EVENTS_MAX <= RIDE_LOG_PAYLOAD_BYTES ? 1 : -1];
typedef char a_row_fits[RIDE_LOG_ROW_BYTES <= RIDE_LOG_PAYLOAD_BYTES ? 1 : -1];

uint32_t ride_log_row_period_us(void) { return ROW_PERIOD_US; }

void ride_log_config_put(uint8_t *payload, const config_store *config, const hal *board,
                         ride_log_header *header)
{
    memcpy(payload, board->uid, UID_LENGTH);
    memcpy(payload + CONFIG_AT_SCHEMA_HASH, ebl_schema_hash, EBL_SCHEMA_HASH_LENGTH);
    ebl_put_u32(payload + CONFIG_AT_GENERATION, config->generation);
    ebl_put_u32(payload + CONFIG_AT_CRC, config->crc32);
    memcpy(payload + CONFIG_AT_IMAGE, config->image, CONFIG_IMAGE_LENGTH);
    header->type = RIDE_LOG_CONFIG;
    header->length = RIDE_LOG_PAYLOAD_BYTES;
}

void ride_log_config_rest_put(uint8_t *payload, const config_store *config, ride_log_header *header)
{
    ebl_put_u32(payload, config->crc32);
    memcpy(payload + REST_AT_IMAGE, config->image + CONFIG_IMAGE_LENGTH,
           EBL_IMAGE_LENGTH - CONFIG_IMAGE_LENGTH);
    header->type = RIDE_LOG_CONFIG_REST;
    header->length = REST_LENGTH;
}

void ride_log_schema_put(uint8_t *payload, ride_log_header *header)
{
    uint8_t *at = payload + SCHEMA_HEAD_LENGTH;

    ebl_put_u32(payload, ROW_PERIOD_US);
    payload[4] = EBL_CHANNEL_COUNT;
    for (size_t i = 0; i < EBL_CHANNEL_COUNT; i++, at += SCHEMA_CHANNEL_LENGTH) {
        at[0] = ebl_channels[i].id;
        ebl_put_f32(at + 1, ebl_channels[i].scale);
    }
    header->type = RIDE_LOG_SCHEMA;
    header->length = SCHEMA_LENGTH;
    header->schema_id = RIDE_LOG_SCHEMA_ID;
}

/* The flags' high halves come behind all events: a reader that does not know them finds what it
 * knows at its place. */
void ride_log_events_put(uint8_t *payload, const ride_log_event *events, uint8_t count,
                         ride_log_header *header)
{
    uint8_t *highs = payload + (size_t)count * EVENT_LENGTH;

    for (size_t i = 0; i < count; i++) {
        uint8_t *at = payload + i * EVENT_LENGTH;

        ebl_put_u64(at, events[i].t_us);
        at[8] = events[i].code;
        ebl_put_u16(at + 9, (uint16_t)(events[i].flags & 0xffffu));
        ebl_put_u16(highs + i * EVENT_HIGH_LENGTH, (uint16_t)(events[i].flags >> 16));
    }
    header->type = RIDE_LOG_EVENT;
    header->n = count;
    header->length = (uint16_t)(count * (EVENT_LENGTH + EVENT_HIGH_LENGTH));
}

void ride_log_sync_put(uint8_t *payload, uint64_t unix_us, ride_log_header *header)
{
    ebl_put_u64(payload, unix_us);
    ebl_put_u32(payload + 8, SYNC_UNCERTAINTY_MS);
    header->type = RIDE_LOG_SYNC;
    header->n = 1;
    header->length = SYNC_LENGTH;
}

void ride_log_end_put(uint8_t *payload, const ride_log_totals *totals, ride_log_header *header)
{
    ebl_put_u32(payload, totals->rows_written);
    ebl_put_u32(payload + 4, totals->rows_lost);
    payload[8] = totals->reason;
    ebl_put_u32(payload + 9, totals->events_lost);
    header->type = RIDE_LOG_END;
    header->length = END_LENGTH;
}
