/* The assist law as one pipeline: raw counts in, motor torque out, 100 times a second.
 *
 * Pure C99 and float32: no globals, no heap, no libm. State lives in a struct the caller owns, so
 * two instances never meet. The same code runs in the unit, the simulator and the preview. Build
 * with -ffp-contract=off and without fast-math, or hosts and targets differ in the last bit. */
#ifndef SPINDLE_ASSIST_H
#define SPINDLE_ASSIST_H

#include <stddef.h>

#include "assist_trace.h" // assist_trace
#include "assist_types.h" // assist_config, assist_state, assist_input, assist_output

enum {
    ASSIST_OK = 0,
    ASSIST_INPUT_REFUSED = -1,
    ASSIST_CONFIG_REFUSED = -2,
    ASSIST_RESULT_LOST = -3
};

/* One control step. A NaN, an infinity, a number no sensor can give (beyond a million) or an
 * unknown mode gives zero torque, sets INPUT_REFUSED and leaves the filter as it was.
 * `config` must have passed assist_config_check: a step does not check it again. A torque reading
 * that is too old is NaN in the output, and the assist goes down on a ramp of its own.
 *
 * Returns ASSIST_OK, ASSIST_INPUT_REFUSED, or ASSIST_RESULT_LOST where a step of the pipeline or
 * what it remembers is no number. No configuration that passed the check and no input does that:
 * it is memory that was damaged. It gives zero torque, sets FAULT and starts the state anew, so
 * that the next step computes again. The output is valid in any case. */
int assist_step(const assist_config *config, assist_state *state, const assist_input *input,
                assist_output *output);

/* The same step, to the bit; `trace` learns what each part of it left of the torque. */
int assist_step_traced(const assist_config *config, assist_state *state, const assist_input *input,
                       assist_output *output, assist_trace *trace);

/* The steps since the one before were not run and the motor was let go: nobody saw whether the
 * rider still pedals, and the ramps begin at nothing. What was averaged and learned stays. */
void assist_interrupted(assist_state *state);

/* `count` steps in a row: exactly `count` calls of assist_step. Returns how many were refused. */
size_t assist_run(const assist_config *config, assist_state *state, const assist_input *inputs,
                  assist_output *outputs, size_t count);

/* What the law takes readings of the torque sensor for, (count) each; a temperature of NaN corrects
 * nothing. For whoever looks at recorded readings. */
void assist_rider_torque_run(const assist_config *config, const float *torque_raw_counts,
                             const float *sensor_temperature_degc, float *rider_torque_nm,
                             size_t count);

/* Torque at the motor's shaft by its current, less what the motor's own drag takes: what it really
 * gives, whatever it was told. NaN where the current or the speed is. A motor that spins free in
 * its clutch draws for its drag alone: 0. */
float motor_torque_delivered_nm(const assist_config *config, float motor_current_a,
                                float motor_speed_rpm);

/* ASSIST_OK, or ASSIST_CONFIG_REFUSED if a value is not finite or out of its physical range. */
int assist_config_check(const assist_config *config);

#endif
