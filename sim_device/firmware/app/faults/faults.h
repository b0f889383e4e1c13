/* What is wrong with the unit now, and what that forbids.
 *
 * A fault is set after a few bad control steps. One that only warns, or ends the assist while it
 * lasts, clears itself after many good ones. A latched one stays until the rider switches the unit
 * off, or until `faults_clear_latched` at standstill once its cause is gone: EN 15194 4.2.13 wants
 * no restart after a hazard without an action of the rider, and pedalling is none. */
#ifndef SPINDLE_FAULTS_H
#define SPINDLE_FAULTS_H

#include <stdint.h>

#include "ebl_registry.h" // EBL_FAULT_TORQUE_SENSOR, ebl_config
#include "hal.h"          // hal_inputs

/* One more than the highest bit; those that are never given have no cause and stay clear. */
#define FAULT_KINDS EBL_FAULT_BITS

/* What the bike did when a fault was last set. */
typedef struct {
    uint16_t count; /* how often it was set; 0: no frame */
    uint64_t t_us;
    int16_t row[EBL_CHANNEL_COUNT]; /* counts, in the order of ebl_channels */
} fault_frame;

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
} fault_watch;

typedef struct {
    uint32_t active; /* EBL_FAULT_* bits */
    uint32_t held;   /* those whose cause lasts until faults_clear */
    uint16_t bad_steps[FAULT_KINDS];
    uint16_t good_steps[FAULT_KINDS];
    fault_watch watch;
    fault_frame frames[FAULT_KINDS];
} fault_list;

/* What the unit makes of its inputs. By the law, in the step before: the torque the motor was told,
 * the rider's average, and whether there was no number to tell. By the wheel's pulses: speed. */
typedef struct {
    float motor_torque_nm;
    float rider_torque_filtered_nm;
    uint8_t lost;
    float speed_kmh;
} fault_law;

/* True if a bridge can give this reading: a number, and not pinned to the end of its word. */
int faults_torque_is_plausible(float torque_raw_counts);

/* Looks at one control step's inputs. The bits that changed go to `set` and `cleared`. */
void faults_step(fault_list *faults, const hal_inputs *inputs, const ebl_config *config,
                 const fault_law *law, uint32_t *set, uint32_t *cleared);

/* True while a fault forbids any torque. A configuration that was lost in part does not: it holds
 * the law to a walking pace. */
int faults_inhibit(const fault_list *faults);

/* Clears those of these latched faults whose cause is gone; to be called at standstill. Returns
 * the bits that were cleared. */
uint32_t faults_clear_latched(fault_list *faults, uint32_t flags);

/* A fault that does not come from the inputs. True if new. */
int faults_latch(fault_list *faults, uint32_t flag);

/* This one's cause lasts: nothing but `faults_clear` ends it. */
void faults_hold(fault_list *faults, uint32_t flag);

/* Returns those of the bits that were set. */
uint32_t faults_clear(fault_list *faults, uint32_t flags);

/* Keeps the latest row of telemetry for the faults that were just set. */
void faults_freeze(fault_list *faults, uint32_t set, uint64_t t_us, const int16_t *row);

/* Forgets the frames of these faults, but for those that are active. */
void faults_forget(fault_list *faults, uint32_t flags);

#endif
