/* What time it is: the unit's, the host's and the world's. */
#include "dispatch.h"     // reply_ok, reply_with
#include "ebl_bytes.h"    // EBL_OK
#include "ebl_registry.h" // ebl_tim_sync_request_get

static uint64_t now(const app *unit) { return unit->board->now_us(unit->board->context); }

static void sync(app *unit, const ebl_header *request, reply *answer)
{
    ebl_tim_sync_request asked;
    ebl_tim_sync_response response;
    size_t length = 0;
    int put;

    response.heard_us = now(unit);
    if (ebl_tim_sync_request_get(&asked, request->payload, request->payload_length) != EBL_OK) {
        reply_refuse(answer, EBL_STATUS_LENGTH, EBL_TIM_SYNC_REQUEST_LENGTH);
        return;
    }
    response.host_us = asked.host_us;
    response.answered_us = now(unit);
    response.unix_us = unit->unix_offset_us != 0 ? response.answered_us + unit->unix_offset_us : 0;
    put =
        ebl_tim_sync_response_put(&response, reply_fields(answer), reply_capacity(answer), &length);
    reply_with(answer, put, length);
}

static void set(app *unit, const ebl_header *request, reply *answer)
{
    ebl_tim_set_request asked;

    if (ebl_tim_set_request_get(&asked, request->payload, request->payload_length) != EBL_OK) {
        reply_refuse(answer, EBL_STATUS_LENGTH, EBL_TIM_SET_REQUEST_LENGTH);
        return;
    }
    if (asked.unix_us <= now(unit)) {
        /* Before 1970 the unit cannot have been switched on. */
        reply_refuse(answer, EBL_STATUS_RANGE, 0);
        return;
    }
    unit->unix_offset_us = asked.unix_us - now(unit);
    ride_log_clock_set(&unit->ride_log, unit->unix_offset_us);
    reply_ok(answer);
}

request_handler requests_time(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_TIM_SYNC: return sync;
    case EBL_MSG_TIM_SET: return set;
    default: return NULL;
    }
}
