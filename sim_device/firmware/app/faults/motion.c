#include "motion.h"

#include "float32.h" // float32_abs, float32_is_finite, float32_max, float32_min

/* A motor told this little spins up too slowly for its speed to mean anything. */
#define DRIVING_TORQUE_NM 0.05f

/* The chain is on a bigger cog than the one in the configuration by a factor of three at most (42
 * for 14): what the motor drives beyond that, the wheel must show. A reading from six pulses a turn
 * is 1.5 km/h late while the bike gathers speed, and so it moves: one that stays is not late. */
#define MISMATCH_FACTOR 3.0f
#define MISMATCH_KMH 3.0f
#define MISMATCH_LATE_KMH 6.0f
#define MISMATCH_LATE_TURNS 1.5f

/* A pulse is timed to microseconds, and hardly a wheel turns five times in the same time, to one in
 * 4,000: legs and road see to that. With 0.02 km/h one magnet and even legs gave false alarms. On a
 * bench's servo it does, and there the motor's speed stays as well. */
#define STUCK_KMH 0.005f
#define STUCK_WHEEL_TURNS 5.0f

/* Neighbouring cogs differ by about a tenth: who keeps his cadence by shifting is seen as well. */
#define STUCK_GEAR_FACTOR 1.1f

/* 0.2 s: the ripple of Hall sensors a few degrees off their place is no change of speed. */
#define SMOOTHING_STEPS 20.0f

/* With half of it lost in cold grease, a motor of 1.4e-4 kg m2 reaches a quarter of any cadence
 * within half a second; an empty battery still turns it at half. */
#define HALL_TORQUE_NM 0.1f
#define HALL_CADENCE_RPM 10.0f
#define HALL_SHARE 0.25f

#define KMH_PER_M_PER_MIN 0.06f
#define STEPS_PER_MIN (60.0f * 1000000.0f / (float)EBL_CONTROL_PERIOD_US)

static float wheel_kmh(const ebl_config *config, float wheel_rpm)
{
    return wheel_rpm * config->wheel_circumference_m * KMH_PER_M_PER_MIN;
}

fault_sign fault_motion_mismatch(const fault_watch *watch, const hal_inputs *inputs,
                                 const ebl_config *config, const fault_law *law)
{
    float late_kmh = watch->kept_turns < MISMATCH_LATE_TURNS ? MISMATCH_LATE_KMH : MISMATCH_KMH;
    float crank_rpm = inputs->motor_speed_rpm / config->gear_ratio;
    float wheel_rpm = crank_rpm * (float)config->chainring_teeth / (float)config->cog_teeth;
    float driven_kmh = wheel_kmh(config, wheel_rpm);

    if (!(law->motor_torque_nm > DRIVING_TORQUE_NM)) return FAULT_SIGN_NONE;
    return fault_sign_of(driven_kmh > MISMATCH_FACTOR * law->speed_kmh + late_kmh);
}

/* The chain's speed, in turns of the motor, while it is driven; 0 otherwise. Motor and cranks each
 * push it through a clutch: what pushes is as fast as the chain, what does not is slower. */
static float chain_rpm(float before_rpm, const hal_inputs *inputs, const ebl_config *config,
                       const fault_law *law)
{
    float now_rpm = float32_max(inputs->cadence_rpm * config->gear_ratio, inputs->motor_speed_rpm);

    if (!(law->asked_torque_nm > DRIVING_TORQUE_NM) || !(now_rpm > 0.0f)) return 0.0f;
    if (!(before_rpm > 0.0f)) return now_rpm;
    return before_rpm + (now_rpm - before_rpm) / SMOOTHING_STEPS;
}

/* Notes whether the reading is still the one it was. */
static int speed_changed(fault_watch *watch, float speed_kmh, const ebl_config *config)
{
    if (!(float32_abs(speed_kmh - watch->kept_kmh) <= STUCK_KMH)) {
        watch->kept_kmh = speed_kmh;
        watch->kept_turns = 0.0f;
        return 1;
    }
    if (watch->kept_turns < STUCK_WHEEL_TURNS) {
        watch->kept_turns += watch->kept_kmh / wheel_kmh(config, STEPS_PER_MIN);
    }
    return 0;
}

fault_sign fault_motion_stuck(fault_watch *watch, const hal_inputs *inputs,
                              const ebl_config *config, const fault_law *law)
{
    int changed = speed_changed(watch, law->speed_kmh, config);
    float rpm_per_kmh;

    watch->chain_rpm = chain_rpm(changed ? 0.0f : watch->chain_rpm, inputs, config, law);
    /* A coasting bike keeps its gear: what drives it on must fit what drove it before. */
    if (changed) watch->gear_high_rpm_per_kmh = watch->gear_low_rpm_per_kmh;
    if (!(watch->kept_kmh > 0.0f)) watch->gear_low_rpm_per_kmh = 0.0f;
    if (!(watch->chain_rpm > 0.0f) || !(watch->kept_kmh > 0.0f)) return FAULT_SIGN_NONE;
    rpm_per_kmh = watch->chain_rpm / watch->kept_kmh;
    if (changed || !(watch->gear_low_rpm_per_kmh > 0.0f)) {
        watch->gear_low_rpm_per_kmh = rpm_per_kmh;
        watch->gear_high_rpm_per_kmh = rpm_per_kmh;
    }
    watch->gear_low_rpm_per_kmh = float32_min(watch->gear_low_rpm_per_kmh, rpm_per_kmh);
    watch->gear_high_rpm_per_kmh = float32_max(watch->gear_high_rpm_per_kmh, rpm_per_kmh);
    return fault_sign_of(watch->kept_turns >= STUCK_WHEEL_TURNS &&
                         watch->gear_high_rpm_per_kmh >
                             STUCK_GEAR_FACTOR * watch->gear_low_rpm_per_kmh);
}

fault_sign fault_motion_hall(const hal_inputs *inputs, const ebl_config *config,
                             const fault_law *law)
{
    float crank_rpm = inputs->cadence_rpm * config->gear_ratio;

    if (!float32_is_finite(inputs->motor_speed_rpm)) return FAULT_SIGN_BAD;
    if (!(law->motor_torque_nm > HALL_TORQUE_NM) || !(inputs->cadence_rpm > HALL_CADENCE_RPM)) {
        return FAULT_SIGN_NONE;
    }
    return fault_sign_of(inputs->motor_speed_rpm < HALL_SHARE * crank_rpm);
}
