/* What one control step says about each fault. faults.c counts these signs. */
#ifndef SPINDLE_FAULT_SIGNS_H
#define SPINDLE_FAULT_SIGNS_H

#include "ebl_registry.h" // ebl_config
#include "evidence.h"     // fault_sign, fault_watch, fault_law
#include "hal.h"          // hal_inputs

/* One sign for each fault, by its bit. `active`: the faults there are, which some signs outlast.
 * Follows what takes several steps in `watch`. */
void fault_signs(fault_watch *watch, uint32_t active, const hal_inputs *inputs,
                 const ebl_config *config, const fault_law *law, fault_sign *signs);

#endif
