/* One frame in, one response out: whatever the host asks, it is told something true. */
#ifndef SPINDLE_DISPATCH_H
#define SPINDLE_DISPATCH_H

#include <stddef.h>
#include <stdint.h>

#include "app.h"        // app
#include "ebl_frame.h"  // ebl_header
#include "ebl_layout.h" // EBL_MESSAGE
#include "ebl_values.h" // ebl_refusal

/* Where a handler puts its answer: the status byte, then the detail or the fields. */
typedef struct {
    uint8_t *bytes;
    size_t capacity;
    size_t length;
} reply;

typedef void (*request_handler)(app *unit, const ebl_header *request, reply *answer);

/* Handlers answer exactly once, with one of these. */
void reply_ok(reply *answer);
void reply_refuse(reply *answer, uint8_t status, uint16_t detail);
void reply_status(reply *answer, uint8_t status, uint16_t detail); /* OK has no detail */

/* OK with a message's fields: reply_message(answer, EBL_MESSAGE(ebl_alive_response, &response)). */
void reply_message(reply *answer, const uint8_t *layout, const void *message);

/* OK with `length` bytes that the handler has put at reply_fields. */
void reply_with(reply *answer, size_t length);
uint8_t *reply_fields(const reply *answer);
size_t reply_capacity(const reply *answer);

/* Reads a request into the struct of an EBL_MESSAGE. False, and refused, where it is too short. */
int request_read(const ebl_header *request, reply *answer, const uint8_t *layout, void *message);

/* What REFUSALS_MAX violations of an image leave behind an INVALID_CONFIG: as many as the MTU
 * carries, `detail` says how many there are. */
void reply_refusals(reply *answer, const ebl_refusal *found, uint16_t detail);

/* More than there are elements in the image, so that none is left unsaid. */
#define REFUSALS_MAX 96

/* Answers a frame that the line brought. What is not a request is ignored. */
void dispatch_frame(app *unit, const uint8_t *frame, size_t length);

/* NULL where the message is not one of the folder's. */
request_handler requests_system(uint16_t message_id);
request_handler requests_line(uint16_t message_id);
request_handler requests_config(uint16_t message_id);
request_handler requests_trial(uint16_t message_id);
request_handler requests_unlock(uint16_t message_id);
request_handler requests_stream(uint16_t message_id);
request_handler requests_faults(uint16_t message_id);
request_handler requests_time(uint16_t message_id);
request_handler requests_log(const app *unit, uint16_t message_id);

/* The response that a PENDING promised; it is remembered in its place. At most 8 bytes. */
void dispatch_answer_later(app *unit, uint8_t tid, uint16_t message_id, const reply *answer);

/* What was answered in this poll has been given to the line. */
void dispatch_answers_left(app *unit);

/* Answers of this message are not given again: a repeated request is executed anew. */
void dispatch_forget(app *unit, uint16_t message_id);

/* Goes on with what LOG requests began, and the source of bulk frames for the link. */
void requests_log_poll(app *unit);
size_t requests_log_bulk(void *context, uint8_t *frame, size_t capacity);

#endif
