/* The services of a unit, one file each: which of their functions serves a request. */
#ifndef SPINDLE_SERVICES_H
#define SPINDLE_SERVICES_H

#include <stddef.h>
#include <stdint.h>

#include "ebl_frame.h"    // ebl_header
#include "private/unit.h" // app
#include "reply.h"        // reply

typedef void (*request_handler)(app *unit, const ebl_header *request, reply *answer);

/* NULL where the message is not one of the service's. */
request_handler requests_system(uint16_t message_id);
request_handler requests_line(uint16_t message_id);
request_handler requests_config(uint16_t message_id);
request_handler requests_trial(uint16_t message_id);
request_handler requests_unlock(uint16_t message_id);
request_handler requests_stream(uint16_t message_id);
request_handler requests_faults(uint16_t message_id);
request_handler requests_time(uint16_t message_id);
request_handler requests_log(const app *unit, uint16_t message_id);
request_handler requests_board(const app *unit, uint16_t message_id);

/* Goes on with what LOG requests began, and the source of bulk frames for the link. */
void requests_log_poll(app *unit);
size_t requests_log_bulk(void *context, uint8_t *frame, size_t capacity);

#endif
