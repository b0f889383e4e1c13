/* The chip's watchdog: whoever does not kick it for WATCHDOG_US gets its interrupt, and after the
 * same time again a reset. */
#ifndef SPINDLE_MPS2_WATCHDOG_H
#define SPINDLE_MPS2_WATCHDOG_H

/* 100 ms would do for a product, whose longest poll takes 17 ms; the computer that emulates this
 * one is sometimes elsewhere for longer. */
#define WATCHDOG_US 500000u

void watchdog_open(void);
void watchdog_kick(void);

#endif
