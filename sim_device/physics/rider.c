#include "rider.h"

#include <math.h>

#include "noise.h" // noise_gaussian

#define PI 3.14159265358979323846
#define RPM_PER_RAD_S (30.0 / PI)
#define CADENCE_FADE_RPM 10.0
#define STROKE_CADENCE_RPM 20.0

void rider_reset(const rider_config *config, rider_state *state)
{
    state->reserve_j = config->reserve_j;
    state->stroke_share = 1.0;
    state->stroke = 0;
}

static double stroke_share(const rider_config *config, rider_state *state, double crank_angle_rad)
{
    const int stroke = crank_angle_rad >= PI;
    if (config->stroke_noise > 0.0 && stroke != state->stroke) {
        const double share = 1.0 + config->stroke_noise * noise_gaussian(&state->random);
        state->stroke_share = fmax(share, 0.0);
    }
    state->stroke = stroke;
    return config->stroke_noise > 0.0 ? state->stroke_share : 1.0;
}

/* Legs give less the faster they turn and the less of the reserve is left. */
static double able_nm(const rider_config *config, const rider_state *state, double torque_nm,
                      double cadence_rpm)
{
    double most_nm = torque_nm;
    if (config->torque_nm_max > 0.0) {
        const double left = 1.0 - cadence_rpm / config->cadence_rpm_empty;
        most_nm = fmin(most_nm, config->torque_nm_max * fmax(left, 0.0));
    }
    if (config->critical_power_w > 0.0 && cadence_rpm > 0.0) {
        const double above_w = fmax(config->peak_power_w - config->critical_power_w, 0.0);
        const double most_w =
            config->critical_power_w + above_w * state->reserve_j / config->reserve_j;
        most_nm = fmin(most_nm, most_w * RPM_PER_RAD_S / cadence_rpm);
    }
    return most_nm;
}

double rider_torque_nm(const rider_config *config, rider_state *state, const rider_command *command,
                       double crank_angle_rad, double crank_speed_rad_s)
{
    if (command->kind == RIDER_OFF) {
        return 0.0;
    }
    const double direction = command->torque_nm < 0.0 ? -1.0 : 1.0;
    const double cadence_rpm = direction * crank_speed_rad_s * RPM_PER_RAD_S;
    const double reserve = (command->cadence_rpm_max - cadence_rpm) / CADENCE_FADE_RPM;
    const double torque_nm = command->torque_nm * fmin(fmax(reserve, 0.0), 1.0);
    if (command->kind == RIDER_CONSTANT) {
        return torque_nm;
    }
    const double mean_nm = able_nm(config, state, torque_nm, cadence_rpm);
    /* A rider brings a pedal level before pushing off, so a start never meets a dead spot. */
    const double share = fmin(fmax(cadence_rpm, 0.0) / STROKE_CADENCE_RPM, 1.0);
    const double angle_rad = crank_angle_rad - config->dead_spot_deg * PI / 180.0;
    const double ripple = config->stroke_ripple * cos(2.0 * angle_rad);
    const double uneven = config->asymmetry != 0.0 ? config->asymmetry * sin(angle_rad) : 0.0;
    const double shape = 1.0 - share * (ripple - uneven);
    return mean_nm * shape * stroke_share(config, state, crank_angle_rad);
}

double rider_drag_nm(const rider_config *config, const rider_command *command)
{
    return command->kind == RIDER_OFF ? config->still_leg_drag_nm : 0.0;
}

void rider_tire(const rider_config *config, rider_state *state, double power_w, double dt_s)
{
    if (!(config->critical_power_w > 0.0)) {
        return;
    }
    const double spare_w = config->critical_power_w - power_w;
    const double missing = 1.0 - state->reserve_j / config->reserve_j;
    const double change_w = spare_w < 0.0 ? spare_w : spare_w * missing;
    state->reserve_j = fmax(state->reserve_j + change_w * dt_s, 0.0);
}
