/* Why a control step gave what it gave: the torque that each step of the pipeline left, in the
 * pipeline's order. For previews and for explaining rides; a unit on the bike does not ask. */
#ifndef SPINDLE_ASSIST_TRACE_H
#define SPINDLE_ASSIST_TRACE_H

#include <stdint.h>

#define ASSIST_TRACE_STEPS 17

/* The first five are of the mode's law, T = ratio * (1 + gain) * rider; where walk assist takes its
 * place all five are what walk assist asks for. */
enum {
    ASSIST_TRACE_RIDER = 0,  /* the rider's filtered torque */
    ASSIST_TRACE_RATIO,      /* times the mode's ratio */
    ASSIST_TRACE_SHAPED,     /* times 1 + gain, or the fixed law's taper, or 0 in a mode off */
    ASSIST_TRACE_THRESHOLD,  /* 0 below the least pedal torque */
    ASSIST_TRACE_FRESH,      /* 0 where the torque reading is too old */
    ASSIST_TRACE_BAND,       /* soft ramp below the cut-off speed */
    ASSIST_TRACE_RAMPS,      /* a ramp down gives; a ramp up counts only where no limit does */
    ASSIST_TRACE_PEDAL_STOP, /* from here on no step leaves more than the one before */
    ASSIST_TRACE_BRAKE,
    ASSIST_TRACE_SPEED,
    ASSIST_TRACE_VOLTAGE,
    ASSIST_TRACE_INHIBIT,
    ASSIST_TRACE_MOTOR,
    ASSIST_TRACE_HEAT,
    ASSIST_TRACE_BATTERY,
    ASSIST_TRACE_BACK_EMF,
    ASSIST_TRACE_MARKET /* what the motor is told */
};

/* At the crank. The last differs from what the motor is told, times the gear ratio, by no more than
 * the rounding of a division. A refused input and a lost result leave zeros only. */
typedef struct {
    float torque_nm[ASSIST_TRACE_STEPS];
    uint8_t cut_offs; /* bit n: ASSIST_TRACE_PEDAL_STOP + n is at work, taken anything or not */
    uint8_t walk;     /* walk assist asked, not the mode's law */
} assist_trace;

#endif
