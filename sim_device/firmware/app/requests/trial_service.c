/* What the host asks about a configuration that is tried: on trial, or live. */
#include <string.h>

#include "config/wear.h"       // config_wear_wait_s
#include "reply.h"             // reply_message, request_read
#include "services.h"          // request_handler
#include "ebl_registry.h"      // ebl_cfg_confirm_request
#include "config/parameters.h" // parameters_get

static void confirm(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_confirm_request asked;
    int was_on_trial = unit->config.store.on_trial;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_cfg_confirm_request, &asked))) return;
    status = trial_confirm(&unit->config.store, unit->board, &asked, &detail);
    reply_status(answer, status, detail);
    if (status != EBL_STATUS_OK || !was_on_trial) return;
    event_config(&unit->events, &unit->link, unit_now_us(unit), EBL_EVENT_CONFIG_COMMITTED,
                 unit->config.store.generation, unit->config.store.crc32);
    config_apply(&unit->config); /* what held it back may be over */
    config_well(&unit->faults, &unit->events, &unit->link, unit->board);
}

static void rollback(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_rollback_response response;

    (void)request;
    if (!unit->config.store.on_trial) {
        reply_refuse(answer, EBL_STATUS_STATE, 0);
        return;
    }
    trial_return(&unit->config.trial, &unit->config.store, unit->board, EBL_ROLLBACK_CAUSE_ASKED);
    config_rolled_back(&unit->config, &unit->events, &unit->link, unit->board);
    response.generation = unit->config.store.generation;
    response.crc32 = unit->config.store.crc32;
    reply_message(answer, EBL_MESSAGE(ebl_cfg_rollback_response, &response));
}

static void config_status(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_status_response response;

    (void)request;
    response.state =
        unit->config.store.on_trial ? EBL_CONFIG_STATE_PROVISIONAL : unit->config.transaction.state;
    response.generation = unit->config.store.generation;
    response.crc32 = unit->config.store.crc32;
    response.confirm_left_ms =
        trial_left_ms(&unit->config.trial, &unit->config.store, unit_now_us(unit));
    response.live_left_ms = live_left_ms(&unit->config.live, unit_now_us(unit));
    response.commit_wait_ms =
        transaction_commit_wait_ms(&unit->config.transaction, &unit->config.store,
                                   unit_now_us(unit), unit->counters.operating_s);
    response.rollback_cause = unit->config.trial.cause;
    response.rolled_back_generation = unit->config.trial.returned_generation;
    reply_message(answer, EBL_MESSAGE(ebl_cfg_status_response, &response));
}

static void wear(app *unit, const ebl_header *request, reply *answer)
{
    uint32_t operating_s = unit->counters.operating_s;
    ebl_cfg_wear_response response = {
        config_wear_wait_s(unit->config.store.worn_until_s, operating_s),
        config_wear_writes_free(unit->config.store.worn_until_s, operating_s)};

    (void)request;
    reply_message(answer, EBL_MESSAGE(ebl_cfg_wear_response, &response));
}

static void slots(app *unit, const ebl_header *request, reply *answer)
{
    ebl_cfg_slots_response response;

    (void)request;
    response.active_slot = unit->config.store.slot;
    for (uint8_t i = 0; i < CONFIG_SLOTS; i++) {
        config_slot seen;

        config_slot_look(unit->board, i, &seen);
        response.states[i] = seen.state;
        response.generations[i] = seen.generation;
        response.erases[i] = seen.erases;
    }
    reply_message(answer, EBL_MESSAGE(ebl_cfg_slots_response, &response));
}

static void param_get(app *unit, const ebl_header *request, reply *answer)
{
    ebl_param_get_request asked;
    size_t length = 0;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_param_get_request, &asked))) return;
    status = parameters_get(live_image(&unit->config.live, &unit->config.store), asked.ids,
                            asked.ids_length, reply_fields(answer), reply_capacity(answer), &length,
                            &detail);
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
    } else {
        reply_with(answer, length);
    }
}

static void live_values(app *unit, const ebl_header *request, reply *answer)
{
    ebl_live_set_request asked;
    ebl_refusal found[REFUSALS_MAX];
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_live_set_request, &asked))) return;
    status = live_set(&unit->config.live, &unit->config.store, &asked, EBL_ACCESS_DEALER,
                      unit_now_us(unit), found, REFUSALS_MAX, &detail);
    if (status == EBL_STATUS_INVALID_CONFIG) {
        reply_refusals(answer, found, detail);
    } else {
        reply_status(answer, status, detail);
    }
    if (status == EBL_STATUS_OK) config_apply(&unit->config);
}

request_handler requests_trial(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_CFG_CONFIRM: return confirm;
    case EBL_MSG_CFG_ROLLBACK: return rollback;
    case EBL_MSG_CFG_STATUS: return config_status;
    case EBL_MSG_CFG_WEAR: return wear;
    case EBL_MSG_CFG_SLOTS: return slots;
    case EBL_MSG_PARAM_GET: return param_get;
    case EBL_MSG_LIVE_SET: return live_values;
    default: return NULL;
    }
}
