/* Raw counts to newton metres: a straight line through the reading without load. */
#include "assist_steps.h" // sensor_torque_nm

float sensor_torque_nm(const assist_config *config, float torque_raw_counts)
{
    return (torque_raw_counts - config->sensor_offset_counts) * config->sensor_gain_nm_per_count;
}
