/* What the host asks about ride logs. */
#include "dispatch.h"     // reply_refuse
#include "ebl_registry.h" // EBL_MSG_LOG_LIST

/* A unit without memory for logs. */
static void no_log(app *unit, const ebl_header *request, reply *answer)
{
    const ebl_message *message = ebl_message_find(request->word);

    (void)unit;
    if (request->payload_length < message->request_length) {
        reply_refuse(answer, EBL_STATUS_LENGTH, (uint16_t)message->request_length);
        return;
    }
    reply_refuse(answer, EBL_STATUS_UNSUPPORTED, 0);
}

request_handler requests_log(uint16_t message_id)
{
    switch (message_id) {
    case EBL_MSG_LOG_LIST:
    case EBL_MSG_LOG_OPEN:
    case EBL_MSG_LOG_ACK:
    case EBL_MSG_LOG_CLOSE:
    case EBL_MSG_LOG_CRC:
    case EBL_MSG_LOG_CONFIRM: return no_log;
    default: return NULL;
    }
}
