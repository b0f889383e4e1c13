#include "dispatch.h"

#include <string.h>

#include "ebl_bytes.h" // ebl_put_u16, EBL_OK

#define STATUS_LENGTH 1
#define REFUSAL_LENGTH 3 /* status u8, detail u16 */
#define BOARD_MESSAGE_FIRST 0x7000

void reply_ok(reply *reply)
{
    reply->bytes[0] = EBL_STATUS_OK;
    reply->length = STATUS_LENGTH;
}

void reply_refuse(reply *reply, uint8_t status, uint16_t detail)
{
    reply->bytes[0] = status;
    ebl_put_u16(reply->bytes + STATUS_LENGTH, detail);
    reply->length = REFUSAL_LENGTH;
}

void reply_status(reply *reply, uint8_t status, uint16_t detail)
{
    if (status == EBL_STATUS_OK) {
        reply_ok(reply);
    } else {
        reply_refuse(reply, status, detail);
    }
}

void reply_with(reply *reply, int put, size_t length)
{
    if (put != EBL_OK) {
        reply_refuse(reply, EBL_STATUS_INTERNAL, 0);
        return;
    }
    reply->bytes[0] = EBL_STATUS_OK;
    reply->length = STATUS_LENGTH + length;
}

uint8_t *reply_fields(const reply *reply)
{
    return reply->bytes + STATUS_LENGTH;
}

size_t reply_capacity(const reply *reply)
{
    return reply->capacity - STATUS_LENGTH;
}

/* What the board says, as it says it; a board that writes more than it may is not believed. */
static void board_reply(app *app, const ebl_header *request, reply *reply)
{
    const hal *hal = app->hal;
    size_t length = 0;
    int status;

    if (hal->board_request == NULL) {
        reply_refuse(reply, EBL_STATUS_UNKNOWN_MSG, request->word);
        return;
    }
    status = hal->board_request(hal->context, request->word, request->payload,
                                request->payload_length, reply_fields(reply),
                                reply_capacity(reply), &length);
    if (status < 0 || status > UINT8_MAX) {
        reply_refuse(reply, EBL_STATUS_INTERNAL, 0);
    } else if (status != EBL_STATUS_OK) {
        reply_refuse(reply, (uint8_t)status, 0);
    } else {
        reply_with(reply, length <= reply_capacity(reply) ? EBL_OK : EBL_ERROR_SPACE, length);
    }
}

static void request_execute(app *app, const ebl_header *request, reply *reply)
{
    request_handler handler = requests_system(request->word);

    if (handler == NULL) handler = requests_config(request->word);
    if (handler == NULL) handler = requests_stream(request->word);
    if (handler != NULL) {
        handler(app, request, reply);
    } else if (request->word >= BOARD_MESSAGE_FIRST) {
        board_reply(app, request, reply);
    } else {
        reply_refuse(reply, EBL_STATUS_UNKNOWN_MSG, request->word);
    }
}

/* A retry differs from its original in one header bit. */
static uint32_t request_crc(const uint8_t *frame, size_t length)
{
    uint8_t first = (uint8_t)(frame[0] & ~EBL_FLAG_RETRANSMIT);

    return ebl_crc32(ebl_crc32(0, &first, 1), frame + 1, length - 1);
}

static const answered_request *answered_find(const app *app, uint8_t tid, uint32_t crc32)
{
    for (size_t i = 0; i < EBL_MAX_OUTSTANDING; i++) {
        const answered_request *answered = &app->answered[i];

        if (answered->tid == tid && answered->request_crc32 == crc32) return answered;
    }
    return NULL;
}

static answered_request *answered_take_oldest(app *app)
{
    answered_request *answered = &app->answered[app->answered_next];

    app->answered_next = (uint8_t)((app->answered_next + 1) % EBL_MAX_OUTSTANDING);
    answered->tid = 0;
    return answered;
}

/* Executes a request once and remembers the response. */
static const answered_request *request_answer(app *app, const ebl_header *request, int readable,
                                              uint32_t crc32)
{
    answered_request *answered = answered_take_oldest(app);
    reply reply = {answered->frame + EBL_HEADER_LENGTH, 0, 0};

    reply.capacity = (size_t)(app->tx_mtu - EBL_HEADER_LENGTH - EBL_CHECK_LENGTH);
    if (readable == EBL_ERROR_VERSION) {
        reply_refuse(&reply, EBL_STATUS_VERSION, EBL_MAJOR);
    } else if (request->flags & EBL_FLAG_MORE) {
        reply_refuse(&reply, EBL_STATUS_UNSUPPORTED, 0);
    } else {
        request_execute(app, request, &reply);
    }
    ebl_header_put(answered->frame, EBL_KIND_RESPONSE, 0, request->tag, request->word);
    answered->tid = request->tag;
    answered->request_crc32 = crc32;
    answered->length = (uint16_t)(EBL_HEADER_LENGTH + reply.length);
    return answered;
}

void dispatch_frame(app *app, const uint8_t *frame, size_t length)
{
    ebl_header request;
    int readable = ebl_header_get(&request, frame, length);
    const answered_request *answered;
    uint32_t crc32;

    if (readable != EBL_OK && readable != EBL_ERROR_VERSION) return;
    /* tid 0 belongs to no request, so an answer to it could not be matched. */
    if (request.kind != EBL_KIND_REQUEST || request.tag == 0) return;
    crc32 = request_crc(frame, length);
    answered = answered_find(app, request.tag, crc32);
    if (answered == NULL) answered = request_answer(app, &request, readable, crc32);
    (void)link_send(&app->link, LINK_RESPONSE, answered->frame, answered->length);
}
