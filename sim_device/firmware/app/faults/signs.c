#include "signs.h"

#include "inputs.h"  // inputs_torque_is_plausible
#include "motion.h"  // fault_motion_mismatch
#include "float32.h" // float32_abs, float32_max, float32_min
#include "heat.h"    // HEAT_MOTOR_HOT_DEGC

/* No e-bike goes faster; what does is a disturbed speed sensor. */
#define SPEED_KMH_MAX 150.0f
#define SPEED_AGE_MS_MAX 1000u

/* A pack under load recovers by about this much when the load goes: without the gap the fault
 * would flicker with every pedal stroke. */
#define BATTERY_RECOVERY_V 1.0f

/* A sag of a worn pack ends above this; below, contacts or the bus give way. Ten cells at 2.7 V:
 * a dealer who cuts early (battery_voltage_v_min up to 40 V) breaks no supply. */
#define UNDER_VOLTAGE_BELOW_V 3.0f
#define UNDER_VOLTAGE_V_MAX 27.0f

/* Half as much again is no ripple of a current loop that works. The floor keeps the noise of a
 * sensor from being a fault where a dealer has lowered a limit far. */
#define OVER_CURRENT_FACTOR 1.5f
#define OVER_CURRENT_FLOOR_A 5.0f

/* thesis_checks 6: the last reading is held for 50 ms. */
#define TORQUE_HOLD_MS 50u

/* Legs vary by more than a newton metre in every turn; two counts are 0.02 Nm, less than the noise
 * of any amplifier that is alive (thesis_checks I-20: 0.06 Nm). A bench's servo pushes evenly for
 * ever, so only a reading that went up and down in three turns running is missed when it stops. */
#define STUCK_COUNTS 2.0f
#define LIVELY_TURNS 3u
#define STUCK_TURNS 5u
#define STUCK_RPM_MIN 5.0f

/* Cold moves the zero by about 1 Nm in 50 K (thesis_checks 6); three times that is a fault. What is
 * above the band is a foot or a calibration weight; so is what moves. */
#define DRIFT_NM 3.0f
#define DRIFT_NM_MAX 8.0f
#define DRIFT_STEPS 500u
#define DRIFT_STILL_NM 0.3f
#define REST_RPM 1.0f

/* With the pedals free for so long after switching on, what is felt later is a rider's wish. */
#define FREE_STEPS 10u

#define S_PER_MIN 60.0f
#define STEP_S ((float)EBL_CONTROL_PERIOD_US / 1000000.0f)

static fault_sign speed_sign(const hal_inputs *inputs, const fault_law *law)
{
    return fault_sign_of(!(law->speed_kmh >= 0.0f && law->speed_kmh < SPEED_KMH_MAX) ||
                         inputs->speed_age_ms > SPEED_AGE_MS_MAX);
}

static fault_sign battery_low_sign(uint32_t active, const hal_inputs *inputs,
                                   const ebl_config *config)
{
    float floor_v = config->battery_voltage_v_min;

    if (active & EBL_FAULT_BATTERY_LOW) floor_v += BATTERY_RECOVERY_V;
    return fault_sign_of(!(inputs->battery_voltage_v >= floor_v));
}

static fault_sign current_sign(const hal_inputs *inputs, const ebl_config *config)
{
    float motor_a = config->motor_torque_nm_max / config->motor_torque_constant_nm_per_a;
    float motor_a_max = OVER_CURRENT_FACTOR * motor_a;
    float battery_a_max = OVER_CURRENT_FACTOR * config->battery_current_a_max;

    return fault_sign_of(
        float32_abs(inputs->motor_current_a) > float32_max(motor_a_max, OVER_CURRENT_FLOOR_A) ||
        float32_abs(inputs->battery_current_a) > float32_max(battery_a_max, OVER_CURRENT_FLOOR_A));
}

/* Hot sets it, and only what has cooled to where the assist is whole again is good. */
static fault_sign heat_sign(uint32_t active, uint32_t flag, float temperature_degc, float warm_degc,
                            float hot_degc)
{
    return fault_sign_of(temperature_degc >= ((active & flag) ? warm_degc : hot_degc));
}

static void turn_begin(fault_watch *watch, float raw_counts)
{
    watch->crank_turns = 0.0f;
    watch->raw_low_counts = raw_counts;
    watch->raw_high_counts = raw_counts;
    watch->rose = 0;
    watch->fell = 0;
}

static void turn_end(fault_watch *watch)
{
    int lively = watch->rose && watch->fell;

    if (lively) {
        if (watch->lively_turns < LIVELY_TURNS) watch->lively_turns++;
    } else if (watch->lively_turns < LIVELY_TURNS) {
        watch->lively_turns = 0;
    }
    if (watch->rose || watch->fell) {
        watch->still_turns = 0;
    } else if (watch->still_turns < STUCK_TURNS) {
        watch->still_turns++;
    }
}

static fault_sign stuck_sign(fault_watch *watch, const hal_inputs *inputs, const fault_law *law)
{
    float raw = inputs->torque_raw_counts;

    if (!(law->asked_torque_nm > 0.0f) || !(inputs->cadence_rpm > STUCK_RPM_MIN)) {
        watch->still_turns = 0;
        turn_begin(watch, raw);
        return FAULT_SIGN_NONE;
    }
    watch->raw_low_counts = float32_min(watch->raw_low_counts, raw);
    watch->raw_high_counts = float32_max(watch->raw_high_counts, raw);
    if (raw - watch->raw_low_counts >= STUCK_COUNTS) watch->rose = 1;
    if (watch->raw_high_counts - raw >= STUCK_COUNTS) watch->fell = 1;
    watch->crank_turns += inputs->cadence_rpm / S_PER_MIN * STEP_S;
    if (watch->crank_turns >= 1.0f) {
        turn_end(watch);
        turn_begin(watch, raw);
    }
    return fault_sign_of(watch->lively_turns == LIVELY_TURNS && watch->still_turns == STUCK_TURNS);
}

static int is_standing(const hal_inputs *inputs, const fault_law *law)
{
    return float32_abs(law->speed_kmh) < EBL_RESTING_KMH &&
           float32_abs(inputs->cadence_rpm) < REST_RPM;
}

static fault_sign drift_sign(fault_watch *watch, const hal_inputs *inputs, const fault_law *law)
{
    float torque_nm = law->rider_torque_filtered_nm;
    int resting = is_standing(inputs, law) && inputs->torque_age_ms <= TORQUE_HOLD_MS &&
                  inputs_torque_is_plausible(inputs->torque_raw_counts);

    if (!resting) {
        watch->rest_steps = 0;
        return FAULT_SIGN_NONE;
    }
    if (watch->rest_steps == 0) {
        watch->rest_low_nm = torque_nm;
        watch->rest_high_nm = torque_nm;
    }
    watch->rest_low_nm = float32_min(watch->rest_low_nm, torque_nm);
    watch->rest_high_nm = float32_max(watch->rest_high_nm, torque_nm);
    if (watch->rest_high_nm - watch->rest_low_nm > DRIFT_STILL_NM) {
        watch->rest_steps = 0;
        return FAULT_SIGN_NONE;
    }
    if (watch->rest_steps < DRIFT_STEPS) {
        watch->rest_steps++;
        return FAULT_SIGN_NONE;
    }
    if (float32_abs(torque_nm) > DRIFT_NM_MAX) return FAULT_SIGN_NONE;
    return fault_sign_of(float32_abs(torque_nm) > DRIFT_NM);
}

/* At a standstill what is beyond the band of a zero that moved is a foot. It was there at switching
 * on if the pedals have not been free since. A broken sensor tells of no foot, and a torque that is
 * no number neither of one nor of free pedals. */
static fault_sign foot_sign(fault_watch *watch, uint32_t active, const hal_inputs *inputs,
                            const fault_law *law)
{
    float torque_nm = float32_abs(law->rider_torque_nm);

    if (active & EBL_FAULT_TORQUE_SENSOR) return FAULT_SIGN_GOOD;
    if (active & EBL_FAULT_FOOT_AT_START) {
        /* What a foot leaves behind that stays is a zero that moved, and is told as that. */
        float left_nm = (active & EBL_FAULT_TORQUE_DRIFT) ? DRIFT_NM_MAX : DRIFT_NM;

        watch->has_started = 1;
        return fault_sign_of(!(torque_nm <= left_nm));
    }
    if (!is_standing(inputs, law)) watch->has_started = 1;
    if (watch->has_started) return FAULT_SIGN_NONE;
    if (torque_nm > DRIFT_NM_MAX) {
        watch->free_steps = 0;
        return FAULT_SIGN_BAD;
    }
    if (torque_nm <= DRIFT_NM_MAX) watch->free_steps++;
    if (watch->free_steps >= FREE_STEPS) watch->has_started = 1;
    return FAULT_SIGN_GOOD;
}

static void sign_set(fault_sign *signs, uint32_t flag, fault_sign sign)
{
    signs[__builtin_ctz(flag)] = sign;
}

void fault_signs(fault_watch *watch, uint32_t active, const hal_inputs *inputs,
                 const ebl_config *config, const fault_law *law, fault_sign *signs)
{
    int fresh = inputs->torque_age_ms <= TORQUE_HOLD_MS;
    float deep_v =
        float32_min(config->battery_voltage_v_min - UNDER_VOLTAGE_BELOW_V, UNDER_VOLTAGE_V_MAX);

    for (unsigned bit = 0; bit < FAULT_KINDS; bit++) signs[bit] = FAULT_SIGN_NONE;
    if (fresh) {
        sign_set(signs, EBL_FAULT_TORQUE_SENSOR,
                 fault_sign_of(!inputs_torque_is_plausible(inputs->torque_raw_counts)));
        sign_set(signs, EBL_FAULT_TORQUE_STUCK, stuck_sign(watch, inputs, law));
    }
    sign_set(signs, EBL_FAULT_SPEED_SENSOR, speed_sign(inputs, law));
    sign_set(signs, EBL_FAULT_BATTERY_LOW, battery_low_sign(active, inputs, config));
    sign_set(signs, EBL_FAULT_OVER_CURRENT, current_sign(inputs, config));
    sign_set(signs, EBL_FAULT_UNDER_VOLTAGE, fault_sign_of(inputs->battery_voltage_v < deep_v));
    sign_set(signs, EBL_FAULT_BATTERY_CUT, fault_sign_of(inputs->battery_cut));
    sign_set(signs, EBL_FAULT_MOTOR_TEMPERATURE,
             heat_sign(active, EBL_FAULT_MOTOR_TEMPERATURE, inputs->motor_temperature_degc,
                       HEAT_MOTOR_WARM_DEGC, HEAT_MOTOR_HOT_DEGC));
    sign_set(signs, EBL_FAULT_CONTROLLER_TEMPERATURE,
             heat_sign(active, EBL_FAULT_CONTROLLER_TEMPERATURE,
                       inputs->controller_temperature_degc, HEAT_CONTROLLER_WARM_DEGC,
                       HEAT_CONTROLLER_HOT_DEGC));
    sign_set(signs, EBL_FAULT_TORQUE_DRIFT, drift_sign(watch, inputs, law));
    sign_set(signs, EBL_FAULT_FOOT_AT_START, foot_sign(watch, active, inputs, law));
    sign_set(signs, EBL_FAULT_TORQUE_LINK, fault_sign_of(!fresh));
    sign_set(signs, EBL_FAULT_SPEED_MISMATCH, fault_motion_mismatch(watch, inputs, config, law));
    sign_set(signs, EBL_FAULT_SPEED_STUCK, fault_motion_stuck(watch, inputs, config, law));
    sign_set(signs, EBL_FAULT_MOTOR_HALL, fault_motion_hall(inputs, config, law));
    sign_set(signs, EBL_FAULT_LAW_RESULT, fault_sign_of(law->lost));
}
