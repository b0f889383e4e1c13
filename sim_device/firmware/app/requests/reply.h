/* What a request is answered with. */
#ifndef SPINDLE_REPLY_H
#define SPINDLE_REPLY_H

#include <stddef.h>
#include <stdint.h>

#include "ebl_frame.h"  // ebl_header
#include "ebl_layout.h" // EBL_MESSAGE
#include "ebl_values.h" // ebl_refusal

/* Where a handler puts its answer: the status byte, then the detail or the fields. */
typedef struct {
    uint8_t *bytes;
    size_t capacity;
    size_t length;
} reply;

#define REPLY_REFUSAL_LENGTH 3 /* status u8, detail u16 */

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

#endif
