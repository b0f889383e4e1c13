/* What faults are told by: what the unit makes of its inputs, what it has followed over several
 * steps, and what one step says of one fault. */
#ifndef SPINDLE_EVIDENCE_H
#define SPINDLE_EVIDENCE_H

#include <stdint.h>

#include "ebl_registry.h" // EBL_FAULT_BITS

/* One more than the highest bit; those that are never given have no cause and stay clear. */
#define FAULT_KINDS EBL_FAULT_BITS

/* What takes longer than a step to see. */
typedef struct {
    float raw_low_counts; /* of the torque reading, in this turn of the cranks under power */
    float raw_high_counts;
    float crank_turns; /* of this turn, 0 to 1 */
    uint8_t rose;      /* in this turn the reading went up, and down */
    uint8_t fell;
    uint8_t lively_turns; /* in a row in which it did both */
    uint8_t still_turns;  /* in a row in which it did neither */
    float kept_kmh; /* what the speed sensor keeps saying, and for how many turns of the wheel */
    float kept_turns;
    float chain_rpm; /* in turns of the motor, smoothed; 0 while nothing drives the chain */
    float gear_low_rpm_per_kmh; /* both, since the reading changed; 0: not yet known */
    float gear_high_rpm_per_kmh;
    float rest_low_nm; /* of the averaged torque, since the bike came to rest */
    float rest_high_nm;
    uint16_t rest_steps;
    uint8_t free_steps;  /* since switching on, without a load on the pedals */
    uint8_t has_started; /* the pedals were free, or the bike moved: no foot of the start is left */
} fault_watch;

/* What the unit makes of its inputs. By the law, in the step before: the torque the motor was told,
 * what it was told or asked for (more, where the crank outruns it: the legs drive then), the
 * rider's average, and whether there was no number to tell. By the wheel's pulses: speed. */
typedef struct {
    float rider_torque_nm; /* unfiltered, from the stored zero; NaN: none */
    float motor_torque_nm;
    float asked_torque_nm;
    float rider_torque_filtered_nm;
    uint8_t lost;
    float speed_kmh;
} fault_law;

/* NONE: this step cannot tell. */
typedef enum { FAULT_SIGN_GOOD = 0, FAULT_SIGN_BAD = 1, FAULT_SIGN_NONE = 2 } fault_sign;

static inline fault_sign fault_sign_of(int bad) { return bad ? FAULT_SIGN_BAD : FAULT_SIGN_GOOD; }

#endif
