/* Faults that came and went: told to the host and written into the ride's log. */
#ifndef SPINDLE_REPORT_H
#define SPINDLE_REPORT_H

#include <stdint.h>

#include "unit.h" // app

/* Only the bits that changed, at least one. */
void report_faults_set(app *unit, uint32_t set, uint64_t now_us);
void report_faults_cleared(app *unit, uint32_t cleared, uint64_t now_us);

#endif
