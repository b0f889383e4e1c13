/* The unit as its rooms share it: what each of them keeps, in one struct that a board owns. */
#ifndef SPINDLE_UNIT_PRIVATE_H
#define SPINDLE_UNIT_PRIVATE_H

#include <stdint.h>

#include "assist.h"            // assist_config, assist_state, assist_output
#include "config/in_force.h"   // unit_config
#include "ebl_registry.h"      // EBL_MAX_OUTSTANDING
#include "faults/faults.h"     // fault_list
#include "faults/inputs.h"     // road_speed
#include "faults/step_watch.h" // step_watch
#include "hal.h"               // hal
#include "line/baud_rate.h"    // baud_rate
#include "line/events.h"       // event_log
#include "line/link.h"         // unit_link
#include "line/telemetry.h"    // telemetry
#include "ride_log/bulk.h"     // ride_log_bulk
#include "ride_log/check.h"    // ride_log_check
#include "ride_log/log.h"      // ride_log
#include "storage/counters.h"  // counters

/* A response the host may ask for again because it was lost: executing twice is not an option. */
typedef struct {
    uint8_t tid; /* 0: nothing here */
    uint8_t new; /* executed in this poll: no answer to it has left yet */
    uint32_t request_crc32;
    uint16_t length;
    uint8_t frame[LINK_MTU];
} answered_request;

/* Long buffers come last: what lies within 4 KB of the start costs an instruction less. */
typedef struct {
    const hal *board;
    uint64_t unix_offset_us; /* Unix time minus the unit's; 0: nobody told */
    uint32_t session_id;     /* one more with every HELLO */
    uint32_t faults_new;     /* set in this control step */
    uint16_t tx_mtu;
    uint8_t law_lost; /* the latest control step gave no torque because there was no number */
    uint8_t answered_next;
    step_watch watch;
    baud_rate baud_rate;
    road_speed speed;
    counters counters;
    assist_state assist_state;
    assist_output output;
    event_log events;
    unit_config config;
    fault_list faults;
    ride_log_bulk bulk;
    ride_log_check log_check;

    telemetry telemetry;
    ride_log ride_log;
    unit_link link;
    answered_request answered[EBL_MAX_OUTSTANDING];
} app;

/* Time since the unit was switched on, by its board. */
static inline uint64_t unit_now_us(const app *self)
{
    return self->board->now_us(self->board->context);
}

#endif
