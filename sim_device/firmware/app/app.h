/* The product around the assist law: what a drive unit is, seen from its serial line.
 *
 * A board owns one `app`, calls app_control_step every control period and app_poll as often as it
 * can, both from one context. No heap, no libm, no globals; the struct must stay where it was
 * initialised. */
#ifndef SPINDLE_APP_H
#define SPINDLE_APP_H

#include <stdint.h>

#include "assist_types.h" // assist_output
#include "ebl_registry.h" // ebl_config
#include "hal.h"          // hal
#include "private/unit.h" // app

/* Boots: configuration from flash, BOOT on the line. `hal` must outlive `app`. */
void app_init(app *unit, const hal *board);

/* Serves the serial line and ends leases that ran out. */
void app_poll(app *unit);

/* One control period: inputs, law, motor, faults, a row of telemetry. */
void app_control_step(app *unit);

/* What the law gave in the latest control step. */
const assist_output *app_output(const app *unit);

/* What a unit leaves the factory with: the defaults, and assist up to where the market ends it. */
void app_factory_config(ebl_config *config, uint8_t market_number);

/* The factory's last step, before the first app_init: gives a flash that never had one its first
 * configuration. Any other flash is left alone. A unit that was not provisioned gives no assist.
 * 0, or a negative STORAGE_ result. */
int app_provision(const hal *board, const ebl_config *config);

/* The factory's choice: the maker's public key of 32 bytes, for good. Without one no limit can be
 * raised and no factory parameter changed. Negative where another key is, or no room. */
int app_provision_unlock_key(const hal *board, const uint8_t *key);

#endif
