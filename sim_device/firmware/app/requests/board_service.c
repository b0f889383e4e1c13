/* What the host asks the board itself, in its own messages. */
#include <string.h>

#include "ebl_registry.h" // EBL_STATUS_INTERNAL
#include "reply.h"        // reply_refuse, reply_with
#include "services.h"     // request_handler

#define BOARD_MESSAGE_FIRST 0x7000

/* What a board gives with a refusal are its words for it: they follow the detail, as far as they
 * fit. */
static void board_refuse(reply *answer, uint8_t status, size_t length)
{
    size_t room = answer->capacity - REPLY_REFUSAL_LENGTH;

    if (length > room) length = room;
    memmove(answer->bytes + REPLY_REFUSAL_LENGTH, reply_fields(answer), length);
    reply_refuse(answer, status, 0);
    answer->length += length;
}

/* What the board says, as it says it; a board that writes more than it may is not believed. */
static void board_reply(app *unit, const ebl_header *request, reply *answer)
{
    const hal *board = unit->board;
    size_t length = 0;
    int status = board->board_request(board->context, request->word, request->payload,
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

request_handler requests_board(const app *unit, uint16_t message_id)
{
    if (message_id < BOARD_MESSAGE_FIRST || unit->board->board_request == NULL) return NULL;
    return board_reply;
}
