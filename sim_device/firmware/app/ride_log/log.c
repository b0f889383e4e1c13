#include "log.h"

#include <string.h>

#include "ebl_bytes.h" // ebl_put_i16, ebl_put_u32
#include "pages.h"     // ride_log_config_put

#define STEPS_PER_ROW 10 /* 10 Hz */
#define ROWS_PER_BLOCK (RIDE_LOG_PAYLOAD_BYTES / RIDE_LOG_ROW_BYTES)
#define STANDING_US (EBL_STANDING_S * 1000000u)
#define REPEAT_US 60000000u
#define REFUSED_PERIOD_US 100000u /* rows for two seconds have room meanwhile */
#define EVENTS_PERIOD_US 1000000u /* a flickering fault must not fill the flash */

enum { IDLE = 0, STARTING, RECORDING, CLOSING };
enum { SPARE_NONE = 0, SPARE_ERASING, SPARE_READY };
enum { DUE_CONFIG = 1, DUE_SCHEMA = 2, DUE_SYNC = 4, DUE_ALL = 7, DUE_CONFIG_REST = 8 };
enum { REASON_STANDSTILL = 0, REASON_FULL = 1 };

void ride_log_init(ride_log *log, const hal *board)
{
    memset(log, 0, sizeof *log);
    log->place = RIDE_LOG_NONE;
    log->victim = RIDE_LOG_NONE;
    log->steps_left = 1;
    ride_log_store_boot(&log->store, board, ride_log_row_period_us(), log->page);
}

static void row_take(ride_log *log, const int16_t *row, uint64_t now_us)
{
    ride_log_rows *rows = &log->filling;

    if (rows->rows == ROWS_PER_BLOCK) {
        if (log->full.rows > 0) {
            log->totals.rows_lost += rows->rows;
            log->due |= DUE_CONFIG | DUE_SCHEMA;
        } else {
            log->full = *rows;
        }
        rows->rows = 0;
    }
    if (rows->rows == 0) rows->t0_us = now_us;
    for (size_t i = 0; i < EBL_CHANNEL_COUNT; i++) {
        ebl_put_i16(rows->payload + rows->rows * RIDE_LOG_ROW_BYTES + 2 * i, row[i]);
    }
    rows->rows++;
}

void ride_log_step(ride_log *log, const int16_t *row, uint64_t now_us, int moving)
{
    if (log->store.blocks == 0) return;
    if (moving) {
        log->moved_us = now_us;
        if (log->state == IDLE) {
            log->state = STARTING;
            log->due = DUE_ALL;
            log->steps_left = 1;
        }
    } else if (log->state == RECORDING && now_us - log->moved_us >= STANDING_US) {
        log->state = CLOSING;
        log->totals.reason = REASON_STANDSTILL;
    }
    if (log->state != STARTING && log->state != RECORDING) return;
    if (--log->steps_left > 0) return;
    log->steps_left = STEPS_PER_ROW;
    row_take(log, row, now_us);
}

void ride_log_event_add(ride_log *log, uint8_t code, uint32_t flags, uint64_t now_us)
{
    ride_log_event *event = &log->events[log->event_count];

    if (log->state == IDLE) return;
    if (log->event_count == RIDE_LOG_EVENTS_MAX) {
        log->totals.events_lost++;
        return;
    }
    event->t_us = now_us;
    event->code = code;
    event->flags = flags;
    log->event_count++;
}

void ride_log_mode_set(ride_log *log, uint8_t mode, uint64_t now_us)
{
    if (mode == log->mode) return;
    log->mode = mode;
    ride_log_event_add(log, EBL_LOG_EVENT_ASSIST_MODE, mode, now_us);
}

void ride_log_clock_set(ride_log *log, uint64_t unix_offset_us)
{
    log->unix_offset_us = unix_offset_us;
    log->due |= DUE_SYNC;
}

/* ---------------------------------------------------------------- room in flash */

/* The block for what comes next, of an older log if there is no other. A log's blocks follow each
 * other once around the ring: where that cannot go on it is closed, and the next one begins. */
static uint16_t spare_choose(ride_log *log)
{
    int starting = log->state == STARTING;
    uint16_t limit = starting ? RIDE_LOG_NO_BLOCK : log->store.logs[log->place].first_block;
    uint16_t block = ride_log_store_free_block(&log->store, limit);

    if (starting && ride_log_store_free_place(&log->store) == RIDE_LOG_NONE) {
        block = RIDE_LOG_NO_BLOCK;
    }
    if (block != RIDE_LOG_NO_BLOCK) return block;
    log->victim = ride_log_store_victim(&log->store);
    if (log->victim != RIDE_LOG_NONE) {
        block = log->store.logs[log->victim].first_block;
        if (starting || ride_log_store_is_before(&log->store, block, limit)) return block;
    }
    log->victim = RIDE_LOG_NONE;
    return RIDE_LOG_NO_BLOCK;
}

static void spare_begin(ride_log *log, const hal *board, uint64_t now_us)
{
    uint16_t block;

    if (now_us < log->erase_us) return;
    block = spare_choose(log);
    if (block == RIDE_LOG_NO_BLOCK) {
        ride_log_store_forgive(&log->store);
        log->erase_us = now_us + REFUSED_PERIOD_US;
        if (log->state == STARTING) return;
        log->state = CLOSING;
        log->totals.reason = REASON_FULL;
        log->no_room = 1;
        return;
    }
    log->spare = block;
    if (ride_log_store_erase(&log->store, board, block) < 0) {
        log->victim = RIDE_LOG_NONE;
        log->erase_us = now_us + REFUSED_PERIOD_US;
        return;
    }
    log->spare_state = SPARE_ERASING;
}

static void spare_finish(ride_log *log, event_log *events, unit_link *link, uint64_t now_us)
{
    log->spare_state = SPARE_READY;
    if (log->victim != RIDE_LOG_NONE) {
        ride_log_entry gone = log->store.logs[log->victim];

        ride_log_store_release(&log->store, log->victim);
        log->victim = RIDE_LOG_NONE;
        if (!(gone.flags & EBL_LOG_CONFIRMED)) {
            log->store.overwritten++;
            event_log_overwritten(events, link, now_us, gone.id, gone.generation,
                                  log->store.overwritten);
        }
    }
}

/* Takes the spare block for the log. */
static void block_take(ride_log *log)
{
    log->block = log->spare;
    log->store.owner[log->block] = log->place;
    log->store.head = (uint16_t)((log->block + 1u) % log->store.blocks);
    log->spare_state = SPARE_NONE;
}

/* ---------------------------------------------------------------- blocks */

static void log_begin(ride_log *log, const hal *board)
{
    ride_log_entry *entry;

    log->place = ride_log_store_free_place(&log->store);
    entry = &log->store.logs[log->place];
    memset(entry, 0, sizeof *entry);
    entry->id = log->store.next_id++;
    entry->boot_id = board->boot_id;
    entry->t0_us = log->full.rows > 0 ? log->full.t0_us : log->filling.t0_us;
    entry->t1_us = entry->t0_us;
    entry->first_block = log->spare;
    entry->flags = EBL_LOG_RECORDING;
    log->seq = 0;
    log->totals.rows_written = 0;
    log->state = RECORDING;
}

static void log_end(ride_log *log, event_log *events, unit_link *link, uint64_t now_us)
{
    ride_log_entry *entry = &log->store.logs[log->place];

    entry->flags = (uint8_t)((entry->flags & ~EBL_LOG_RECORDING) | EBL_LOG_ENDED);
    event_log_closed(events, link, now_us, entry->id, entry->generation,
                     ride_log_store_length(&log->store, log->place));
    log->place = RIDE_LOG_NONE;
    log->no_room = 0;
    log->state = IDLE;
    log->totals.rows_lost += (uint32_t)log->filling.rows + log->full.rows;
    log->totals.events_lost += log->event_count;
    log->filling.rows = 0;
    log->full.rows = 0;
    log->event_count = 0;
}

static void rows_put(ride_log *log, ride_log_rows *rows, ride_log_header *header)
{
    header->type = RIDE_LOG_DATA;
    header->t0_us = rows->t0_us;
    header->n = rows->rows;
    header->schema_id = RIDE_LOG_SCHEMA_ID;
    header->length = (uint16_t)(rows->rows * RIDE_LOG_ROW_BYTES);
    memcpy(log->page + RIDE_LOG_AT_PAYLOAD, rows->payload, header->length);
    rows->rows = 0;
}

/* Puts the most urgent block into the page. False where there is none to write now. */
static int block_choose(ride_log *log, const config_store *config, const hal *board,
                        uint64_t now_us, ride_log_header *header)
{
    uint8_t *payload = log->page + RIDE_LOG_AT_PAYLOAD;

    if (log->unix_offset_us == 0) log->due &= (uint8_t)~DUE_SYNC;
    if (log->due & DUE_CONFIG) {
        ride_log_config_put(payload, config, board, header);
        log->config_generation = config->generation;
        log->due = (uint8_t)((log->due & ~DUE_CONFIG) | DUE_CONFIG_REST);
    } else if (log->due & DUE_CONFIG_REST) {
        ride_log_config_rest_put(payload, config, header);
        log->due &= (uint8_t)~DUE_CONFIG_REST;
    } else if (log->due & DUE_SCHEMA) {
        ride_log_schema_put(payload, header);
        log->due &= (uint8_t)~DUE_SCHEMA;
    } else if (log->due & DUE_SYNC) {
        ride_log_sync_put(payload, now_us + log->unix_offset_us, header);
        log->due &= (uint8_t)~DUE_SYNC;
    } else if (log->event_count > 0 && (now_us >= log->events_us || log->state == CLOSING)) {
        ride_log_events_put(payload, log->events, log->event_count, header);
        log->event_count = 0;
        log->events_us = now_us + EVENTS_PERIOD_US;
    } else if (log->full.rows > 0) {
        rows_put(log, &log->full, header);
    } else if (log->filling.rows == ROWS_PER_BLOCK ||
               (log->state == CLOSING && log->filling.rows > 0)) {
        rows_put(log, &log->filling, header);
    } else if (log->state == CLOSING) {
        header->t0_us = log->store.logs[log->place].t1_us;
        ride_log_end_put(payload, &log->totals, header);
    } else {
        return 0;
    }
    return 1;
}

/* Seals the page and begins to program it. */
static void block_write(ride_log *log, const hal *board, ride_log_header *header)
{
    ride_log_entry *entry = &log->store.logs[log->place];
    size_t address = ride_log_store_address(&log->store, board, log->block, log->seq);
    uint32_t crc32;

    header->log_id = entry->id;
    header->boot_id = board->boot_id;
    header->seq = log->seq;
    crc32 = ride_log_block_seal(log->page, header);
    if (log->seq == 0) entry->generation = crc32;
    if (board->log_program(board->log_context, address, log->page, sizeof log->page) < 0) {
        if (header->type == RIDE_LOG_DATA) log->totals.rows_lost += header->n;
        log->due |= DUE_CONFIG | DUE_SCHEMA;
    } else if (header->type == RIDE_LOG_DATA) {
        log->totals.rows_written += header->n;
        entry->t1_us = header->t0_us + (uint64_t)header->n * ride_log_row_period_us();
    }
    log->seq++;
    entry->pages = log->seq;
}

/* Half the flash, so that the log of a long day pushes out older logs and not its own beginning. */
static uint32_t pages_max(const ride_log *log)
{
    return (uint32_t)log->store.blocks / 2u * log->store.pages_per_block;
}

static void repeat_check(ride_log *log, const config_store *config, uint64_t now_us)
{
    if (now_us >= log->repeat_us) {
        log->repeat_us = now_us + REPEAT_US;
        log->due |= DUE_ALL;
    }
    if (config->generation != log->config_generation) log->due |= DUE_CONFIG;
    if (log->state == RECORDING && log->seq + 4u >= pages_max(log)) {
        log->state = CLOSING;
        log->totals.reason = REASON_FULL;
    }
}

static void log_write(ride_log *log, const hal *board, const config_store *config,
                      event_log *events, unit_link *link, uint64_t now_us)
{
    ride_log_header header = {0};

    if (log->state == STARTING) {
        if (log->spare_state != SPARE_READY) return;
        if (ride_log_store_free_place(&log->store) == RIDE_LOG_NONE) {
            log->spare_state = SPARE_NONE;
            return;
        }
        log_begin(log, board);
        log->repeat_us = now_us + REPEAT_US;
    }
    repeat_check(log, config, now_us);
    if (log->seq % log->store.pages_per_block == 0 && log->spare_state != SPARE_READY) {
        /* What is left, its END included, has no place any more. */
        if (log->no_room) log_end(log, events, link, now_us);
        return;
    }
    header.t0_us = log->seq == 0 ? log->store.logs[log->place].t0_us : now_us;
    if (!block_choose(log, config, board, now_us, &header)) return;
    if (log->seq % log->store.pages_per_block == 0) block_take(log);
    block_write(log, board, &header);
    if (header.type == RIDE_LOG_END) log_end(log, events, link, now_us);
}

void ride_log_poll(ride_log *log, const hal *board, const config_store *config, event_log *events,
                   unit_link *link)
{
    uint64_t now_us = board->now_us(board->context);

    if (log->store.blocks == 0 || board->log_busy(board->log_context)) return;
    if (log->spare_state == SPARE_ERASING) spare_finish(log, events, link, now_us);
    if (log->state == IDLE) return;
    log_write(log, board, config, events, link, now_us);
    if (log->state == IDLE || log->no_room) return;
    if (log->spare_state == SPARE_NONE && !board->log_busy(board->log_context)) {
        spare_begin(log, board, now_us);
    }
}
