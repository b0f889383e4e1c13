#include "dispatch.h"

#include <string.h>

#include "ebl_bytes.h" // ebl_put_u16, EBL_OK

#define STATUS_LENGTH 1
#define REFUSAL_LENGTH 3 /* status u8, detail u16 */
#define REFUSAL_BYTES 4  /* of one violation: id u16, index u8, code u8 */
#define BOARD_MESSAGE_FIRST 0x7000
#define LATE_ANSWER_LENGTH_MAX 8

void reply_ok(reply *answer)
{
    answer->bytes[0] = EBL_STATUS_OK;
    answer->length = STATUS_LENGTH;
}

void reply_refuse(reply *answer, uint8_t status, uint16_t detail)
{
    answer->bytes[0] = status;
    ebl_put_u16(answer->bytes + STATUS_LENGTH, detail);
    answer->length = REFUSAL_LENGTH;
}

void reply_status(reply *answer, uint8_t status, uint16_t detail)
{
    if (status == EBL_STATUS_OK) {
        reply_ok(answer);
    } else {
        reply_refuse(answer, status, detail);
    }
}

void reply_with(reply *answer, size_t length)
{
    answer->bytes[0] = EBL_STATUS_OK;
    answer->length = STATUS_LENGTH + length;
}

void reply_message(reply *answer, const uint8_t *layout, const void *message)
{
    size_t length;

    if (ebl_layout_put(layout, message, reply_fields(answer), reply_capacity(answer), &length) ==
        EBL_OK) {
        reply_with(answer, length);
    } else {
        reply_refuse(answer, EBL_STATUS_INTERNAL, 0);
    }
}

int request_read(const ebl_header *request, reply *answer, const uint8_t *layout, void *message)
{
    if (ebl_layout_get(layout, message, request->payload, request->payload_length) == EBL_OK) {
        return 1;
    }
    reply_refuse(answer, EBL_STATUS_LENGTH, layout[EBL_SHORTEST]);
    return 0;
}

uint8_t *reply_fields(const reply *answer) { return answer->bytes + STATUS_LENGTH; }

size_t reply_capacity(const reply *answer) { return answer->capacity - STATUS_LENGTH; }

void reply_refusals(reply *answer, const ebl_refusal *found, uint16_t detail)
{
    size_t count = detail < REFUSALS_MAX ? detail : REFUSALS_MAX;

    reply_refuse(answer, EBL_STATUS_INVALID_CONFIG, detail);
    for (size_t i = 0; i < count && answer->length + REFUSAL_BYTES <= answer->capacity; i++) {
        uint8_t *bytes = answer->bytes + answer->length;

        ebl_put_u16(bytes, found[i].id);
        bytes[2] = found[i].index;
        bytes[3] = found[i].code;
        answer->length += REFUSAL_BYTES;
    }
}

/* What a board gives with a refusal are its words for it: they follow the detail, as far as they
 * fit. */
static void board_refuse(reply *answer, uint8_t status, size_t length)
{
    size_t room = answer->capacity - REFUSAL_LENGTH;

    if (length > room) length = room;
    memmove(answer->bytes + REFUSAL_LENGTH, reply_fields(answer), length);
    reply_refuse(answer, status, 0);
    answer->length += length;
}

/* What the board says, as it says it; a board that writes more than it may is not believed. */
static void board_reply(app *unit, const ebl_header *request, reply *answer)
{
    const hal *board = unit->board;
    size_t length = 0;
    int status;

    if (board->board_request == NULL) {
        reply_refuse(answer, EBL_STATUS_UNKNOWN_MSG, request->word);
        return;
    }
    status = board->board_request(board->context, request->word, request->payload,
                                  request->payload_length, reply_fields(answer),
                                  reply_capacity(answer), &length);
    if (status > EBL_STATUS_OK && status <= UINT8_MAX) {
        board_refuse(answer, (uint8_t)status, length);
    } else if (status == EBL_STATUS_OK && length <= reply_capacity(answer)) {
        reply_with(answer, length);
    } else {
        reply_refuse(answer, EBL_STATUS_INTERNAL, 0);
    }
}

static void request_execute(app *unit, const ebl_header *request, reply *answer)
{
    request_handler handler = requests_system(request->word);

    if (handler == NULL) handler = requests_line(request->word);
    if (handler == NULL) handler = requests_config(request->word);
    if (handler == NULL) handler = requests_trial(request->word);
    if (handler == NULL) handler = requests_unlock(request->word);
    if (handler == NULL) handler = requests_stream(request->word);
    if (handler == NULL) handler = requests_faults(request->word);
    if (handler == NULL) handler = requests_time(request->word);
    if (handler == NULL) handler = requests_log(unit, request->word);
    if (handler != NULL) {
        handler(unit, request, answer);
    } else if (request->word >= BOARD_MESSAGE_FIRST) {
        board_reply(unit, request, answer);
    } else {
        reply_refuse(answer, EBL_STATUS_UNKNOWN_MSG, request->word);
    }
}

/* A retry differs from its original in one header bit. */
static uint32_t request_crc(const uint8_t *frame, size_t length)
{
    uint8_t first = (uint8_t)(frame[0] & ~EBL_FLAG_RETRANSMIT);

    return ebl_crc32(ebl_crc32(0, &first, 1), frame + 1, length - 1);
}

static answered_request *answered_find(app *unit, uint8_t tid, uint32_t crc32)
{
    for (size_t i = 0; i < EBL_MAX_OUTSTANDING; i++) {
        answered_request *answered = &unit->answered[i];

        if (answered->tid == tid && answered->request_crc32 == crc32) return answered;
    }
    return NULL;
}

/* Whether the frame asks again for this answer: it says so, or it came before the answer could have
 * left, so that it is the line that doubled it. Anything else is a new request under a number that
 * is used again, and what was answered before is old. */
static int is_repetition(const ebl_header *request, const answered_request *answered)
{
    return (request->flags & EBL_FLAG_RETRANSMIT) || answered->new;
}

static answered_request *answered_take_oldest(app *unit)
{
    answered_request *answered = &unit->answered[unit->answered_next];

    unit->answered_next = (uint8_t)((unit->answered_next + 1) % EBL_MAX_OUTSTANDING);
    answered->tid = 0;
    return answered;
}

/* Executes a request once and remembers the response. */
static answered_request *request_answer(app *unit, const ebl_header *request, int readable,
                                        uint32_t crc32)
{
    answered_request *answered = answered_take_oldest(unit);
    reply answer = {answered->frame + EBL_HEADER_LENGTH, 0, 0};

    answer.capacity = (size_t)(unit->tx_mtu - EBL_HEADER_LENGTH - EBL_CHECK_LENGTH);
    if (readable == EBL_ERROR_VERSION) {
        reply_refuse(&answer, EBL_STATUS_VERSION, EBL_MAJOR);
    } else if (request->flags & EBL_FLAG_MORE) {
        reply_refuse(&answer, EBL_STATUS_UNSUPPORTED, 0);
    } else {
        request_execute(unit, request, &answer);
    }
    ebl_header_put(answered->frame, EBL_KIND_RESPONSE, 0, request->tag, request->word);
    answered->tid = request->tag;
    answered->new = 1;
    answered->request_crc32 = crc32;
    answered->length = (uint16_t)(EBL_HEADER_LENGTH + answer.length);
    return answered;
}

void dispatch_answer_later(app *unit, uint8_t tid, uint16_t message_id, const reply *answer)
{
    uint8_t frame[EBL_HEADER_LENGTH + LATE_ANSWER_LENGTH_MAX];
    size_t length = EBL_HEADER_LENGTH + answer->length;

    if (answer->length > LATE_ANSWER_LENGTH_MAX) return;
    ebl_header_put(frame, EBL_KIND_RESPONSE, 0, tid, message_id);
    memcpy(frame + EBL_HEADER_LENGTH, answer->bytes, answer->length);
    for (size_t i = 0; i < EBL_MAX_OUTSTANDING; i++) {
        answered_request *answered = &unit->answered[i];

        if (answered->tid != tid || memcmp(answered->frame, frame, EBL_HEADER_LENGTH) != 0 ||
            answered->frame[EBL_HEADER_LENGTH] != EBL_STATUS_PENDING) {
            continue;
        }
        memcpy(answered->frame, frame, length);
        answered->length = (uint16_t)length;
    }
    (void)link_send(&unit->link, LINK_RESPONSE, frame, length);
}

void dispatch_answers_left(app *unit)
{
    for (size_t i = 0; i < EBL_MAX_OUTSTANDING; i++) unit->answered[i].new = 0;
}

void dispatch_forget(app *unit, uint16_t message_id)
{
    for (size_t i = 0; i < EBL_MAX_OUTSTANDING; i++) {
        answered_request *answered = &unit->answered[i];
        ebl_header header;

        if (answered->tid == 0) continue;
        if (ebl_header_get(&header, answered->frame, answered->length) != EBL_OK) continue;
        if (header.word == message_id) answered->tid = 0;
    }
}

static int is_acknowledgement(const ebl_header *request)
{
    return (request->word == EBL_MSG_LOG_ACK || request->word == EBL_MSG_EVT_ACK) &&
           request->flags == 0;
}

/* The requests that may ask for no answer. They change nothing when they are heard twice, so they
 * take no place among the answers that are kept. */
static void acknowledgement(app *unit, const ebl_header *request)
{
    uint8_t frame[EBL_HEADER_LENGTH + LATE_ANSWER_LENGTH_MAX];
    reply answer = {frame + EBL_HEADER_LENGTH, LATE_ANSWER_LENGTH_MAX, 0};

    request_execute(unit, request, &answer);
    if (request->tag == 0) return;
    ebl_header_put(frame, EBL_KIND_RESPONSE, 0, request->tag, request->word);
    (void)link_send(&unit->link, LINK_RESPONSE, frame, EBL_HEADER_LENGTH + answer.length);
}

void dispatch_frame(app *unit, const uint8_t *frame, size_t length)
{
    ebl_header request;
    int readable = ebl_header_get(&request, frame, length);
    answered_request *answered;
    uint32_t crc32;

    if (readable != EBL_OK && readable != EBL_ERROR_VERSION) return;
    if (request.kind != EBL_KIND_REQUEST) return;
    line_rate_heard(&unit->line, unit->board->now_us(unit->board->context));
    if (readable == EBL_OK && is_acknowledgement(&request)) {
        acknowledgement(unit, &request);
        return;
    }
    /* tid 0 belongs to no request, so an answer to it could not be matched. */
    if (request.tag == 0) return;
    crc32 = request_crc(frame, length);
    answered = answered_find(unit, request.tag, crc32);
    if (answered != NULL && !is_repetition(&request, answered)) {
        answered->tid = 0;
        answered = NULL;
    }
    if (answered == NULL) answered = request_answer(unit, &request, readable, crc32);
    (void)link_send(&unit->link, LINK_RESPONSE, answered->frame, answered->length);
}
