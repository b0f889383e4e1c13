/* What the mode asks for: off, the fixed law with its taper, or the fuzzy law.
 *
 * T_assist = ratio * (1 + gain) * T at the crank (thesis_checks I-14: on the rider's torque, never
 * on the assist of the step before, which would compound). The taper belongs to the fixed law and
 * not to the fuzzy one (thesis_checks I-13 and 4.2). A Japanese taper is a ceiling: the mode's
 * ratio holds until the ceiling comes down to it. */
#include "assist_steps.h" // apply_law
#include "float32.h"      // float32_min
#include "market.h"       // market_japan_ratio

static float taper_share(const assist_config *config, float speed_kmh)
{
    float span_kmh = config->fixed_taper_end_kmh - config->fixed_taper_start_kmh;

    if (speed_kmh <= config->fixed_taper_start_kmh) return 1.0f;
    if (speed_kmh >= config->fixed_taper_end_kmh) return 0.0f;
    return (config->fixed_taper_end_kmh - speed_kmh) / span_kmh;
}

static float fixed_ratio(const assist_config *config, uint8_t mode, float speed_kmh)
{
    float ratio = config->mode_ratios[mode];

    switch (config->mode_tapers[mode]) {
    case ASSIST_TAPER_NONE: return ratio;
    case ASSIST_TAPER_JAPAN_1_TO_1:
        return float32_min(ratio, market_japan_ratio_before_2008(speed_kmh));
    case ASSIST_TAPER_JAPAN_2_TO_1: return float32_min(ratio, market_japan_ratio(speed_kmh));
    default: return ratio * taper_share(config, speed_kmh);
    }
}

static float fuzzy_ratio(const assist_config *config, const assist_input *input, int falling,
                         assist_output *output)
{
    const fuzzy_table *table =
        config->mode_tables[input->mode] ? &config->second_table : &config->table;

    output->fuzzy_gain = 0.0f;
    if (!falling || !config->fuzzy_falling_torque) {
        (void)fuzzy_gain(table, input->speed_kmh, output->torque_rate,
                         &output->fuzzy_gain); /* both inputs are finite by now */
    }
    return config->mode_ratios[input->mode] * (1.0f + output->fuzzy_gain);
}

float apply_law(const assist_config *config, const assist_input *input, float earlier_torque_nm,
                assist_output *output)
{
    float torque_nm = output->rider_torque_filtered_nm;
    int tapered = 0;

    switch (config->mode_laws[input->mode]) {
    case ASSIST_LAW_FIXED:
        output->assist_ratio = fixed_ratio(config, input->mode, input->speed_kmh);
        tapered = output->assist_ratio < config->mode_ratios[input->mode];
        break;
    case ASSIST_LAW_FUZZY:
        output->assist_ratio = fuzzy_ratio(config, input, torque_nm < earlier_torque_nm, output);
        break;
    default: output->limit_flags |= ASSIST_LIMIT_MODE_OFF; break;
    }
    if (!push_counts(config, torque_nm)) return 0.0f;
    if (tapered) output->limit_flags |= ASSIST_LIMIT_TAPER;
    return output->assist_ratio * torque_nm;
}
