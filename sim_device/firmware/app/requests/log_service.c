/* What the host asks about ride logs. */
#include <string.h>

#include "dispatch.h"     // dispatch_answer_later
#include "reply.h"        // reply_ok, reply_message, request_read
#include "services.h"     // request_handler
#include "ebl_bytes.h"    // ebl_put_u32
#include "ebl_registry.h" // ebl_log_list_request

#define ENTRY_LENGTH 40

/* What LOG_CRC and LOG_CONFIRM are told to expect: 2 ms for each of the check's pieces. */
#define CHECK_BYTES_PER_MS 1024u
#define CHECK_MS_MIN 10u
#define ERASE_S 1 /* a block takes less */

static void entry_put(const ride_log_store *store, uint8_t place, uint8_t *bytes)
{
    const ride_log_entry *log = &store->logs[place];

    memset(bytes, 0, ENTRY_LENGTH);
    ebl_put_u32(bytes, log->id);
    ebl_put_u32(bytes + 4, log->generation);
    ebl_put_u32(bytes + 8, log->boot_id);
    ebl_put_u64(bytes + 12, log->t0_us);
    ebl_put_u64(bytes + 20, log->t1_us);
    ebl_put_u32(bytes + 28, ride_log_store_length(store, place));
    bytes[32] = log->flags;
}

/* The entries follow the fields where they are sent from. */
static void list(app *unit, const ebl_header *request, reply *answer)
{
    const ride_log_store *store = &unit->ride_log.store;
    size_t room = (reply_capacity(answer) - EBL_LOG_LIST_RESPONSE_LENGTH) / ENTRY_LENGTH;
    ebl_log_list_request asked;
    ebl_log_list_response response = {0};
    size_t count = 0;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_log_list_request, &asked))) return;
    if (asked.count < room) room = asked.count;
    response.total = ride_log_store_count(store);
    response.overwritten = store->overwritten;
    response.boot_id = unit->board->boot_id;
    response.now_us = unit_now_us(unit);
    reply_message(answer, EBL_MESSAGE(ebl_log_list_response, &response));
    while (count < room && asked.start + count < response.total) {
        uint8_t place = ride_log_store_by_age(store, (uint16_t)(asked.start + count));

        entry_put(store, place, answer->bytes + answer->length);
        answer->length += ENTRY_LENGTH;
        count++;
    }
}

/* The place of a log that is not being recorded; refuses otherwise. */
static int find(const app *unit, uint32_t log_id, uint32_t generation, uint8_t *place,
                reply *answer)
{
    const ride_log_store *store = &unit->ride_log.store;

    *place = ride_log_store_find(store, log_id, generation);
    if (*place == RIDE_LOG_NONE) {
        reply_refuse(answer, EBL_STATUS_NOT_FOUND, (uint16_t)log_id);
    } else if (store->logs[*place].flags & EBL_LOG_RECORDING) {
        reply_refuse(answer, EBL_STATUS_STATE, (uint16_t)log_id);
    } else {
        return 1;
    }
    return 0;
}

/* Whether the log's first block is being erased, or is about to be. */
static int is_going(const app *unit, uint8_t place)
{
    const ride_log_check *check = &unit->log_check;

    return unit->ride_log.victim == place ||
           (check->tid != 0 && check->message_id == EBL_MSG_LOG_ERASE && check->place == place);
}

static void open(app *unit, const ebl_header *request, reply *answer)
{
    const ride_log_store *store = &unit->ride_log.store;
    ebl_log_open_request asked;
    ebl_log_open_response response;
    uint8_t place;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_log_open_request, &asked))) return;
    if (!find(unit, asked.log_id, asked.generation, &place, answer)) return;
    if (is_going(unit, place)) {
        reply_refuse(answer, EBL_STATUS_BUSY, ERASE_S);
        return;
    }
    response.length = ride_log_store_length(store, place);
    response.chunk = ride_log_bulk_chunk(unit->tx_mtu);
    response.window =
        asked.window < RIDE_LOG_WINDOW_MAX ? asked.window : (uint8_t)RIDE_LOG_WINDOW_MAX;
    if (asked.session == 0 || asked.session > EBL_BULK_SESSION_MAX || asked.window == 0 ||
        asked.offset > response.length || asked.offset % response.chunk != 0) {
        reply_refuse(answer, EBL_STATUS_RANGE, response.chunk);
        return;
    }
    ride_log_bulk_open(&unit->bulk, store, place, asked.offset, response.chunk, response.window,
                       asked.session, unit_now_us(unit));
    reply_message(answer, EBL_MESSAGE(ebl_log_open_response, &response));
}

static void acknowledge(app *unit, const ebl_header *request, reply *answer)
{
    ebl_log_ack_request asked;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_log_ack_request, &asked))) return;
    if (unit->bulk.session == 0 || asked.session != unit->bulk.session) {
        reply_refuse(answer, EBL_STATUS_NOT_FOUND, asked.session);
    } else if (!ride_log_bulk_ack(&unit->bulk, asked.base, asked.bitmap, unit_now_us(unit))) {
        reply_refuse(answer, EBL_STATUS_RANGE, asked.session);
    } else {
        reply_ok(answer);
    }
}

static void close(app *unit, const ebl_header *request, reply *answer)
{
    ebl_log_close_request asked;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_log_close_request, &asked))) return;
    if (asked.session == unit->bulk.session) ride_log_bulk_end(&unit->bulk);
    reply_ok(answer);
}

/* Begins a check of [offset, offset + length) and asks for patience. */
static void check_begin(app *unit, const ebl_header *request, uint8_t place, uint32_t offset,
                        uint32_t length, reply *answer)
{
    ride_log_check *check = &unit->log_check;
    uint32_t whole = ride_log_store_length(&unit->ride_log.store, place);
    uint32_t wait_ms = length / CHECK_BYTES_PER_MS + CHECK_MS_MIN;

    if (offset > whole || length > whole - offset) {
        reply_refuse(answer, EBL_STATUS_RANGE, (uint16_t)(whole / RIDE_LOG_PAGE_BYTES));
        return;
    }
    if (check->tid != 0) {
        reply_refuse(answer, EBL_STATUS_BUSY, 1);
        return;
    }
    check->tid = request->tag;
    check->message_id = request->word;
    check->place = place;
    check->log_id = unit->ride_log.store.logs[place].id;
    check->offset = offset;
    check->end = offset + length;
    check->crc32 = 0;
    reply_refuse(answer, EBL_STATUS_PENDING, (uint16_t)wait_ms);
}

static void crc(app *unit, const ebl_header *request, reply *answer)
{
    ebl_log_crc_request asked;
    uint8_t place;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_log_crc_request, &asked))) return;
    if (!find(unit, asked.log_id, asked.generation, &place, answer)) return;
    check_begin(unit, request, place, asked.offset, asked.length, answer);
}

static void confirm(app *unit, const ebl_header *request, reply *answer)
{
    ebl_log_confirm_request asked;
    uint8_t place;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_log_confirm_request, &asked))) return;
    if (!find(unit, asked.log_id, asked.generation, &place, answer)) return;
    if (unit->ride_log.store.logs[place].flags & EBL_LOG_CONFIRMED) {
        reply_ok(answer);
        return;
    }
    if (asked.length != ride_log_store_length(&unit->ride_log.store, place)) {
        reply_refuse(answer, EBL_STATUS_RANGE, (uint16_t)asked.length);
        return;
    }
    unit->log_check.expected = asked.crc32;
    check_begin(unit, request, place, 0, asked.length, answer);
}

static void erase(app *unit, const ebl_header *request, reply *answer)
{
    ebl_log_erase_request asked;
    uint16_t fetched_s;
    uint8_t place;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_log_erase_request, &asked))) return;
    if (!find(unit, asked.log_id, asked.generation, &place, answer)) return;
    if (!(unit->ride_log.store.logs[place].flags & EBL_LOG_CONFIRMED)) {
        reply_refuse(answer, EBL_STATUS_STATE, (uint16_t)asked.log_id);
        return;
    }
    fetched_s =
        place == unit->bulk.place ? ride_log_bulk_left_s(&unit->bulk, unit_now_us(unit)) : 0;
    if (fetched_s != 0) {
        reply_refuse(answer, EBL_STATUS_BUSY, fetched_s);
        return;
    }
    check_begin(unit, request, place, 0, 0, answer);
}

/* Frees the log. Its first block is erased, so that no boot finds it. */
static void erase_answer(app *unit, reply *answer)
{
    ride_log_store *store = &unit->ride_log.store;
    uint8_t place = unit->log_check.place;
    ebl_log_erase_response response;

    if (ride_log_store_erase(store, unit->board, store->logs[place].first_block) < 0) {
        reply_refuse(answer, EBL_STATUS_FLASH_FAIL, 0);
        return;
    }
    ride_log_store_release(store, place);
    response.erases = unit->counters.log_erases + store->erases;
    reply_message(answer, EBL_MESSAGE(ebl_log_erase_response, &response));
}

/* What the host is told once the check value is known. */
static void check_answer(app *unit, reply *answer)
{
    ride_log_check *check = &unit->log_check;
    ebl_log_crc_response response = {check->crc32};

    if (check->message_id == EBL_MSG_LOG_CRC) {
        reply_message(answer, EBL_MESSAGE(ebl_log_crc_response, &response));
    } else if (check->message_id == EBL_MSG_LOG_ERASE) {
        erase_answer(unit, answer);
    } else if (check->crc32 != check->expected) {
        reply_refuse(answer, EBL_STATUS_CRC_MISMATCH, (uint16_t)check->crc32);
    } else if (ride_log_store_confirm(&unit->ride_log.store, unit->board, check->place) < 0) {
        reply_refuse(answer, EBL_STATUS_FLASH_FAIL, 0);
    } else {
        reply_ok(answer);
    }
}

/* Neither at work nor about to give up the very log. */
static int flash_is_free(const app *unit)
{
    return !unit->board->log_busy(unit->board->log_context) &&
           unit->ride_log.victim != unit->log_check.place;
}

void requests_log_poll(app *unit)
{
    ride_log_check *check = &unit->log_check;
    uint8_t bytes[EBL_LOG_CRC_RESPONSE_LENGTH + 1];
    reply answer = {bytes, sizeof bytes, 0};
    int state;

    ride_log_bulk_poll(&unit->bulk, &unit->ride_log.store, unit_now_us(unit));
    if (check->tid == 0) return;
    state = ride_log_check_poll(check, &unit->ride_log.store, unit->board);
    if (state == RIDE_LOG_CHECK_RUNNING) return;
    if (state == RIDE_LOG_CHECK_GONE) {
        reply_refuse(&answer, EBL_STATUS_NOT_FOUND, (uint16_t)check->log_id);
    } else if (check->message_id != EBL_MSG_LOG_CRC && !flash_is_free(unit)) {
        return;
    } else {
        check_answer(unit, &answer);
    }
    dispatch_answer_later(unit, check->tid, check->message_id, &answer);
    check->tid = 0;
}

size_t requests_log_bulk(void *context, uint8_t *frame, size_t capacity)
{
    app *unit = context;

    return ride_log_bulk_frame(&unit->bulk, &unit->ride_log.store, unit->board, frame, capacity);
}

/* Of a unit without memory for logs, whatever the request says. */
static void no_log(app *unit, const ebl_header *request, reply *answer)
{
    (void)unit;
    (void)request;
    reply_refuse(answer, EBL_STATUS_UNSUPPORTED, 0);
}

static request_handler handler_of(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_LOG_LIST: return list;
    case EBL_MSG_LOG_OPEN: return open;
    case EBL_MSG_LOG_ACK: return acknowledge;
    case EBL_MSG_LOG_CLOSE: return close;
    case EBL_MSG_LOG_CRC: return crc;
    case EBL_MSG_LOG_CONFIRM: return confirm;
    case EBL_MSG_LOG_ERASE: return erase;
    default: return NULL;
    }
}

request_handler requests_log(const app *unit, uint16_t message_id)
{
    request_handler handler = handler_of(message_id);

    return handler != NULL && unit->ride_log.store.blocks == 0 ? no_log : handler;
}
