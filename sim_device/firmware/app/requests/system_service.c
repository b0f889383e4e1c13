/* Who the unit is, and whether it is there. */
#include <string.h>

#include "permission.h"   // permission_end
#include "reply.h"        // reply_ok, reply_message, request_read
#include "services.h"     // request_handler
#include "ebl_registry.h" // ebl_hello_request

#define MTU_MIN EBL_MTU_BEFORE_HELLO

static const uint16_t firmware_version[3] = {0, 6, 0};

static void log_session_end(app *unit)
{
    ride_log_bulk_end(&unit->bulk);
    unit->log_check.tid = 0;
}

/* The host that held streams and a transaction is not the one that says hello now. Its answered
 * requests go too: another host may number its own alike. */
static void session_start(app *unit)
{
    unit->session_id++;
    telemetry_end_all(&unit->telemetry);
    transaction_drop(&unit->config.transaction);
    permission_end(unit);
    log_session_end(unit);
    events_attend(&unit->events, 1, unit_now_us(unit));
    memset(unit->answered, 0, sizeof unit->answered);
}

static void hello_fill(const app *unit, ebl_hello_response *response)
{
    memset(response, 0, sizeof *response);
    response->major = EBL_MAJOR;
    response->minor = EBL_MINOR;
    response->device_class = unit->board->device_class;
    response->hardware_revision = unit->board->hardware_revision;
    memcpy(response->firmware_version, firmware_version, sizeof firmware_version);
    memcpy(response->uid, unit->board->uid, sizeof response->uid);
    response->boot_id = unit->board->boot_id;
    response->session_id = unit->session_id;
    memcpy(response->schema_hash, ebl_schema_hash, sizeof response->schema_hash);
    response->config_generation = unit->config.store.generation;
    response->config_crc32 = unit->config.store.crc32;
    response->rx_mtu = LINK_MTU;
    response->tx_mtu = unit->tx_mtu;
    response->max_outstanding = EBL_MAX_OUTSTANDING;
    response->access = EBL_ACCESS_DEALER;
    response->baud_bitmap = baud_rate_offered(unit->board);
    response->uptime_us = unit_now_us(unit);
}

static void hello(app *unit, const ebl_header *request, reply *answer)
{
    ebl_hello_request asked;
    ebl_hello_response response;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_hello_request, &asked))) return;
    if (asked.major_min > EBL_MAJOR || asked.major_max < EBL_MAJOR) {
        reply_refuse(answer, EBL_STATUS_VERSION, EBL_MAJOR);
        return;
    }
    if (asked.host_mtu < MTU_MIN) {
        reply_refuse(answer, EBL_STATUS_RANGE, MTU_MIN);
        return;
    }
    session_start(unit);
    unit->tx_mtu = asked.host_mtu < LINK_MTU ? asked.host_mtu : LINK_MTU;
    hello_fill(unit, &response);
    reply_message(answer, EBL_MESSAGE(ebl_hello_response, &response));
}

static void ping(app *unit, const ebl_header *request, reply *answer)
{
    (void)unit;
    (void)request;
    reply_ok(answer);
}

static void schema_read(app *unit, const ebl_header *request, reply *answer)
{
    ebl_schema_read_request asked;
    ebl_schema_read_response response;
    size_t room = reply_capacity(answer) - EBL_SCHEMA_READ_RESPONSE_LENGTH;

    (void)unit;
    if (!request_read(request, answer, EBL_MESSAGE(ebl_schema_read_request, &asked))) return;
    if (asked.offset > EBL_SCHEMA_LENGTH) {
        reply_refuse(answer, EBL_STATUS_RANGE, EBL_SCHEMA_LENGTH);
        return;
    }
    response.total_length = EBL_SCHEMA_LENGTH;
    response.data = ebl_schema + asked.offset;
    response.data_length = EBL_SCHEMA_LENGTH - asked.offset;
    if (response.data_length > asked.length) response.data_length = asked.length;
    if (response.data_length > room) response.data_length = room;
    reply_message(answer, EBL_MESSAGE(ebl_schema_read_response, &response));
}

static void stats(app *unit, const ebl_header *request, reply *answer)
{
    const ebl_counts *counts = &unit->link.decoder.counts;
    ebl_stats_response response = {counts->frames_ok, counts->crc_errors, counts->cobs_errors,
                                   counts->overflows, unit->link.dropped_tx};

    (void)request;
    reply_message(answer, EBL_MESSAGE(ebl_stats_response, &response));
}

static void counters_get(app *unit, const ebl_header *request, reply *answer)
{
    const counters *learned = &unit->counters;
    ebl_counters_response response = {learned->distance_m, learned->operating_s,
                                      learned->saved_distance_m, learned->saved_operating_s};

    (void)request;
    reply_message(answer, EBL_MESSAGE(ebl_counters_response, &response));
}

static void start_info(app *unit, const ebl_header *request, reply *answer)
{
    ebl_start_info_response response = {unit->board->boot_id, unit->board->reset_cause,
                                        unit->watch.steps_missed};

    (void)request;
    reply_message(answer, EBL_MESSAGE(ebl_start_info_response, &response));
}

static void bye(app *unit, const ebl_header *request, reply *answer)
{
    (void)request;
    telemetry_end_all(&unit->telemetry);
    transaction_drop(&unit->config.transaction);
    permission_end(unit);
    log_session_end(unit);
    events_attend(&unit->events, 0, unit_now_us(unit));
    reply_ok(answer);
}

request_handler requests_system(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_HELLO: return hello;
    case EBL_MSG_PING: return ping;
    case EBL_MSG_SCHEMA_READ: return schema_read;
    case EBL_MSG_STATS: return stats;
    case EBL_MSG_BYE: return bye;
    case EBL_MSG_COUNTERS: return counters_get;
    case EBL_MSG_START_INFO: return start_info;
    default: return NULL;
    }
}
