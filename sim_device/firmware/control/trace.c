/* The parts of a trace that need not be noted while the step runs, so that the step costs no more.
 */
#include "assist.h"       // ASSIST_OK
#include "assist_steps.h" // trace_complete, push_counts, walk_is_on
#include "float32.h"      // float32_min

/* Walk assist stands in the place of the whole law. */
static void trace_walk(assist_trace *trace)
{
    unsigned step;

    for (step = ASSIST_TRACE_RIDER; step < ASSIST_TRACE_FRESH; ++step) {
        trace->torque_nm[step] = trace->torque_nm[ASSIST_TRACE_FRESH];
    }
    trace->walk = 1;
}

static void trace_law(assist_trace *trace, const assist_config *config, uint8_t mode,
                      const assist_output *output)
{
    float torque_nm = output->rider_torque_filtered_nm;
    float asked_nm = output->assist_ratio * torque_nm;

    trace->torque_nm[ASSIST_TRACE_RIDER] = torque_nm;
    trace->torque_nm[ASSIST_TRACE_RATIO] = config->mode_ratios[mode] * torque_nm;
    trace->torque_nm[ASSIST_TRACE_SHAPED] = asked_nm;
    trace->torque_nm[ASSIST_TRACE_THRESHOLD] = push_counts(config, torque_nm) ? asked_nm : 0.0f;
    trace->walk = 0;
}

/* Each cut-off takes all of what is left to take. */
static void trace_cut_offs(assist_trace *trace)
{
    unsigned step;

    for (step = ASSIST_TRACE_PEDAL_STOP; step <= ASSIST_TRACE_INHIBIT; ++step) {
        unsigned cuts = trace->cut_offs >> (step - ASSIST_TRACE_PEDAL_STOP) & 1u;
        float left_nm = trace->torque_nm[step - 1];

        trace->torque_nm[step] = cuts ? float32_min(left_nm, 0.0f) : left_nm;
    }
}

/* A ramp up goes on from the torque that was given: while a limit holds, it is never more than a
 * step above that, whatever is asked. What holds then is the limit, as the limit flags say. */
static void trace_ramps(assist_trace *trace, const assist_config *config, float given_nm)
{
    float ramped_nm = trace->torque_nm[ASSIST_TRACE_RAMPS];
    float asked_nm = trace->torque_nm[ASSIST_TRACE_BAND];

    if (ramped_nm < asked_nm && given_nm < ramped_nm / config->gear_ratio) {
        trace->torque_nm[ASSIST_TRACE_RAMPS] = asked_nm;
    }
}

/* From the limits to what they leave. What is not held stays as it was, without the rounding of the
 * division by the gear ratio. */
static void trace_limits(assist_trace *trace, const assist_config *config, float given_nm)
{
    float shaft_nm = trace->torque_nm[ASSIST_TRACE_INHIBIT] / config->gear_ratio;
    unsigned step;

    trace->torque_nm[ASSIST_TRACE_MARKET] = given_nm;
    for (step = ASSIST_TRACE_MOTOR; step <= ASSIST_TRACE_MARKET; ++step) {
        float limit_nm = trace->torque_nm[step];

        trace->torque_nm[step] = trace->torque_nm[step - 1];
        if (limit_nm >= shaft_nm) continue;
        trace->torque_nm[step] = limit_nm * config->gear_ratio;
        shaft_nm = limit_nm;
    }
}

void trace_complete(assist_trace *trace, const assist_config *config, const assist_state *state,
                    const assist_input *input, const assist_output *output, int result)
{
    const assist_trace nothing = {0};

    if (result != ASSIST_OK) {
        *trace = nothing;
        return;
    }
    if (walk_is_on(state)) {
        trace_walk(trace);
    } else {
        trace_law(trace, config, input->mode, output);
    }
    trace_ramps(trace, config, output->motor_torque_nm);
    trace_cut_offs(trace);
    trace_limits(trace, config, output->motor_torque_nm);
}
