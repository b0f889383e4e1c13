/* Whether control steps come in time and the poll loop lives: what the watchdog is kicked for.
 *
 * A kick needs both since the one before: a control step that was done, and a poll that came to its
 * end. Where polls go on and steps do not for STEP_DEADLINE_US, the motor is switched off by
 * hardware and nothing is kicked any more, so the board starts anew. */
#ifndef SPINDLE_STEP_WATCH_H
#define SPINDLE_STEP_WATCH_H

#include <stdint.h>

#include "hal.h" // hal

#define STEP_DEADLINE_US 100000u

/* Control steps in a row that make up for a computer that was busy. Whoever is later gives the
 * older ones up: a burst of them would act on one and the same reading. */
#define STEPS_IN_A_ROW_MAX 3u

typedef struct {
    uint64_t step_us;      /* when the latest control step was due, or the start */
    uint32_t steps_missed; /* since the start */
    uint8_t has_stepped;   /* ever, */
    uint8_t is_proven;     /* and since the latest kick */
    uint8_t stopped;
} step_watch;

/* For a board's loop: 1 if a control step is due, its time to `step_us`. `next_us` is the loop's,
 * when the next one is due. */
int steps_due(uint64_t *next_us, uint64_t now_us, uint64_t *step_us);

void step_watch_init(step_watch *watch, uint64_t now_us);

/* A control step begins: how many were missed since the one before. And it is done. */
uint32_t step_watch_begin(step_watch *watch, uint64_t now_us);
void step_watch_done(step_watch *watch);

/* The end of a poll: kicks the watchdog, or stops the motor for good. */
void step_watch_poll(step_watch *watch, const hal *board, uint64_t now_us);

#endif
