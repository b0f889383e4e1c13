#include "faults.h"

#include <string.h>

/* The converter's word has 16 bits: at its ends a broken bridge arm looks like a strong rider. */
#define TORQUE_RAW_COUNTS_MAX 32767.0f

/* No e-bike goes faster; what does is a disturbed speed sensor. */
#define SPEED_KMH_MAX 150.0f

/* A pack under load recovers by about this much when the load goes: without the gap the fault
 * would flicker with every pedal stroke. */
#define BATTERY_RECOVERY_V 1.0f

#define SENSOR_BAD_STEPS 10  /* 0.1 s: shorter than a pedal stroke, longer than a spark */
#define BATTERY_BAD_STEPS 50 /* 0.5 s: a sag while starting is not an empty battery */
#define GOOD_STEPS 100       /* 1 s */

int faults_torque_is_plausible(float torque_raw_counts)
{
    return torque_raw_counts > -TORQUE_RAW_COUNTS_MAX && torque_raw_counts < TORQUE_RAW_COUNTS_MAX;
}

static int speed_is_plausible(float speed_kmh)
{
    return speed_kmh >= 0.0f && speed_kmh < SPEED_KMH_MAX;
}

/* Counts one step of one fault; `set` and `cleared` gain its bit when it changes. */
static void fault_count(fault_list *faults, uint8_t bit, int bad, uint16_t bad_steps_max,
                        uint16_t *set, uint16_t *cleared)
{
    uint16_t flag = (uint16_t)(1u << bit);

    if (bad) {
        faults->good_steps[bit] = 0;
        if (faults->bad_steps[bit] < bad_steps_max) faults->bad_steps[bit]++;
        if (faults->bad_steps[bit] < bad_steps_max || (faults->active & flag)) return;
        faults->active |= flag;
        *set |= flag;
    } else {
        faults->bad_steps[bit] = 0;
        if (faults->good_steps[bit] < GOOD_STEPS) faults->good_steps[bit]++;
        if (faults->good_steps[bit] < GOOD_STEPS || !(faults->active & flag)) return;
        faults->active &= (uint16_t)~flag;
        *cleared |= flag;
    }
}

void faults_step(fault_list *faults, const hal_inputs *inputs, float battery_voltage_v_min,
                 uint16_t *set, uint16_t *cleared)
{
    float battery_floor_v = battery_voltage_v_min;

    if (faults->active & EBL_FAULT_BATTERY_LOW) battery_floor_v += BATTERY_RECOVERY_V;
    *set = 0;
    *cleared = 0;
    fault_count(faults, 0, !faults_torque_is_plausible(inputs->torque_raw_counts), SENSOR_BAD_STEPS,
                set, cleared);
    fault_count(faults, 1, !speed_is_plausible(inputs->speed_kmh), SENSOR_BAD_STEPS, set, cleared);
    fault_count(faults, 2, !(inputs->battery_voltage_v >= battery_floor_v), BATTERY_BAD_STEPS, set,
                cleared);
}

int faults_latch(fault_list *faults, uint16_t flag)
{
    int is_new = (faults->active & flag) == 0;

    faults->active |= flag;
    return is_new;
}

int faults_clear(fault_list *faults, uint16_t flag)
{
    int was_set = (faults->active & flag) != 0;

    faults->active &= (uint16_t)~flag;
    return was_set;
}

void faults_freeze(fault_list *faults, uint16_t set, uint64_t t_us, const int16_t *row)
{
    for (size_t bit = 0; bit < FAULT_KINDS; bit++) {
        fault_frame *frame = &faults->frames[bit];

        if (!(set >> bit & 1u)) continue;
        if (frame->count < UINT16_MAX) frame->count++;
        frame->t_us = t_us;
        memcpy(frame->row, row, sizeof frame->row);
    }
}

void faults_forget(fault_list *faults, uint16_t flags)
{
    for (size_t bit = 0; bit < FAULT_KINDS; bit++) {
        if ((uint32_t)(flags & ~faults->active) >> bit & 1u) faults->frames[bit].count = 0;
    }
}
