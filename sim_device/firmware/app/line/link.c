#include "link.h"

#include <string.h>

#include "ebl_bytes.h" // EBL_OK

#define LENGTH_BYTES 2

static void queue_init(link_queue *queue, uint8_t *bytes, uint16_t capacity)
{
    queue->bytes = bytes;
    queue->capacity = capacity;
    queue->head = 0;
    queue->used = 0;
}

static void queue_put(link_queue *queue, const uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        queue->bytes[(queue->head + queue->used) % queue->capacity] = bytes[i];
        queue->used++;
    }
}

static void queue_take(link_queue *queue, uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        bytes[i] = queue->bytes[queue->head];
        queue->head = (uint16_t)((queue->head + 1) % queue->capacity);
        queue->used--;
    }
}

void link_init(unit_link *link)
{
    memset(link, 0, sizeof *link);
    ebl_decoder_init(&link->decoder, link->received, sizeof link->received);
    queue_init(&link->queues[LINK_RESPONSE], link->response_bytes, LINK_RESPONSE_QUEUE_BYTES);
    queue_init(&link->queues[LINK_EVENT], link->event_bytes, LINK_EVENT_QUEUE_BYTES);
    queue_init(&link->queues[LINK_STREAM], link->stream_bytes, LINK_STREAM_QUEUE_BYTES);
}

int link_send(unit_link *link, link_priority priority, const uint8_t *frame, size_t length)
{
    link_queue *queue = &link->queues[priority];
    uint8_t prefix[LENGTH_BYTES];

    if (length > LINK_MTU - EBL_CHECK_LENGTH ||
        (size_t)(queue->capacity - queue->used) < length + LENGTH_BYTES) {
        link->dropped_tx++;
        return 0;
    }
    prefix[0] = (uint8_t)(length & 0xFF);
    prefix[1] = (uint8_t)(length >> 8);
    queue_put(queue, prefix, sizeof prefix);
    queue_put(queue, frame, length);
    return 1;
}

static void frame_encode(unit_link *link, size_t length)
{
    size_t wire_length = 0;

    if (ebl_frame_encode(link->frame, length, link->wire, sizeof link->wire, &wire_length) !=
        EBL_OK) {
        link->dropped_tx++;
    }
    link->wire_sent = 0;
    link->wire_length = (uint16_t)wire_length;
}

/* Encodes the most urgent waiting frame. False where none waits. */
static int next_frame(unit_link *link)
{
    size_t bulk_length;

    const int priorities = link->answers_only ? LINK_RESPONSE + 1 : LINK_PRIORITIES;

    for (int priority = 0; priority < priorities; priority++) {
        link_queue *queue = &link->queues[priority];
        uint8_t prefix[LENGTH_BYTES];
        size_t length;

        if (queue->used == 0) continue;
        queue_take(queue, prefix, sizeof prefix);
        length = (size_t)prefix[0] | (size_t)prefix[1] << 8;
        queue_take(queue, link->frame, length);
        frame_encode(link, length);
        return 1;
    }
    if (link->answers_only) return 0;
    bulk_length = link->bulk == NULL ? 0
                                     : link->bulk(link->bulk_context, link->frame,
                                                  sizeof link->frame - EBL_CHECK_LENGTH);
    if (bulk_length == 0) return 0;
    frame_encode(link, bulk_length);
    return 1;
}

int link_has_answered(const unit_link *link)
{
    return link->queues[LINK_RESPONSE].used == 0 && link->wire_sent == link->wire_length;
}

int link_has_told(const unit_link *link) { return link->queues[LINK_EVENT].used == 0; }

void link_transmit(unit_link *link, const hal *board)
{
    for (;;) {
        size_t left = (size_t)(link->wire_length - link->wire_sent);
        size_t taken;

        if (left == 0) {
            if (!next_frame(link)) return;
            continue;
        }
        taken = board->serial_write(board->context, link->wire + link->wire_sent, left);
        if (taken > left) taken = left;
        link->wire_sent = (uint16_t)(link->wire_sent + taken);
        if (taken < left) return;
    }
}
