/* Payloads of the blocks around the rows of a ride log (SPEC chapter 11). Each fills in type,
 * length and numbers of the header. */
#ifndef SPINDLE_RIDE_LOG_PAGES_H
#define SPINDLE_RIDE_LOG_PAGES_H

#include <stdint.h>

#include "storage/config_store.h" // config_store
#include "hal.h"                  // hal
#include "ebl_registry.h"         // EBL_CHANNEL_COUNT
#include "block.h"                // ride_log_header

#define RIDE_LOG_SCHEMA_ID 1 /* all channels at 10 Hz; another group of channels is another id */

#define RIDE_LOG_ROW_BYTES (2 * EBL_CHANNEL_COUNT)
#define RIDE_LOG_EVENTS_MAX 16

typedef struct {
    uint64_t t_us;
    uint32_t flags;
    uint8_t code;
} ride_log_event;

/* What a log says of itself when it ends. */
typedef struct {
    uint32_t rows_written;
    uint32_t rows_lost;   /* since boot */
    uint32_t events_lost; /* since boot */
    uint8_t reason;       /* why it ended */
} ride_log_totals;

uint32_t ride_log_row_period_us(void);

void ride_log_config_put(uint8_t *payload, const config_store *config, const hal *board,
                         ride_log_header *header);
void ride_log_config_rest_put(uint8_t *payload, const config_store *config,
                              ride_log_header *header);
void ride_log_schema_put(uint8_t *payload, ride_log_header *header);
void ride_log_events_put(uint8_t *payload, const ride_log_event *events, uint8_t count,
                         ride_log_header *header);
void ride_log_sync_put(uint8_t *payload, uint64_t unix_us, ride_log_header *header);
void ride_log_end_put(uint8_t *payload, const ride_log_totals *totals, ride_log_header *header);

#endif
