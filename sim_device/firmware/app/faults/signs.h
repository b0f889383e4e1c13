/* What one control step says about each fault. faults.c counts these signs. */
#ifndef SPINDLE_FAULT_SIGNS_H
#define SPINDLE_FAULT_SIGNS_H

#include "faults.h" // fault_list, fault_law

/* NONE: this step cannot tell. */
typedef enum { FAULT_SIGN_GOOD = 0, FAULT_SIGN_BAD = 1, FAULT_SIGN_NONE = 2 } fault_sign;

static inline fault_sign fault_sign_of(int bad) { return bad ? FAULT_SIGN_BAD : FAULT_SIGN_GOOD; }

/* One sign for each fault, by its bit. Follows what takes several steps in faults->watch. */
void fault_signs(fault_list *faults, const hal_inputs *inputs, const ebl_config *config,
                 const fault_law *law, fault_sign *signs);

#endif
