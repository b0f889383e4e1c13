#include "reply.h"

#include "ebl_bytes.h"    // ebl_put_u16, EBL_OK
#include "ebl_registry.h" // EBL_STATUS_OK

#define STATUS_LENGTH 1
#define REFUSAL_BYTES 4 /* of one violation: id u16, index u8, code u8 */

void reply_ok(reply *answer)
{
    answer->bytes[0] = EBL_STATUS_OK;
    answer->length = STATUS_LENGTH;
}

void reply_refuse(reply *answer, uint8_t status, uint16_t detail)
{
    answer->bytes[0] = status;
    ebl_put_u16(answer->bytes + STATUS_LENGTH, detail);
    answer->length = REPLY_REFUSAL_LENGTH;
}

void reply_status(reply *answer, uint8_t status, uint16_t detail)
{
    if (status == EBL_STATUS_OK) {
        reply_ok(answer);
    } else {
        reply_refuse(answer, status, detail);
    }
}

void reply_with(reply *answer, size_t length)
{
    answer->bytes[0] = EBL_STATUS_OK;
    answer->length = STATUS_LENGTH + length;
}

void reply_message(reply *answer, const uint8_t *layout, const void *message)
{
    size_t length;

    if (ebl_layout_put(layout, message, reply_fields(answer), reply_capacity(answer), &length) ==
        EBL_OK) {
        reply_with(answer, length);
    } else {
        reply_refuse(answer, EBL_STATUS_INTERNAL, 0);
    }
}

int request_read(const ebl_header *request, reply *answer, const uint8_t *layout, void *message)
{
    if (ebl_layout_get(layout, message, request->payload, request->payload_length) == EBL_OK) {
        return 1;
    }
    reply_refuse(answer, EBL_STATUS_LENGTH, layout[EBL_SHORTEST]);
    return 0;
}

uint8_t *reply_fields(const reply *answer) { return answer->bytes + STATUS_LENGTH; }

size_t reply_capacity(const reply *answer) { return answer->capacity - STATUS_LENGTH; }

void reply_refusals(reply *answer, const ebl_refusal *found, uint16_t detail)
{
    size_t count = detail < REFUSALS_MAX ? detail : REFUSALS_MAX;

    reply_refuse(answer, EBL_STATUS_INVALID_CONFIG, detail);
    for (size_t i = 0; i < count && answer->length + REFUSAL_BYTES <= answer->capacity; i++) {
        uint8_t *bytes = answer->bytes + answer->length;

        ebl_put_u16(bytes, found[i].id);
        bytes[2] = found[i].index;
        bytes[3] = found[i].code;
        answer->length += REFUSAL_BYTES;
    }
}
