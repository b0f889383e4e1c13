/* Values on trial: over the active configuration, in RAM alone, and gone by themselves. */
#ifndef SPINDLE_CONFIG_LIVE_H
#define SPINDLE_CONFIG_LIVE_H

#include <stddef.h>
#include <stdint.h>

#include "storage/config_store.h" // config_store
#include "ebl_registry.h"         // EBL_IMAGE_LENGTH
#include "ebl_values.h"           // ebl_refusal

typedef struct {
    uint8_t active;
    uint64_t ends_us;
    uint8_t image[EBL_IMAGE_LENGTH]; /* what the law runs on while `active` */
} config_live;

/* Sets items over what is in force and renews the time of all of them; a time of 0 ends them. What
 * needs a token in flash is ACCESS here too, with or without one.
 * Returns an ebl_status. INVALID_CONFIG: the first `capacity` refusals in `found`, the number of
 * all in `detail`. */
uint8_t live_set(config_live *live, const config_store *store, const ebl_live_set_request *request,
                 uint8_t access, uint64_t now_us, ebl_refusal *found, size_t capacity,
                 uint16_t *detail);

/* True once, when the time of the live values is over. */
int live_expire(config_live *live, uint64_t now_us);

/* Milliseconds that live values still have; 0 where there are none. */
uint32_t live_left_ms(const config_live *live, uint64_t now_us);

/* The image in force. */
const uint8_t *live_image(const config_live *live, const config_store *store);

#endif
