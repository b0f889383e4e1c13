/* The product around the assist law: what a drive unit is, seen from its serial line.
 *
 * A board owns one `app`, calls app_control_step every control period and app_poll as often as it
 * can, both from one context. No heap, no libm, no globals; the struct must stay where it was
 * initialised. */
#ifndef SPINDLE_APP_H
#define SPINDLE_APP_H

#include <stdint.h>

#include "assist.h"               // assist_config, assist_state, assist_output
#include "config/live.h"          // config_live
#include "storage/config_store.h" // config_store
#include "config/transaction.h"   // config_transaction
#include "config/trial.h"         // config_trial
#include "storage/counters.h"     // counters
#include "ebl_registry.h"         // ebl_config
#include "line/events.h"          // event_log
#include "faults/faults.h"        // fault_list
#include "hal.h"                  // hal
#include "line/baud_rate.h"       // line_rate
#include "line/link.h"            // unit_link
#include "ride_log/log.h"         // ride_log
#include "ride_log/bulk.h"        // ride_log_bulk
#include "ride_log/check.h"       // ride_log_check
#include "faults/step_watch.h"    // step_watch
#include "line/telemetry.h"       // telemetry
#include "config/unlock.h"        // unlock
#include "wheel_speed.h"          // wheel_speed

/* A response the host may ask for again because it was lost: executing twice is not an option. */
typedef struct {
    uint8_t tid; /* 0: nothing here */
    uint8_t new; /* executed in this poll: no answer to it has left yet */
    uint32_t request_crc32;
    uint16_t length;
    uint8_t frame[LINK_MTU];
} answered_request;

typedef struct {
    const hal *board;
    unit_link link;
    line_rate line;
    event_log events;

    uint32_t session_id; /* one more with every HELLO */
    uint16_t tx_mtu;
    answered_request answered[EBL_MAX_OUTSTANDING];
    uint8_t answered_next;

    config_store store;
    config_transaction transaction;
    config_trial trial;
    config_live live;
    unlock lock;
    ebl_config config; /* the one in force */
    counters counters;
    wheel_speed wheel;
    uint8_t speed_not_measured; /* the board says that its sensor is broken */

    assist_config assist_config_next;
    uint8_t assist_config_pending;
    assist_config assist_config; /* what the law runs on */
    assist_state assist_state;
    assist_output output;
    step_watch watch;
    uint8_t law_lost; /* the latest control step gave no torque because there was no number */

    telemetry telemetry;
    fault_list faults;
    uint32_t faults_new;     /* set in this control step */
    uint64_t unix_offset_us; /* Unix time minus the unit's; 0: nobody told */
    ride_log ride_log;
    ride_log_bulk bulk;
    ride_log_check log_check;
} app;

/* Boots: configuration from flash, BOOT on the line. `hal` must outlive `app`. */
void app_init(app *unit, const hal *board);

/* Serves the serial line and ends leases that ran out. */
void app_poll(app *unit);

/* One control period: inputs, law, motor, faults, a row of telemetry. */
void app_control_step(app *unit);

/* The inputs as inputs_read gets them: nothing measured, nothing pressed. */
void app_inputs_prepare(hal_inputs *inputs);

/* What the law gave in the latest control step. */
const assist_output *app_output(const app *unit);

/* What a unit leaves the factory with: the defaults, and assist up to where the market ends it. */
void app_factory_config(ebl_config *config, uint8_t market_number);

/* The factory's last step, before the first app_init: gives a flash that never had one its first
 * configuration. Any other flash is left alone. A unit that was not provisioned gives no assist.
 * 0, or a negative CONFIG_STORE_ result. */
int app_provision(const hal *board, const ebl_config *config);

/* The factory's choice: the maker's public key of 32 bytes, for good. Without one no limit can be
 * raised and no factory parameter changed. Negative where another key is, or no room. */
int app_provision_unlock_key(const hal *board, const uint8_t *key);

/* For the rooms of this folder: what may be staged (an ebl_access), whether this image may become
 * active (OK, or ACCESS with the level in `detail`), and the end of what a token granted. */
uint8_t app_access_to_stage(const app *unit);
uint8_t app_access_check(const app *unit, const uint8_t *image, uint16_t *detail);
void app_lock(app *unit);

/* For the rooms of this folder: the wheel's speed now; NaN where its sensor is broken. */
float app_speed_kmh(const app *unit);

/* For the rooms of this folder: tells the host and the ride log of faults that are over. */
void app_faults_cleared(app *unit, uint32_t cleared, uint64_t now_us);

/* For the rooms of this folder: the image in force becomes the law's at the next control step. */
void app_config_apply(app *unit);

/* For the rooms of this folder: nothing of the active configuration is lost any more; the faults
 * that told so end. */
void app_config_well(app *unit);

/* A new configuration is active: live values end, the law gets it, the host is told with this
 * event. */
void app_config_changed(app *unit, uint8_t event_code);

#endif
