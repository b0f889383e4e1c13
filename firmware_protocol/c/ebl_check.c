/* A frame's header, and whether its payload is what its header promises. */
#include "ebl_bytes.h"    // ebl_get_u16, EBL_OK
#include "ebl_frame.h"    // ebl_header, ebl_frame_check
#include "ebl_registry.h" // ebl_message_find, EBL_MAJOR

#define RESERVED_BIT 4u
#define DETAIL_LENGTH 3 /* status and its u16 */
#define STREAM_LENGTH 6 /* t0_us u32, rows u8, flags u8 */
#define ENCODING_BITS 0x60u

void ebl_header_put(uint8_t *frame, uint8_t kind, uint8_t flags, uint8_t tag, uint16_t word)
{
    frame[0] = (uint8_t)((EBL_MAJOR << 5) | ((kind & 3u) << 3) | (flags & 3u));
    frame[1] = tag;
    ebl_put_u16(frame + 2, word);
}

int ebl_header_get(ebl_header *header, const uint8_t *frame, size_t length)
{
    if (length < EBL_HEADER_LENGTH) {
        return EBL_ERROR_LENGTH;
    }
    header->kind = (uint8_t)((frame[0] >> 3) & 3u);
    header->flags = frame[0] & 3u;
    header->tag = frame[1];
    header->word = ebl_get_u16(frame + 2);
    header->payload = frame + EBL_HEADER_LENGTH;
    header->payload_length = length - EBL_HEADER_LENGTH;
    if (frame[0] >> 5 != EBL_MAJOR) {
        return EBL_ERROR_VERSION;
    }
    return (frame[0] & RESERVED_BIT) != 0 ? EBL_ERROR_RESERVED : EBL_OK;
}

static int request_check(const ebl_header *header)
{
    const ebl_message *message = ebl_message_find(header->word);
    if (message == NULL) {
        return EBL_ERROR_UNKNOWN_MSG;
    }
    return header->payload_length < message->request_length ? EBL_ERROR_LENGTH : EBL_OK;
}

/* A refusal may answer a message we do not know; a success may not. */
static int response_check(const ebl_header *header)
{
    const ebl_message *message = ebl_message_find(header->word);
    if (header->payload_length < 1) {
        return EBL_ERROR_LENGTH;
    }
    if (header->payload[0] != EBL_STATUS_OK) {
        return header->payload_length < DETAIL_LENGTH ? EBL_ERROR_LENGTH : EBL_OK;
    }
    if (message == NULL) {
        return EBL_ERROR_UNKNOWN_MSG;
    }
    return header->payload_length - 1 < message->response_length ? EBL_ERROR_LENGTH : EBL_OK;
}

static int stream_check(const ebl_header *header)
{
    if (header->payload_length < STREAM_LENGTH) {
        return EBL_ERROR_LENGTH;
    }
    size_t row_bytes = header->payload_length - STREAM_LENGTH;
    uint8_t rows = header->payload[4];
    if ((header->payload[5] & ENCODING_BITS) != 0) {
        return EBL_ERROR_SHAPE;
    }
    if (rows == 0) {
        return row_bytes != 0 ? EBL_ERROR_SHAPE : EBL_OK;
    }
    return row_bytes % (2u * rows) != 0 ? EBL_ERROR_SHAPE : EBL_OK;
}

static int bulk_check(const ebl_header *header)
{
    if (header->tag > EBL_BULK_SESSION_MAX) {
        return EBL_ERROR_UNKNOWN_MSG;
    }
    if (header->payload_length < EBL_BULK_HEAD_LENGTH) {
        return EBL_ERROR_LENGTH;
    }
    size_t length = header->payload_length - EBL_BULK_HEAD_LENGTH;
    return length == 0 || length != ebl_get_u16(header->payload + 4) ? EBL_ERROR_SHAPE : EBL_OK;
}

static int async_check(const ebl_header *header)
{
    if (header->tag != 0) {
        return bulk_check(header);
    }
    if (header->payload_length < EBL_EVENT_HEAD_LENGTH) {
        return EBL_ERROR_LENGTH;
    }
    const ebl_event_row *event = ebl_event_find(header->payload[0]);
    size_t fields = header->payload_length - EBL_EVENT_HEAD_LENGTH;
    return event != NULL && fields < event->length ? EBL_ERROR_LENGTH : EBL_OK;
}

int ebl_frame_check(ebl_header *header, const uint8_t *frame, size_t length)
{
    int error = ebl_header_get(header, frame, length);
    if (error != EBL_OK) {
        return error;
    }
    switch (header->kind) {
    case EBL_KIND_REQUEST: return request_check(header);
    case EBL_KIND_RESPONSE: return response_check(header);
    case EBL_KIND_STREAM: return stream_check(header);
    default: return async_check(header);
    }
}
