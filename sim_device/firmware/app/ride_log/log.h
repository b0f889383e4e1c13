/* The recorder in the unit: a bike that moves makes a log, standstill ends it.
 *
 * Rows are taken in the control step into RAM; blocks go to flash in polls, one operation at a
 * time and without waiting for any. A flash that is too slow or broken costs rows, which are
 * counted, and never time. */
#ifndef SPINDLE_RIDE_LOG_H
#define SPINDLE_RIDE_LOG_H

#include <stdint.h>

#include "storage/config_store.h" // config_store
#include "ebl_registry.h"         // EBL_CHANNEL_COUNT
#include "line/events.h"          // event_log
#include "hal.h"                  // hal
#include "line/link.h"            // unit_link
#include "pages.h"                // ride_log_event, ride_log_totals
#include "store.h"                // ride_log_store

/* A DATA block in the making. */
typedef struct {
    uint64_t t0_us;
    uint8_t rows;
    uint8_t payload[RIDE_LOG_PAYLOAD_BYTES];
} ride_log_rows;

typedef struct {
    ride_log_store store;
    uint8_t state;
    uint8_t place; /* of the log being written */
    uint8_t mode;  /* as last told */
    uint8_t due;   /* blocks to be written before the next rows */
    uint8_t steps_left;
    uint8_t spare_state;
    uint8_t no_room; /* for another block of this log */
    uint8_t victim;  /* log whose first block is being erased */
    uint16_t spare;  /* erased block for what comes next */
    uint16_t block;  /* being written */
    uint32_t seq;
    ride_log_totals totals;
    uint32_t config_generation; /* as last written */
    uint64_t unix_offset_us;    /* Unix time minus the unit's, as last told; 0: not known */
    uint64_t moved_us;
    uint64_t erase_us;  /* when the flash may be asked again after a refusal */
    uint64_t repeat_us; /* when CONFIG and SCHEMA are due again */
    uint64_t events_us; /* when events may be written again */
    ride_log_rows filling;
    ride_log_rows full; /* rows > 0: waits to be written */
    ride_log_event events[RIDE_LOG_EVENTS_MAX];
    uint8_t event_count;
    uint8_t page[RIDE_LOG_PAGE_BYTES]; /* being programmed */
} ride_log;

void ride_log_init(ride_log *log, const hal *board);

/* One control step: the row as telemetry has it. */
void ride_log_step(ride_log *log, const int16_t *row, uint64_t now_us, int moving);

/* `code`: an ebl_log_event. */
void ride_log_event_add(ride_log *log, uint8_t code, uint32_t flags, uint64_t now_us);

/* The mode the rider has chosen; a change is an event. */
void ride_log_mode_set(ride_log *log, uint8_t mode, uint64_t now_us);

/* What time it is in the world, as soon as somebody has told the unit. */
void ride_log_clock_set(ride_log *log, uint64_t unix_offset_us);

/* Begins at most one flash operation; tells of logs that ended or were given up. */
void ride_log_poll(ride_log *log, const hal *board, const config_store *config, event_log *events,
                   unit_link *link);

#endif
