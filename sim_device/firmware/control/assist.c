/* The pipeline. Read run_step from top to bottom: the way from the spindle to the motor. */
#include "assist.h"

#include "assist_steps.h" // apply_law to apply_limits
#include "float32.h"      // float32_abs, float32_is_finite, float32_missing

/* No sensor of the bike reads beyond this; it keeps every later sum and product finite. */
static const float READING_MAX = 1.0e6f;

/* A NaN compares false and is refused with the rest. */
static int plausible(float reading) { return float32_abs(reading) <= READING_MAX; }

static int input_refused(const assist_input *input)
{
    return !(plausible(input->torque_raw_counts) && plausible(input->speed_kmh) &&
             plausible(input->cadence_rpm) && plausible(input->motor_speed_rpm) &&
             plausible(input->battery_voltage_v) && input->mode < ASSIST_MODE_SLOTS);
}

static void output_clear(const assist_state *state, assist_output *output)
{
    output->rider_torque_nm = float32_missing();
    output->rider_torque_filtered_nm = state->torque_filtered_nm;
    output->torque_rate = 0.0f;
    output->assist_ratio = 0.0f;
    output->fuzzy_gain = float32_missing();
    output->motor_torque_nm = 0.0f;
    output->motor_torque_demanded_nm = 0.0f;
    output->motor_torque_available_nm = float32_missing();
    output->limit_flags = 0;
}

void assist_interrupted(assist_state *state)
{
    state->assist_torque_nm = 0.0f;
    state->pedal_steps_left = 0;
    walk_refuse(state);
}

static int refuse(const assist_config *config, assist_state *state, assist_output *output)
{
    assist_interrupted(state);
    push_note(config, state, 0.0f);
    output->limit_flags = ASSIST_LIMIT_INPUT_REFUSED;
    return ASSIST_INPUT_REFUSED;
}

static int lose(assist_state *state, assist_output *output)
{
    const assist_state at_rest = {0};

    *state = at_rest;
    output_clear(state, output);
    output->limit_flags = ASSIST_LIMIT_FAULT;
    return ASSIST_RESULT_LOST;
}

/* A sum is finite where all its terms are: none of these comes near the end of a float. The history
 * holds what was the filtered torque of a step that passed here. */
static int remembers_numbers(const assist_state *state)
{
    return float32_is_finite(
        state->torque_filtered_nm + state->assist_torque_nm + state->walk_integral_nm +
        state->push_peak_nm[0] + state->push_peak_nm[1] + state->push_peak_nm[2] +
        state->turn.mean_nm + state->turn.part_sum_nm + state->turn.part_turned +
        state->motor_power_mean_w + state->battery_spared + state->battery_power_w +
        state->battery_torque_nm + state->battery_trim_w);
}

static float apply_sensor(const assist_config *config, assist_state *state,
                          const assist_input *input, assist_output *output)
{
    float earlier_torque_nm;
    float push_nm = 0.0f;

    if (torque_is_fresh(input)) {
        output->rider_torque_nm = sensor_torque_nm(config, input);
        push_nm = output->rider_torque_nm;
        half_turn_note(&state->turn, config->step_s, input->cadence_rpm, push_nm);
        state->torque_filtered_nm = stroke_average_nm(config, state, push_nm);
    }
    push_note(config, state, push_nm);
    output->rider_torque_filtered_nm = state->torque_filtered_nm;
    earlier_torque_nm = torque_history_swap(config, state);
    output->torque_rate = torque_rate_of(config, state->torque_filtered_nm, earlier_torque_nm);
    return earlier_torque_nm;
}

/* Walk assist, or the mode's law while the torque it acts on is fresh. */
static float apply_mode(const assist_config *config, assist_state *state, const assist_input *input,
                        float earlier_torque_nm, assist_output *output)
{
    float demand_nm;

    walk_follow(config, state, input);
    if (walk_is_on(state)) return apply_walk(config, state, input, output);
    demand_nm = apply_law(config, input, earlier_torque_nm, output);
    if (torque_is_fresh(input)) return demand_nm;
    if (state->assist_torque_nm > 0.0f) output->limit_flags |= ASSIST_LIMIT_FAULT;
    return 0.0f;
}

static int run_step(const assist_config *config, assist_state *state, const assist_input *input,
                    assist_output *output, assist_trace *trace)
{
    float earlier_torque_nm;
    float demand_nm;

    output_clear(state, output);
    if (input_refused(input)) return refuse(config, state, output);

    earlier_torque_nm = apply_sensor(config, state, input, output);
    demand_nm = apply_mode(config, state, input, earlier_torque_nm, output);
    trace_note(trace, ASSIST_TRACE_FRESH, demand_nm);
    if (!float32_is_finite(demand_nm + output->assist_ratio)) return lose(state, output);
    demand_nm = apply_cutoff_band(config, input, demand_nm, output);
    if (!float32_is_finite(demand_nm)) return lose(state, output);
    trace_note(trace, ASSIST_TRACE_BAND, demand_nm);
    output->motor_torque_demanded_nm = demand_nm / config->gear_ratio;
    demand_nm = apply_ramps(config, input, state->assist_torque_nm, demand_nm, output);
    if (!float32_is_finite(demand_nm)) return lose(state, output);
    trace_note(trace, ASSIST_TRACE_RAMPS, demand_nm);
    demand_nm = apply_cutoffs(config, state, input, demand_nm, output, trace);
    if (!float32_is_finite(demand_nm)) return lose(state, output);
    if (demand_nm == 0.0f) output->motor_torque_demanded_nm = 0.0f;
    demand_nm = apply_limits(config, state, input, demand_nm, output, trace);
    if (!float32_is_finite(demand_nm)) return lose(state, output);
    output->motor_torque_nm = apply_market(config, state, input, demand_nm, output);
    state->assist_torque_nm = output->motor_torque_nm * config->gear_ratio;
    if (!remembers_numbers(state)) return lose(state, output);
    return ASSIST_OK;
}

int assist_step(const assist_config *config, assist_state *state, const assist_input *input,
                assist_output *output)
{
    return run_step(config, state, input, output, NULL);
}

int assist_step_traced(const assist_config *config, assist_state *state, const assist_input *input,
                       assist_output *output, assist_trace *trace)
{
    int result = run_step(config, state, input, output, trace);

    trace_complete(trace, config, state, input, output, result);
    return result;
}

size_t assist_run(const assist_config *config, assist_state *state, const assist_input *inputs,
                  assist_output *outputs, size_t count)
{
    size_t refused = 0;
    size_t index;

    for (index = 0; index < count; ++index) {
        if (assist_step(config, state, &inputs[index], &outputs[index])) refused += 1;
    }
    return refused;
}
