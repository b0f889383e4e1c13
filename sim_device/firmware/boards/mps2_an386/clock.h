/* The board's time: microseconds since boot from a timer that runs by itself.
 *
 * A test bench may take the clock in hand: then it stands, and time passes in the pieces that the
 * bench grants. */
#ifndef SPINDLE_MPS2_CLOCK_H
#define SPINDLE_MPS2_CLOCK_H

#include <stdint.h>

/* Time runs from now on, and an interrupt every 2 ms ends a sleep. */
void clock_open(void);

/* To be asked more often than every 171 s, when the timer comes round. */
uint64_t clock_now_us(void);

/* The timer itself, in microseconds, whoever has the clock in hand; comes round after 171 s. */
uint32_t clock_timer_us(void);

/* True while a test bench has the clock in hand. */
int clock_is_by_bench(void);

/* Back to 0, and not moving until the next grant. */
void clock_stop(void);

/* 1: the bench has the clock in hand and grants so much more; 0: the timer runs it. */
void clock_hand_over(int to_bench, uint32_t grant_us);

/* True while time passes, or can: a control step belongs to the time after it. */
int clock_runs(void);

/* Lets a millisecond of what was granted pass. False where nothing is left, or the timer runs. */
int clock_pass(void);

#endif
