/* What the host asks to be allowed, and what it may not write without. */
#include "config/transaction.h" // transaction_staged_crc, transaction_flash_status
#include "dispatch.h"           // reply_ok, reply_message, request_read
#include "ebl_registry.h"       // ebl_auth_challenge_request

static uint64_t now(const app *unit) { return unit->board->now_us(unit->board->context); }

static void tell(app *unit)
{
    uint32_t failures = unit->lock.store.failures;

    event_auth_changed(&unit->events, &unit->link, now(unit), unit->lock.granted_level,
                       failures < UINT16_MAX ? (uint16_t)failures : UINT16_MAX);
}

static void challenge(app *unit, const ebl_header *request, reply *answer)
{
    ebl_auth_challenge_request asked;
    ebl_auth_challenge_response response;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_auth_challenge_request, &asked))) return;
    status = unlock_challenge(&unit->lock, unit->board, asked.level, &response, &detail);
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    reply_message(answer, EBL_MESSAGE(ebl_auth_challenge_response, &response));
}

/* Nothing is spent before there is something to be allowed and the bike stands: the check takes
 * longer than a control step. */
static uint8_t may_be_asked(app *unit, uint16_t transaction, uint16_t *detail)
{
    uint32_t crc32;
    uint8_t status =
        transaction_staged_crc(&unit->transaction, transaction, now(unit), &crc32, detail);

    if (status != EBL_STATUS_OK) return status;
    if (unit->transaction.state != EBL_CONFIG_STATE_VALID) return EBL_STATUS_STATE;
    return transaction_flash_status(unit->board, app_speed_kmh(unit));
}

static void respond(app *unit, const ebl_header *request, reply *answer)
{
    ebl_auth_response_request asked;
    ebl_auth_response_response response;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_auth_response_request, &asked))) return;
    status = may_be_asked(unit, asked.transaction, &detail);
    if (status == EBL_STATUS_OK) {
        status = unlock_respond(&unit->lock, unit->board, &asked, unit->transaction.image, &detail);
        if (status == EBL_STATUS_OK || status == EBL_STATUS_AUTH_BAD) tell(unit);
    }
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    response.level = unit->lock.granted_level;
    reply_message(answer, EBL_MESSAGE(ebl_auth_response_response, &response));
}

static void drop(app *unit, const ebl_header *request, reply *answer)
{
    (void)request;
    app_lock(unit);
    reply_ok(answer);
}

void app_lock(app *unit)
{
    if (unlock_drop(&unit->lock)) tell(unit);
}

uint8_t app_access_to_stage(const app *unit)
{
    return unit->lock.store.has_key ? EBL_ACCESS_FACTORY : EBL_ACCESS_DEALER;
}

uint8_t app_access_check(const app *unit, const uint8_t *image, uint16_t *detail)
{
    uint8_t needed = unlock_level_needed(unit->store.image, image);

    /* What the maker chose is lost: whatever is written instead, the maker has to agree. */
    if ((unit->store.lost & CONFIG_STORE_MAKERS_RECORDS) != 0) needed = EBL_ACCESS_FACTORY;

    if (needed == EBL_ACCESS_RIDER) return EBL_STATUS_OK;
    if (unlock_permits(&unit->lock, needed, image, now(unit))) return EBL_STATUS_OK;
    *detail = needed;
    return EBL_STATUS_ACCESS;
}

request_handler requests_unlock(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_AUTH_CHALLENGE: return challenge;
    case EBL_MSG_AUTH_RESPONSE: return respond;
    case EBL_MSG_AUTH_DROP: return drop;
    default: return NULL;
    }
}
