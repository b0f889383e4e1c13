/* Who the unit is, and whether it is there. */
#include <string.h>

#include "dispatch.h"     // reply_ok, reply_with
#include "ebl_bytes.h"    // EBL_OK
#include "ebl_registry.h" // ebl_hello_request_get

#define MTU_MIN EBL_MTU_BEFORE_HELLO
#define BAUD_115200 1

static const uint16_t firmware_version[3] = {0, 1, 0};

/* The host that held streams and a transaction is not the one that says hello now. Its answered
 * requests go too: another host may number its own alike. */
static void session_start(app *app)
{
    app->session_id++;
    telemetry_end_all(&app->telemetry);
    transaction_drop(&app->transaction);
    memset(app->answered, 0, sizeof app->answered);
}

static void hello_fill(const app *app, ebl_hello_response *response)
{
    memset(response, 0, sizeof *response);
    response->major = EBL_MAJOR;
    response->minor = EBL_MINOR;
    response->device_class = app->hal->device_class;
    response->hardware_revision = app->hal->hardware_revision;
    memcpy(response->firmware_version, firmware_version, sizeof firmware_version);
    memcpy(response->uid, app->hal->uid, sizeof response->uid);
    response->boot_id = app->hal->boot_id;
    response->session_id = app->session_id;
    memcpy(response->schema_hash, ebl_schema_hash, sizeof response->schema_hash);
    response->config_generation = app->store.generation;
    response->config_crc32 = app->store.crc32;
    response->rx_mtu = EBL_MTU;
    response->tx_mtu = app->tx_mtu;
    response->max_outstanding = EBL_MAX_OUTSTANDING;
    response->access = EBL_ACCESS_DEALER;
    response->baud_bitmap = BAUD_115200;
    response->uptime_us = app->hal->now_us(app->hal->context);
}

static void hello(app *app, const ebl_header *request, reply *reply)
{
    ebl_hello_request asked;
    ebl_hello_response response;
    size_t length = 0;
    int put;

    if (ebl_hello_request_get(&asked, request->payload, request->payload_length) != EBL_OK) {
        reply_refuse(reply, EBL_STATUS_LENGTH, EBL_HELLO_REQUEST_LENGTH);
        return;
    }
    if (asked.major_min > EBL_MAJOR || asked.major_max < EBL_MAJOR) {
        reply_refuse(reply, EBL_STATUS_VERSION, EBL_MAJOR);
        return;
    }
    if (asked.host_mtu < MTU_MIN) {
        reply_refuse(reply, EBL_STATUS_RANGE, MTU_MIN);
        return;
    }
    session_start(app);
    app->tx_mtu = asked.host_mtu < EBL_MTU ? asked.host_mtu : EBL_MTU;
    hello_fill(app, &response);
    put = ebl_hello_response_put(&response, reply_fields(reply), reply_capacity(reply), &length);
    reply_with(reply, put, length);
}

static void ping(app *app, const ebl_header *request, reply *reply)
{
    (void)app;
    (void)request;
    reply_ok(reply);
}

static void schema_read(app *app, const ebl_header *request, reply *reply)
{
    ebl_schema_read_request asked;
    ebl_schema_read_response response;
    size_t room = reply_capacity(reply) - EBL_SCHEMA_READ_RESPONSE_LENGTH;
    size_t length = 0;
    int put;

    (void)app;
    if (ebl_schema_read_request_get(&asked, request->payload, request->payload_length) != EBL_OK) {
        reply_refuse(reply, EBL_STATUS_LENGTH, EBL_SCHEMA_READ_REQUEST_LENGTH);
        return;
    }
    if (asked.offset > EBL_SCHEMA_LENGTH) {
        reply_refuse(reply, EBL_STATUS_RANGE, EBL_SCHEMA_LENGTH);
        return;
    }
    response.total_length = EBL_SCHEMA_LENGTH;
    response.data = ebl_schema + asked.offset;
    response.data_length = EBL_SCHEMA_LENGTH - asked.offset;
    if (response.data_length > asked.length) response.data_length = asked.length;
    if (response.data_length > room) response.data_length = room;
    put = ebl_schema_read_response_put(&response, reply_fields(reply), reply_capacity(reply),
                                       &length);
    reply_with(reply, put, length);
}

static void stats(app *app, const ebl_header *request, reply *reply)
{
    const ebl_counts *counts = &app->link.decoder.counts;
    ebl_stats_response response = {counts->frames_ok, counts->crc_errors, counts->cobs_errors,
                                   counts->overflows, app->link.dropped_tx};
    size_t length = 0;
    int put;

    (void)request;
    put = ebl_stats_response_put(&response, reply_fields(reply), reply_capacity(reply), &length);
    reply_with(reply, put, length);
}

static void bye(app *app, const ebl_header *request, reply *reply)
{
    (void)request;
    telemetry_end_all(&app->telemetry);
    transaction_drop(&app->transaction);
    reply_ok(reply);
}

static void fault_list_get(app *app, const ebl_header *request, reply *reply)
{
    ebl_evt_fault_list_response response = {app->faults.active};
    size_t length = 0;
    int put;

    (void)request;
    put = ebl_evt_fault_list_response_put(&response, reply_fields(reply), reply_capacity(reply),
                                          &length);
    reply_with(reply, put, length);
}

request_handler requests_system(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_HELLO: return hello;
    case EBL_MSG_PING: return ping;
    case EBL_MSG_SCHEMA_READ: return schema_read;
    case EBL_MSG_STATS: return stats;
    case EBL_MSG_BYE: return bye;
    case EBL_MSG_EVT_FAULT_LIST: return fault_list_get;
    default: return NULL;
    }
}
