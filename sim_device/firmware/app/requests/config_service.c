/* What the host asks about the configuration. */
#include <string.h>

#include "permission.h"           // permission_end, permission_to_activate, permission_to_stage
#include "reply.h"                // reply_message, request_read
#include "services.h"             // request_handler
#include "ebl_registry.h"         // ebl_cfg_read_request
#include "storage/config_image.h" // config_image_default

#define MS_PER_S 1000u

static void info(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_info_response response = {unit->config.store.generation, unit->config.store.crc32,
                                      EBL_IMAGE_LENGTH,
                                      unit->config.store.on_trial ? EBL_CONFIG_STATE_PROVISIONAL
                                                                  : unit->config.transaction.state};

    (void)request;
    reply_message(answer, EBL_MESSAGE(ebl_cfg_info_response, &response));
}

/* A staged image has the generation it is built on, the default has none. */
static uint8_t bank_read(const app *unit, uint8_t bank, uint8_t *image, uint32_t *generation)
{
    *generation = unit->config.store.generation;
    switch (bank) {
    case EBL_BANK_ACTIVE:
        memcpy(image, unit->config.store.image, EBL_IMAGE_LENGTH);
        return EBL_STATUS_OK;
    case EBL_BANK_STAGED:
        if (unit->config.transaction.state == EBL_CONFIG_STATE_IDLE) return EBL_STATUS_NOT_FOUND;
        memcpy(image, unit->config.transaction.image, EBL_IMAGE_LENGTH);
        return EBL_STATUS_OK;
    case EBL_BANK_PREVIOUS:
        return config_store_previous(&unit->config.store, unit->board, image, generation)
                   ? EBL_STATUS_OK
                   : EBL_STATUS_NOT_FOUND;
    case EBL_BANK_DEFAULT:
        *generation = 0;
        config_image_default(image);
        return EBL_STATUS_OK;
    default: return EBL_STATUS_RANGE;
    }
}

static void read_bank(app *unit, const ebl_header *request, reply *answer)
{
    uint8_t image[EBL_IMAGE_LENGTH];
    ebl_cfg_read_request asked;
    ebl_cfg_read_response response;
    size_t room = reply_capacity(answer) - EBL_CFG_READ_RESPONSE_LENGTH;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_read_request, &asked))) return;
    status = bank_read(unit, asked.bank, image, &response.generation);
    if (status == EBL_STATUS_OK && asked.offset > EBL_IMAGE_LENGTH) status = EBL_STATUS_RANGE;
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, asked.bank);
        return;
    }
    response.total_length = EBL_IMAGE_LENGTH;
    response.data = image + asked.offset;
    response.data_length = (size_t)(EBL_IMAGE_LENGTH - asked.offset);
    if (response.data_length > asked.length) response.data_length = asked.length;
    if (response.data_length > room) response.data_length = room;
    reply_message(answer, EBL_MESSAGE(ebl_cfg_read_response, &response));
}

static void begin(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_begin_request asked;
    ebl_cfg_begin_response response;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_begin_request, &asked))) return;
    if (unit->config.store.on_trial) {
        /* What it would overwrite is where a return leads to. */
        uint32_t left_ms =
            trial_left_ms(&unit->config.trial, &unit->config.store, unit_now_us(unit));

        reply_refuse(answer, EBL_STATUS_BUSY, (uint16_t)((left_ms + MS_PER_S - 1) / MS_PER_S));
        return;
    }
    status = transaction_begin(&unit->config.transaction, &unit->config.store, &asked,
                               unit_now_us(unit), &detail);
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    response.transaction = unit->config.transaction.id;
    response.lease_ms = TRANSACTION_LEASE_MS;
    reply_message(answer, EBL_MESSAGE(ebl_cfg_begin_response, &response));
}

static void set(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_set_request asked;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_set_request, &asked))) return;
    status = transaction_set(&unit->config.transaction, &asked, permission_to_stage(unit),
                             unit_now_us(unit), &detail);
    reply_status(answer, status, detail);
}

static void validate(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_validate_request asked;
    ebl_refusal found[REFUSALS_MAX];
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_validate_request, &asked))) return;
    status = transaction_validate(&unit->config.transaction, asked.transaction, unit_now_us(unit),
                                  found, REFUSALS_MAX, &detail);
    if (status == EBL_STATUS_INVALID_CONFIG) {
        reply_refusals(answer, found, detail);
    } else {
        reply_status(answer, status, detail);
    }
}

static void staged_crc(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_staged_crc_request asked;
    ebl_cfg_staged_crc_response response;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_staged_crc_request, &asked))) return;
    status = transaction_staged_crc(&unit->config.transaction, asked.transaction, unit_now_us(unit),
                                    &response.crc32, &detail);
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    reply_message(answer, EBL_MESSAGE(ebl_cfg_staged_crc_response, &response));
}

/* A new generation is active, and a token was good for one; a defaulted unit is well again. */
static void committed(app *unit, uint8_t confirm_s)
{
    permission_end(unit);
    if (unit->config.store.on_trial) {
        trial_begin(&unit->config.trial, confirm_s, unit_now_us(unit));
        unit->config.live.active = 0;
        config_apply(&unit->config);
        event_config_provisional(&unit->events, &unit->link, unit_now_us(unit),
                                 unit->config.store.generation, unit->config.store.crc32,
                                 confirm_s);
        return;
    }
    config_committed(&unit->config, &unit->events, &unit->link, unit->board);
    config_well(&unit->faults, &unit->events, &unit->link, unit->board);
}

/* Only for what could be committed otherwise: the rest is the transaction's to refuse. */
static uint8_t commit_access(app *unit, const ebl_cfg_commit_request *asked, uint16_t *detail)
{
    uint32_t crc32;
    uint8_t status = transaction_staged_crc(&unit->config.transaction, asked->transaction,
                                            unit_now_us(unit), &crc32, detail);

    if (status != EBL_STATUS_OK || unit->config.transaction.state != EBL_CONFIG_STATE_VALID) {
        return EBL_STATUS_OK;
    }
    if (crc32 != asked->staged_crc32) return EBL_STATUS_OK;
    return permission_to_activate(unit, unit->config.transaction.image, detail);
}

static void commit(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_commit_request asked;
    ebl_cfg_commit_response response;
    uint32_t generation_before = unit->config.store.generation;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_commit_request, &asked))) return;
    status = commit_access(unit, &asked, &detail);
    if (status == EBL_STATUS_OK) {
        status = transaction_commit(
            &unit->config.transaction, &unit->config.store, unit->board,
            road_speed_kmh(&unit->speed, &unit->config.in_force, unit_now_us(unit)), &asked,
            unit_now_us(unit), unit->counters.operating_s, &detail);
    }
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    if (unit->config.store.generation != generation_before) committed(unit, asked.confirm_s);
    response.generation = unit->config.store.generation;
    response.crc32 = unit->config.store.crc32;
    response.state =
        unit->config.store.on_trial ? EBL_CONFIG_STATE_PROVISIONAL : unit->config.transaction.state;
    reply_message(answer, EBL_MESSAGE(ebl_cfg_commit_response, &response));
}

static void abort_transaction(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_abort_request asked;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_abort_request, &asked))) return;
    status =
        transaction_abort(&unit->config.transaction, asked.transaction, unit_now_us(unit), &detail);
    reply_status(answer, status, detail);
}

request_handler requests_config(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_CFG_INFO: return info;
    case EBL_MSG_CFG_READ: return read_bank;
    case EBL_MSG_CFG_BEGIN: return begin;
    case EBL_MSG_CFG_SET: return set;
    case EBL_MSG_CFG_VALIDATE: return validate;
    case EBL_MSG_CFG_STAGED_CRC: return staged_crc;
    case EBL_MSG_CFG_COMMIT: return commit;
    case EBL_MSG_CFG_ABORT: return abort_transaction;
    default: return NULL;
    }
}
