/* What is wrong with the unit now: set after a few bad control steps, cleared after many good. */
#ifndef SPINDLE_FAULTS_H
#define SPINDLE_FAULTS_H

#include <stdint.h>

#include "assist.h"       // assist_config
#include "ebl_registry.h" // EBL_FAULT_TORQUE_SENSOR
#include "hal.h"          // hal_inputs

#define FAULT_KINDS 4

typedef struct {
    uint16_t active; /* EBL_FAULT_* bits */
    uint16_t bad_steps[FAULT_KINDS];
    uint16_t good_steps[FAULT_KINDS];
} fault_list;

/* True if a bridge can give this reading: a number, and not pinned to the end of its word. */
int faults_torque_is_plausible(float torque_raw_counts);

/* Looks at one control step's inputs. The bits that changed go to `set` and `cleared`. */
void faults_step(fault_list *faults, const hal_inputs *inputs, float battery_voltage_v_min,
                 uint16_t *set, uint16_t *cleared);

/* A fault that does not come from the inputs and stays until `faults_clear`. True if new. */
int faults_latch(fault_list *faults, uint16_t flag);
int faults_clear(fault_list *faults, uint16_t flag);

#endif
