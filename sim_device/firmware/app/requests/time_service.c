/* What time it is: the unit's, the host's and the world's. */
#include "reply.h"        // reply_ok, reply_message, request_read
#include "services.h"     // request_handler
#include "ebl_registry.h" // ebl_tim_sync_request

static void sync(app *unit, const ebl_header *request, reply *answer)
{
    ebl_tim_sync_request asked;
    ebl_tim_sync_response response;

    response.heard_us = unit_now_us(unit);
    if (!request_read(request, answer, EBL_MESSAGE(ebl_tim_sync_request, &asked))) return;
    response.host_us = asked.host_us;
    response.answered_us = unit_now_us(unit);
    response.unix_us = unit->unix_offset_us != 0 ? response.answered_us + unit->unix_offset_us : 0;
    reply_message(answer, EBL_MESSAGE(ebl_tim_sync_response, &response));
}

static void set(app *unit, const ebl_header *request, reply *answer)
{
    ebl_tim_set_request asked;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_tim_set_request, &asked))) return;
    if (asked.unix_us <= unit_now_us(unit)) {
        /* Before 1970 the unit cannot have been switched on. */
        reply_refuse(answer, EBL_STATUS_RANGE, 0);
        return;
    }
    unit->unix_offset_us = asked.unix_us - unit_now_us(unit);
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
