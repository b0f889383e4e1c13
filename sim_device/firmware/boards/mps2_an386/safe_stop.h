/* The board's way to a motor without torque when the program fails: watchdog, fault handlers,
 * reset.
 *
 * A watchdog that nobody kicks for WATCHDOG_US (watchdog.h) raises the NMI, which no program masks:
 * the motor's stage goes off, the cause is noted in memory that a reset leaves alone, and the chip
 * starts anew. Should even that hang, the watchdog itself resets the chip after the same time. */
#ifndef SPINDLE_MPS2_SAFE_STOP_H
#define SPINDLE_MPS2_SAFE_STOP_H

#include <stdint.h>

/* Starts the watchdog. Returns why the board started, an ebl_reset_cause. */
uint8_t safe_stop_open(void);

/* From any context: motor off, and the cause of the start that the watchdog will make. */
void safe_stop_note(uint8_t cause);

#endif
