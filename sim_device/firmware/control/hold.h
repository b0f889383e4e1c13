/* A question about points of a table: what the law gives where nothing changes for long but that
 * the torque keeps rising at a rate. No rider can do that; it is how a surface is drawn. */
#ifndef SPINDLE_HOLD_H
#define SPINDLE_HOLD_H

#include <stddef.h>
#include <stdint.h>

#include "assist_types.h" // assist_config, assist_state, assist_input, assist_output

/* `steps` steps of the same input, after each of which the torque is made to have risen at
 * `torque_rate` (above -1; below 0 it falls). `output` is of the last one. `steps` of 0 leave it as
 * it is. `config` as of assist_step. */
void assist_hold(const assist_config *config, assist_state *state, const assist_input *input,
                 float torque_rate, uint32_t steps, assist_output *output);

/* `count` points one after the other, each held for `steps` and until the mean that a continuous
 * rating is held against has come to rest: what is given for long. The points should lie side by
 * side, because each begins where the one before ended. */
void assist_settle(const assist_config *config, assist_state *state, const assist_input *inputs,
                   const float *torque_rates, uint32_t steps, assist_output *outputs, size_t count);

#endif
