#include "faults.h"

#include <string.h>

#include "signs.h" // fault_signs

#define GOOD_STEPS 100 /* 1 s */

/* Bad control steps of 10 ms until a fault is set. What a sign itself has waited for takes one. */
static uint16_t bad_steps_max(uint32_t flag)
{
    switch (flag) {
    case EBL_FAULT_OVER_CURRENT: return 2;     /* the bridge's own trip is faster than any step */
    case EBL_FAULT_UNDER_VOLTAGE: return 5;    /* 50 ms: a contact that bounces is shorter */
    case EBL_FAULT_BATTERY_LOW: return 50;     /* 0.5 s: a sag while starting is not empty */
    case EBL_FAULT_TORQUE_LINK: return 20;     /* with the hold 0.25 s: the ramp is over by then */
    case EBL_FAULT_SPEED_MISMATCH: return 100; /* 1 s: a wheel that slips, a pulse that is late */
    case EBL_FAULT_FOOT_AT_START: return 100; /* 1 s: whoever rides off at once has moved by then */
    case EBL_FAULT_MOTOR_HALL: return 50;     /* 0.5 s: a motor spins up in less */
    case EBL_FAULT_LAW_RESULT:
    case EBL_FAULT_BATTERY_CUT:
    case EBL_FAULT_TORQUE_STUCK:
    case EBL_FAULT_TORQUE_DRIFT: return 1;
    default: return 10; /* 0.1 s: shorter than a pedal stroke, longer than a spark */
    }
}

/* Counts one step of one fault; `set` and `cleared` gain its bit when it changes. A latched fault
 * that a step cannot judge has no cause any more, for whoever clears it. */
static void fault_count(fault_list *faults, unsigned bit, fault_sign sign, uint32_t *set,
                        uint32_t *cleared)
{
    uint32_t flag = 1u << bit;
    int latched = (flag & EBL_FAULTS_LATCHED) != 0;

    if (sign == FAULT_SIGN_NONE && !latched) return;
    if (sign == FAULT_SIGN_BAD) {
        faults->good_steps[bit] = 0;
        if (faults->bad_steps[bit] < bad_steps_max(flag)) faults->bad_steps[bit]++;
        if (faults->bad_steps[bit] < bad_steps_max(flag) || (faults->active & flag)) return;
        faults->active |= flag;
        *set |= flag;
    } else {
        faults->bad_steps[bit] = 0;
        if (faults->good_steps[bit] < GOOD_STEPS) faults->good_steps[bit]++;
        if (faults->good_steps[bit] < GOOD_STEPS || !(faults->active & flag) || latched) return;
        faults->active &= ~flag;
        *cleared |= flag;
    }
}

void faults_step(fault_list *faults, const hal_inputs *inputs, const ebl_config *config,
                 const fault_law *law, uint32_t *set, uint32_t *cleared)
{
    fault_sign signs[FAULT_KINDS];

    *set = 0;
    *cleared = 0;
    fault_signs(&faults->watch, faults->active, inputs, config, law, signs);
    for (unsigned bit = 0; bit < FAULT_KINDS; bit++) {
        fault_count(faults, bit, signs[bit], set, cleared);
    }
}

int faults_inhibit(const fault_list *faults)
{
    const uint32_t slows_only = EBL_FAULT_CONFIG_DEFAULTED;

    return (faults->active & EBL_FAULTS_ASSIST_OFF & ~slows_only) != 0;
}

uint32_t faults_clear_latched(fault_list *faults, uint32_t flags)
{
    uint32_t cleared = 0;

    for (unsigned bit = 0; bit < FAULT_KINDS; bit++) {
        uint32_t flag = 1u << bit;

        if (!(flags & faults->active & EBL_FAULTS_LATCHED & ~faults->held & flag)) continue;
        if (faults->good_steps[bit] < GOOD_STEPS) continue;
        faults->active &= ~flag;
        cleared |= flag;
    }
    return cleared;
}

int faults_latch(fault_list *faults, uint32_t flag)
{
    int is_new = (faults->active & flag) == 0;

    faults->active |= flag;
    return is_new;
}

void faults_hold(fault_list *faults, uint32_t flag) { faults->held |= flag; }

uint32_t faults_clear(fault_list *faults, uint32_t flags)
{
    uint32_t were_set = faults->active & flags;

    faults->active &= ~flags;
    faults->held &= ~flags;
    return were_set;
}

void faults_freeze(fault_list *faults, uint32_t set, uint64_t t_us, const int16_t *row)
{
    for (size_t bit = 0; bit < FAULT_KINDS; bit++) {
        fault_frame *frame = &faults->frames[bit];

        if (!(set >> bit & 1u)) continue;
        if (frame->count < UINT16_MAX) frame->count++;
        frame->t_us = t_us;
        memcpy(frame->row, row, sizeof frame->row);
    }
}

void faults_forget(fault_list *faults, uint32_t flags)
{
    for (size_t bit = 0; bit < FAULT_KINDS; bit++) {
        if ((flags & ~faults->active) >> bit & 1u) faults->frames[bit].count = 0;
    }
}
