#include "rider.h"

#include <math.h>

#define RPM_PER_RAD_S (30.0 / 3.14159265358979323846)
#define CADENCE_FADE_RPM 10.0
#define STROKE_CADENCE_RPM 20.0

double rider_torque_nm(const rider_config *config, const rider_command *command,
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
    /* A rider brings a pedal level before pushing off, so a start never meets a dead spot. */
    const double share = fmin(fmax(cadence_rpm, 0.0) / STROKE_CADENCE_RPM, 1.0);
    const double ripple = config->stroke_ripple * share;
    return torque_nm * (1.0 - ripple * cos(2.0 * crank_angle_rad));
}

double rider_drag_nm(const rider_config *config, const rider_command *command)
{
    return command->kind == RIDER_OFF ? config->still_leg_drag_nm : 0.0;
}
