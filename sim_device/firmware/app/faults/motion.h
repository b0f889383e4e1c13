/* What motor, cranks and wheel say of each other's speed: signs of faults that no reading shows
 * alone. */
#ifndef SPINDLE_FAULT_MOTION_H
#define SPINDLE_FAULT_MOTION_H

#include "ebl_registry.h" // ebl_config
#include "evidence.h"     // fault_sign, fault_watch, fault_law
#include "hal.h"          // hal_inputs

/* The motor drives the chain far faster than the wheel is said to turn. */
fault_sign fault_motion_mismatch(const fault_watch *watch, const hal_inputs *inputs,
                                 const ebl_config *config, const fault_law *law);

/* The speed does not change although the motor that drives the wheel does. */
fault_sign fault_motion_stuck(fault_watch *watch, const hal_inputs *inputs,
                              const ebl_config *config, const fault_law *law);

/* The motor is told to push and does not turn, or cannot say. */
fault_sign fault_motion_hall(const hal_inputs *inputs, const ebl_config *config,
                             const fault_law *law);

#endif
