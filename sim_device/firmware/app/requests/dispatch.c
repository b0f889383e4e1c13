#include "dispatch.h"

#include <string.h>

#include "ebl_bytes.h" // EBL_OK
#include "services.h"  // request_handler, requests_system

#define LATE_ANSWER_LENGTH_MAX 8

static request_handler handler_of(const app *unit, uint16_t message_id)
{
    request_handler handler = requests_system(message_id);

    if (handler == NULL) handler = requests_line(message_id);
    if (handler == NULL) handler = requests_config(message_id);
    if (handler == NULL) handler = requests_trial(message_id);
    if (handler == NULL) handler = requests_unlock(message_id);
    if (handler == NULL) handler = requests_stream(message_id);
    if (handler == NULL) handler = requests_faults(message_id);
    if (handler == NULL) handler = requests_time(message_id);
    if (handler == NULL) handler = requests_log(unit, message_id);
    if (handler == NULL) handler = requests_board(unit, message_id);
    return handler;
}

static void request_execute(app *unit, const ebl_header *request, reply *answer)
{
    request_handler handler = handler_of(unit, request->word);

    if (handler != NULL) {
        handler(unit, request, answer);
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
    baud_rate_heard(&unit->baud_rate, unit_now_us(unit));
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
