/* The steps of the pipeline in assist.c, one file each. Every step takes the demand as the step
 * before left it and lowers it or leaves it; none raises it after the law. A NaN goes through all
 * of them as a NaN: assist_step looks for one after each. */
#ifndef SPINDLE_ASSIST_STEPS_H
#define SPINDLE_ASSIST_STEPS_H

#include "assist_trace.h" // assist_trace
#include "assist_types.h" // assist_config, assist_state, assist_input, assist_output
#include "float32.h"      // float32_missing

/* `trace` is NULL wherever nobody asks why. The limits note what they allow, at the shaft. */
static inline void trace_note(assist_trace *trace, unsigned step, float torque_nm)
{
    if (trace) trace->torque_nm[step] = torque_nm;
}

/* sensor.c */
float sensor_torque_nm(const assist_config *config, const assist_input *input);

/* half_turn.c: keeps the mean over the last half turn, told the torque of every step. */
void half_turn_note(half_turn *turn, float step_s, float cadence_rpm, float torque_nm);

/* stroke_average.c: the torque that the law acts on, after half_turn_note. */
float stroke_average_nm(const assist_config *config, const assist_state *state, float torque_nm);

/* torque_rate.c: filtered torque one interval ago; stores the present one in its place. */
float torque_history_swap(const assist_config *config, assist_state *state);
float torque_rate_of(const assist_config *config, float torque_nm, float earlier_torque_nm);

/* Less torque than this is no push: legs that rest on the pedals, and the sensor's noise. */
static inline int push_counts(const assist_config *config, float torque_nm)
{
    return torque_nm > 0.0f && torque_nm >= config->pedal_torque_nm_min;
}

/* law.c: torque at the crank the mode asks for, before any ramp or limit. */
float apply_law(const assist_config *config, const assist_input *input, float earlier_torque_nm,
                assist_output *output);

/* walk.c: whether the button is followed in this step; torque at the crank that holds the set speed
 * while it is; and the end of it until the button is pressed anew. */
void walk_follow(const assist_config *config, assist_state *state, const assist_input *input);
int walk_is_on(const assist_state *state);
float apply_walk(const assist_config *config, assist_state *state, const assist_input *input,
                 assist_output *output);
void walk_refuse(assist_state *state);

/* cutoffs.c: the soft ramp below the cut-off speed. Before the ramps, which go on from the torque
 * that was given: behind them the same share would be taken again at every step. */
float apply_cutoff_band(const assist_config *config, const assist_input *input, float demand_nm,
                        assist_output *output);

/* ramps.c: is the torque reading fresh enough to act on? It is held for a moment, then let go. */
int torque_is_fresh(const assist_input *input);
float apply_ramps(const assist_config *config, const assist_input *input, float previous_nm,
                  float wanted_nm, assist_output *output);

/* cutoffs.c: the rider's hardest push of late, told in every step (0 where none was measured, so
 * that the half seconds are of time). */
void push_note(const assist_config *config, assist_state *state, float torque_nm);

/* cutoffs.c: whatever takes the torque away at once. */
float apply_cutoffs(const assist_config *config, assist_state *state, const assist_input *input,
                    float demand_nm, assist_output *output, assist_trace *trace);

/* limits.c: what motor, battery and heat allow; crank torque in, motor torque out. */
float apply_limits(const assist_config *config, assist_state *state, const assist_input *input,
                   float demand_nm, assist_output *output, assist_trace *trace);

/* battery_power.c: the motor's resistance with its winding as warm as it is; whether the battery
 * is near its least voltage; and the torque at which it gives all it may, asked once a step. */
float winding_resistance_ohm(const assist_config *config, const assist_input *input);
float battery_torque_nm(const assist_config *config, assist_state *state, const assist_input *input,
                        float resistance_ohm, float back_emf_v);
int battery_sags(const assist_config *config, const assist_input *input);

/* market_limit.c: the last word. */
float apply_market(const assist_config *config, assist_state *state, const assist_input *input,
                   float motor_nm, assist_output *output);

/* trace.c: what follows from the notes and the step's outcome. */
void trace_complete(assist_trace *trace, const assist_config *config, const assist_state *state,
                    const assist_input *input, const assist_output *output, int result);

/* Lowers the demand to the limit and says so. Whatever lowers it after the ramps decides in their
 * place, so their bits go. Where demand or limit is no number, nothing is left to give: NaN. */
static inline float held_at(float limit_nm, float demand_nm, unsigned flag, assist_output *output)
{
    unsigned ramps = ASSIST_LIMIT_RAMP_UP | ASSIST_LIMIT_RAMP_DOWN;

    if (demand_nm <= limit_nm) return demand_nm;
    if (!(demand_nm > limit_nm)) return float32_missing();
    output->limit_flags = (uint16_t)((output->limit_flags & ~ramps) | flag);
    return limit_nm;
}

#endif
