/* What is wrong with the unit now, and what that forbids.
 *
 * A fault is set after a few bad control steps. One that only warns, or ends the assist while it
 * lasts, clears itself after many good ones. A latched one stays until the rider switches the unit
 * off, or until `faults_clear_latched` at standstill once its cause is gone: EN 15194 4.2.13 wants
 * no restart after a hazard without an action of the rider, and pedalling is none. */
#ifndef SPINDLE_FAULTS_H
#define SPINDLE_FAULTS_H

#include <stdint.h>

#include "ebl_registry.h" // EBL_CHANNEL_COUNT, ebl_config
#include "evidence.h"     // FAULT_KINDS, fault_watch, fault_law
#include "hal.h"          // hal_inputs

/* What the bike did when a fault was last set. */
typedef struct {
    uint16_t count; /* how often it was set; 0: no frame */
    uint64_t t_us;
    int16_t row[EBL_CHANNEL_COUNT]; /* counts, in the order of ebl_channels */
} fault_frame;

typedef struct {
    uint32_t active; /* EBL_FAULT_* bits */
    uint32_t held;   /* those whose cause lasts until faults_clear */
    uint16_t bad_steps[FAULT_KINDS];
    uint16_t good_steps[FAULT_KINDS];
    fault_watch watch;
    fault_frame frames[FAULT_KINDS];
} fault_list;

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
