/* What the unit measures: the board's inputs, and the wheel's speed from its pulses. */
#ifndef SPINDLE_INPUTS_H
#define SPINDLE_INPUTS_H

#include <stdint.h>

#include "ebl_registry.h" // ebl_config
#include "hal.h"          // hal, hal_inputs
#include "wheel_speed.h"  // wheel_speed

typedef struct {
    wheel_speed wheel;
    uint8_t is_not_measured; /* the board says that its sensor is broken */
} road_speed;

/* The inputs as a board gets them: nothing measured, nothing pressed. */
void inputs_prepare(hal_inputs *inputs);

/* The board's inputs now. */
void inputs_take(const hal *board, hal_inputs *inputs);

/* True if a bridge can give this reading: a number, and not pinned to the end of its word. */
int inputs_torque_is_plausible(float torque_raw_counts);

void road_speed_init(road_speed *speed);

/* One control step: returns the way in metres since the step before. */
float road_speed_step(road_speed *speed, const ebl_config *config, const hal_inputs *inputs);

/* The wheel's speed now; NaN where its sensor is broken. */
float road_speed_kmh(const road_speed *speed, const ebl_config *config, uint64_t now_us);

#endif
