/* What is wrong with the unit now: set after a few bad control steps, cleared after many good. */
#ifndef SPINDLE_FAULTS_H
#define SPINDLE_FAULTS_H

#include <stdint.h>

#include "assist.h"       // assist_config
#include "ebl_registry.h" // EBL_FAULT_TORQUE_SENSOR
#include "hal.h"          // hal_inputs

#define FAULT_KINDS 4

/* What the bike did when a fault was last set. */
typedef struct {
    uint16_t count; /* how often it was set; 0: no frame */
    uint64_t t_us;
    int16_t row[EBL_CHANNEL_COUNT]; /* counts, in the order of ebl_channels */
} fault_frame;

typedef struct {
    uint16_t active; /* EBL_FAULT_* bits */
    uint16_t bad_steps[FAULT_KINDS];
    uint16_t good_steps[FAULT_KINDS];
    fault_frame frames[FAULT_KINDS];
} fault_list;

/* True if a bridge can give this reading: a number, and not pinned to the end of its word. */
int faults_torque_is_plausible(float torque_raw_counts);

/* Looks at one control step's inputs. The bits that changed go to `set` and `cleared`. */
void faults_step(fault_list *faults, const hal_inputs *inputs, float battery_voltage_v_min,
                 uint16_t *set, uint16_t *cleared);

/* A fault that does not come from the inputs and stays until `faults_clear`. True if new. */
int faults_latch(fault_list *faults, uint16_t flag);
int faults_clear(fault_list *faults, uint16_t flag);

/* Keeps the latest row of telemetry for the faults that were just set. */
void faults_freeze(fault_list *faults, uint16_t set, uint64_t t_us, const int16_t *row);

/* Forgets the frames of these faults, but for those that are active. */
void faults_forget(fault_list *faults, uint16_t flags);

#endif
