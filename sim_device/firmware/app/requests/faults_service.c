/* What the host asks about faults: which there are, and what the bike did when they came. */
#include "private/report.h" // report_faults_cleared
#include "permission.h"     // permission_to_write_flash
#include "reply.h"          // reply_refuse, reply_message, request_read
#include "services.h"       // request_handler
#include "ebl_bytes.h"      // ebl_put_i16
#include "ebl_registry.h"   // ebl_evt_fault_freeze_request

static void fault_list_get(app *unit, const ebl_header *request, reply *answer)
{
    ebl_evt_fault_list_response response = {unit->faults.active};

    (void)request;
    reply_message(answer, EBL_MESSAGE(ebl_evt_fault_list_response, &response));
}

static void freeze_get(app *unit, const ebl_header *request, reply *answer)
{
    uint8_t values[2 * EBL_CHANNEL_COUNT];
    ebl_evt_fault_freeze_request asked;
    ebl_evt_fault_freeze_response response;
    const fault_frame *frame;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_evt_fault_freeze_request, &asked))) return;
    if (asked.fault_bit >= FAULT_KINDS || unit->faults.frames[asked.fault_bit].count == 0) {
        reply_refuse(answer, EBL_STATUS_NOT_FOUND, asked.fault_bit);
        return;
    }
    frame = &unit->faults.frames[asked.fault_bit];
    for (size_t i = 0; i < EBL_CHANNEL_COUNT; i++) ebl_put_i16(values + 2 * i, frame->row[i]);
    response.active = unit->faults.active >> asked.fault_bit & 1u;
    response.count = frame->count;
    response.t_us = frame->t_us;
    response.values = values;
    response.values_length = sizeof values;
    reply_message(answer, EBL_MESSAGE(ebl_evt_fault_freeze_response, &response));
}

static void faults_clear_request(app *unit, const ebl_header *request, reply *answer)
{
    ebl_evt_fault_clear_request asked;
    ebl_evt_fault_clear_response response;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_evt_fault_clear_request, &asked))) return;
    if (permission_to_write_flash(unit) != EBL_STATUS_NOT_STOPPED) {
        uint32_t cleared = faults_clear_latched(&unit->faults, asked.fault_flags);

        if (cleared != 0) {
            report_faults_cleared(unit, cleared, unit_now_us(unit));
        }
    }
    faults_forget(&unit->faults, asked.fault_flags);
    response.fault_flags = unit->faults.active;
    reply_message(answer, EBL_MESSAGE(ebl_evt_fault_clear_response, &response));
}

request_handler requests_faults(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_EVT_FAULT_LIST: return fault_list_get;
    case EBL_MSG_EVT_FAULT_FREEZE: return freeze_get;
    case EBL_MSG_EVT_FAULT_CLEAR: return faults_clear_request;
    default: return NULL;
    }
}
