/* What the host asks of the line itself: another rate, whether it is still the same unit, and what
 * it has heard. */
#include "reply.h"        // reply_refuse, reply_message, request_read
#include "services.h"     // request_handler
#include "ebl_registry.h" // ebl_set_baud_request

static void set_baud(app *unit, const ebl_header *request, reply *answer)
{
    ebl_set_baud_request asked;
    ebl_set_baud_response response = {BAUD_RATE_SWITCH_MS, BAUD_RATE_PROVE_MS};
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_set_baud_request, &asked))) return;
    status = baud_rate_check(&unit->baud_rate, unit->board, asked.bits_per_second, &detail);
    if (status == EBL_STATUS_OK && !telemetry_fits(&unit->telemetry, asked.bits_per_second)) {
        status = EBL_STATUS_BANDWIDTH;
    }
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    baud_rate_begin(&unit->baud_rate, unit->board, asked.bits_per_second);
    reply_message(answer, EBL_MESSAGE(ebl_set_baud_response, &response));
}

static void alive(app *unit, const ebl_header *request, reply *answer)
{
    const hal *board = unit->board;
    ebl_alive_response response = {
        board->boot_id,     unit->session_id,        board->now_us(board->context),
        board->serial_baud, unit->events.kept_count, unit->events.pushed_out};

    (void)request;
    reply_message(answer, EBL_MESSAGE(ebl_alive_response, &response));
}

static void event_acknowledge(app *unit, const ebl_header *request, reply *answer)
{
    ebl_evt_ack_request asked;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_evt_ack_request, &asked))) return;
    events_acknowledge(&unit->events, asked.seq);
    reply_ok(answer);
}

request_handler requests_line(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_SET_BAUD: return set_baud;
    case EBL_MSG_ALIVE: return alive;
    case EBL_MSG_EVT_ACK: return event_acknowledge;
    default: return NULL;
    }
}
