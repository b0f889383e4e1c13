/* Raw counts to newton metres: a straight line through the reading without load, whose offset and
 * slope each move in proportion to the sensor's temperature. */
#include "assist.h"       // assist_rider_torque_run
#include "assist_steps.h" // sensor_torque_nm
#include "float32.h"      // float32_abs

/* No sensor on a bike is further from its reference; a thermometer that says so is broken. */
static const float WARMER_K_MAX = 200.0f;

/* A coefficient that is not known corrects nothing. */
static float change(float per_k, float warmer_k)
{
    return per_k == per_k ? per_k * warmer_k : 0.0f;
}

float sensor_torque_nm(const assist_config *config, const assist_input *input)
{
    float counts = input->torque_raw_counts - config->sensor_offset_counts;
    float warmer_k = input->sensor_temperature_degc - config->sensor_reference_degc;

    /* A NaN compares false: temperature or reference is not known. */
    if (!(float32_abs(warmer_k) <= WARMER_K_MAX)) return counts * config->sensor_gain_nm_per_count;
    counts -= change(config->sensor_offset_counts_per_k, warmer_k);
    return counts * config->sensor_gain_nm_per_count *
           (1.0f + change(config->sensor_gain_share_per_k, warmer_k));
}

void assist_rider_torque_run(const assist_config *config, const float *torque_raw_counts,
                             const float *sensor_temperature_degc, float *rider_torque_nm,
                             size_t count)
{
    assist_input input = {0};
    size_t index;

    for (index = 0; index < count; ++index) {
        input.torque_raw_counts = torque_raw_counts[index];
        input.sensor_temperature_degc = sensor_temperature_degc[index];
        rider_torque_nm[index] = sensor_torque_nm(config, &input);
    }
}
