/* What the host asks about telemetry. */
#include "line/stream_budget.h" // stream_budget_bytes_per_s
#include "reply.h"              // reply_message, request_read
#include "services.h"           // request_handler
#include "ebl_bytes.h"          // ebl_put_u32
#include "ebl_registry.h"       // ebl_str_subscribe_request

#define ENTRY_LENGTH 14 /* of one stream in STR_LIST */
#define US_PER_MS 1000u

static void subscribe(app *unit, const ebl_header *request, reply *answer)
{
    ebl_str_subscribe_request asked;
    ebl_str_subscribe_response response;
    telemetry_line line = {unit->tx_mtu, baud_rate_for_streams(&unit->baud_rate, unit->board)};
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_str_subscribe_request, &asked))) return;
    status =
        telemetry_subscribe(&unit->telemetry, &asked, &line, unit_now_us(unit), &response, &detail);
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    reply_message(answer, EBL_MESSAGE(ebl_str_subscribe_response, &response));
}

static void unsubscribe(app *unit, const ebl_header *request, reply *answer)
{
    ebl_str_unsubscribe_request asked;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_str_unsubscribe_request, &asked))) return;
    status = telemetry_unsubscribe(&unit->telemetry, &unit->events, &unit->link, unit_now_us(unit),
                                   asked.stream_id);
    reply_status(answer, status, asked.stream_id);
}

static void renew(app *unit, const ebl_header *request, reply *answer)
{
    ebl_str_renew_request asked;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_str_renew_request, &asked))) return;
    status = telemetry_renew(&unit->telemetry, asked.stream_id, asked.lease_s, unit_now_us(unit));
    reply_status(answer, status, asked.stream_id);
}

static void entry_put(uint8_t *bytes, const telemetry_stream *stream, uint64_t now_us)
{
    uint64_t left_us = stream->lease_end_us > now_us ? stream->lease_end_us - now_us : 0;

    bytes[0] = stream->stream_id;
    bytes[1] = stream->epoch;
    ebl_put_u16(bytes + 2, stream->divider);
    bytes[4] = stream->batch;
    bytes[5] = stream->channel_count;
    ebl_put_u32(bytes + 6, (uint32_t)(left_us / US_PER_MS));
    ebl_put_u32(bytes + 10, telemetry_bytes_per_s(stream));
}

static void list(app *unit, const ebl_header *request, reply *answer)
{
    uint8_t entries[TELEMETRY_STREAMS * ENTRY_LENGTH];
    ebl_str_list_response response = {0};

    (void)request;
    response.budget_bytes_per_s =
        stream_budget_bytes_per_s(baud_rate_for_streams(&unit->baud_rate, unit->board));
    response.entries = entries;
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        const telemetry_stream *stream = &unit->telemetry.streams[i];

        if (!stream->active) continue;
        entry_put(entries + response.entries_length, stream, unit_now_us(unit));
        response.entries_length += ENTRY_LENGTH;
    }
    reply_message(answer, EBL_MESSAGE(ebl_str_list_response, &response));
}

static void snapshot(app *unit, const ebl_header *request, reply *answer)
{
    uint8_t values[2 * EBL_CHANNEL_COUNT];
    ebl_str_snapshot_request asked;
    ebl_str_snapshot_response response;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_str_snapshot_request, &asked))) return;
    status = telemetry_snapshot(&unit->telemetry, asked.channel_ids, asked.channel_ids_length,
                                values, &detail);
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    response.t_us = unit->telemetry.row_us;
    response.values = values;
    response.values_length = 2 * asked.channel_ids_length;
    reply_message(answer, EBL_MESSAGE(ebl_str_snapshot_response, &response));
}

request_handler requests_stream(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_STR_SUBSCRIBE: return subscribe;
    case EBL_MSG_STR_UNSUBSCRIBE: return unsubscribe;
    case EBL_MSG_STR_RENEW: return renew;
    case EBL_MSG_STR_LIST: return list;
    case EBL_MSG_STR_SNAPSHOT: return snapshot;
    default: return NULL;
    }
}
