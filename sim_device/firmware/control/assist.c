/* The pipeline. Read assist_step from top to bottom: the way from the spindle to the motor. */
#include "assist.h"

#include "assist_steps.h" // apply_law to apply_limits
#include "float32.h"      // float32_abs, float32_missing

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
    output->limit_flags = 0;
}

static int refuse(assist_state *state, assist_output *output)
{
    state->assist_torque_nm = 0.0f;
    state->pedal_steps_left = 0; /* nobody saw whether the rider still pedals */
    walk_refuse(state);
    output->limit_flags = ASSIST_LIMIT_INPUT_REFUSED;
    return ASSIST_INPUT_REFUSED;
}

static float apply_sensor(const assist_config *config, assist_state *state,
                          const assist_input *input, assist_output *output)
{
    float earlier_torque_nm;

    if (torque_is_fresh(input)) {
        output->rider_torque_nm = sensor_torque_nm(config, input->torque_raw_counts);
        state->torque_filtered_nm =
            stroke_average_nm(config, state->torque_filtered_nm, output->rider_torque_nm);
        market_push_note(config, state, output->rider_torque_nm);
    }
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

int assist_step(const assist_config *config, assist_state *state, const assist_input *input,
                assist_output *output)
{
    float earlier_torque_nm;
    float demand_nm;

    output_clear(state, output);
    if (input_refused(input)) return refuse(state, output);

    earlier_torque_nm = apply_sensor(config, state, input, output);
    demand_nm = apply_mode(config, state, input, earlier_torque_nm, output);
    demand_nm = apply_cutoff_band(config, input, demand_nm, output);
    demand_nm = apply_ramps(config, input, state->assist_torque_nm, demand_nm, output);
    demand_nm = apply_cutoffs(config, state, input, demand_nm, output);
    demand_nm = apply_limits(config, state, input, demand_nm, output);
    output->motor_torque_nm = apply_market(config, state, input, demand_nm, output);
    state->assist_torque_nm = output->motor_torque_nm * config->gear_ratio;
    return ASSIST_OK;
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
