/* What the host asks to be allowed, and what it may not write without. */
#include "permission.h"   // permission_end, permission_tell, permission_to_write_flash
#include "reply.h"        // reply_ok, reply_message, request_read
#include "services.h"     // request_handler
#include "ebl_registry.h" // ebl_auth_challenge_request

static void challenge(app *unit, const ebl_header *request, reply *answer)
{
    ebl_auth_challenge_request asked;
    ebl_auth_challenge_response response;
    uint16_t detail = 0;
    uint8_t status;

    if (!request_read(request, answer, EBL_MESSAGE(ebl_auth_challenge_request, &asked))) return;
    status = unlock_challenge(&unit->config.unlock, unit->board, asked.level, &response, &detail);
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
    uint8_t status = transaction_staged_crc(&unit->config.transaction, transaction,
                                            unit_now_us(unit), &crc32, detail);

    if (status != EBL_STATUS_OK) return status;
    if (unit->config.transaction.state != EBL_CONFIG_STATE_VALID) return EBL_STATUS_STATE;
    return permission_to_write_flash(unit);
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
        status = unlock_respond(&unit->config.unlock, unit->board, &asked,
                                unit->config.transaction.image, &detail);
        if (status == EBL_STATUS_OK || status == EBL_STATUS_AUTH_BAD) permission_tell(unit);
    }
    if (status != EBL_STATUS_OK) {
        reply_refuse(answer, status, detail);
        return;
    }
    response.level = unit->config.unlock.granted_level;
    reply_message(answer, EBL_MESSAGE(ebl_auth_response_response, &response));
}

static void drop(app *unit, const ebl_header *request, reply *answer)
{
    (void)request;
    permission_end(unit);
    reply_ok(answer);
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
