/* What a request may do to the configuration now. */
#ifndef SPINDLE_PERMISSION_H
#define SPINDLE_PERMISSION_H

#include <stdint.h>

#include "private/unit.h" // app

/* What may be staged: an ebl_access. */
uint8_t permission_to_stage(const app *unit);

/* Whether this image may become active: OK, or ACCESS with the level in `detail`. */
uint8_t permission_to_activate(const app *unit, const uint8_t *image, uint16_t *detail);

/* OK where the flash may be written now, as transaction_flash_status. */
uint8_t permission_to_write_flash(const app *unit);

/* Takes back what a token granted, and tells the host. */
void permission_end(app *unit);

/* Tells the host what a token allows now. */
void permission_tell(app *unit);

#endif
