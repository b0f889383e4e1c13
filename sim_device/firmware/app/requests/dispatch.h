/* One frame in, one response out: whatever the host asks, it is told something true. */
#ifndef SPINDLE_DISPATCH_H
#define SPINDLE_DISPATCH_H

#include <stddef.h>
#include <stdint.h>

#include "private/unit.h" // app
#include "reply.h"        // reply

/* Answers a frame that the line brought. What is not a request is ignored. */
void dispatch_frame(app *unit, const uint8_t *frame, size_t length);

/* The response that a PENDING promised; it is remembered in its place. At most 8 bytes. */
void dispatch_answer_later(app *unit, uint8_t tid, uint16_t message_id, const reply *answer);

/* What was answered in this poll has been given to the line. */
void dispatch_answers_left(app *unit);

/* Answers of this message are not given again: a repeated request is executed anew. */
void dispatch_forget(app *unit, uint16_t message_id);

#endif
