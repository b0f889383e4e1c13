/* The board's way to a motor without torque when the program fails: watchdog, fault handlers,
 * reset.
 *
 * A watchdog that nobody kicks for SAFE_STOP_WATCHDOG_US raises the NMI, which no program masks:
 * the motor's stage goes off, the cause is noted in memory that a reset leaves alone, and the chip
 * starts anew. Should even that hang, the watchdog itself resets the chip after the same time. */
#ifndef SPINDLE_MPS2_SAFE_STOP_H
#define SPINDLE_MPS2_SAFE_STOP_H

#include <stdint.h>

/* 100 ms would do for a product, whose longest poll takes 17 ms; the computer that emulates this
 * one is sometimes elsewhere for longer. */
#define SAFE_STOP_WATCHDOG_US 500000u

/* Starts the watchdog. Returns why the board started, an ebl_reset_cause. */
uint8_t safe_stop_open(void);

void safe_stop_kick(void);

/* From any context: motor off, and the cause of the start that the watchdog will make. */
void safe_stop_note(uint8_t cause);

#endif
