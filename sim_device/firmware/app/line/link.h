/* The unit's end of the serial line: bytes to frames, and three bounded queues of frames to bytes.
 *
 * A response overtakes an event, an event overtakes a stream, bulk gets what is left; a frame once
 * begun is finished. */
#ifndef SPINDLE_LINK_H
#define SPINDLE_LINK_H

#include <stddef.h>
#include <stdint.h>

#include "ebl_frame.h"    // ebl_decoder
#include "ebl_registry.h" // EBL_MTU, EBL_MAX_OUTSTANDING
#include "hal.h"          // hal

typedef enum {
    LINK_RESPONSE = 0,
    LINK_EVENT = 1,
    LINK_STREAM = 2,
    LINK_PRIORITIES = 3
} link_priority;

/* Bytes of the largest frame in either direction, check value included; HELLO tells the host. A
 * controller short of RAM is built with fewer, at least EBL_MTU_BEFORE_HELLO. */
#ifndef LINK_MTU
#define LINK_MTU EBL_MTU
#endif

/* Of the largest frame on the wire: stuffed and delimited. */
#define LINK_WIRE_BYTES_MAX (LINK_MTU + LINK_MTU / 254 + 6)

/* As many answers as the host may have questions outstanding. */
#define LINK_RESPONSE_QUEUE_BYTES (EBL_MAX_OUTSTANDING * (LINK_MTU + 16))
#define LINK_EVENT_QUEUE_BYTES 512
#define LINK_STREAM_QUEUE_BYTES (4 * (LINK_MTU + 16))

/* Asked for a frame whenever nothing else waits and the line has room: fills in header and payload
 * and returns their length, or 0. */
typedef size_t (*link_source)(void *context, uint8_t *frame, size_t capacity);

typedef struct {
    uint8_t *bytes;
    uint16_t capacity;
    uint16_t head; /* the oldest byte */
    uint16_t used;
} link_queue;

typedef struct {
    ebl_decoder decoder;
    uint8_t received[LINK_MTU]; /* the frame being decoded */
    link_queue queues[LINK_PRIORITIES];
    uint8_t response_bytes[LINK_RESPONSE_QUEUE_BYTES];
    uint8_t event_bytes[LINK_EVENT_QUEUE_BYTES];
    uint8_t stream_bytes[LINK_STREAM_QUEUE_BYTES];
    uint8_t frame[LINK_MTU];           /* the frame being encoded */
    uint8_t wire[LINK_WIRE_BYTES_MAX]; /* the frame being sent */
    uint16_t wire_length;
    uint16_t wire_sent;
    uint32_t dropped_tx;
    uint8_t answers_only; /* the rest waits: the line is about to change its rate */
    link_source bulk;     /* NULL: none */
    void *bulk_context;
} unit_link;

void link_init(unit_link *link);

/* Queues a frame (header and payload, without CRC). False, and counted, where the queue is full. */
int link_send(unit_link *link, link_priority priority, const uint8_t *frame, size_t length);

/* Whether no answer waits and no frame is half sent. */
int link_has_answered(const unit_link *link);

/* Whether an event sent now would be the next frame but answers. */
int link_has_told(const unit_link *link);

/* Gives the line what it takes now. */
void link_transmit(unit_link *link, const hal *board);

#endif
