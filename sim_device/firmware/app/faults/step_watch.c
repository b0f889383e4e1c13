#include "step_watch.h"

#include "ebl_registry.h" // EBL_CONTROL_PERIOD_US, EBL_RESET_CAUSE_DEADLINE

int steps_due(uint64_t *next_us, uint64_t now_us, uint64_t *step_us)
{
    uint64_t late_us;

    if (now_us < *next_us) return 0;
    late_us = now_us - *next_us;
    if (late_us >= STEPS_IN_A_ROW_MAX * EBL_CONTROL_PERIOD_US) {
        *next_us += late_us - late_us % EBL_CONTROL_PERIOD_US;
    }
    *step_us = *next_us;
    *next_us += EBL_CONTROL_PERIOD_US;
    return 1;
}

void step_watch_init(step_watch *watch, uint64_t now_us)
{
    const step_watch started = {0};

    *watch = started;
    watch->step_us = now_us;
}

uint32_t step_watch_begin(step_watch *watch, uint64_t now_us)
{
    uint64_t passed_us = now_us - watch->step_us;
    uint32_t missed = 0;

    if (watch->has_stepped && passed_us >= 2 * EBL_CONTROL_PERIOD_US) {
        missed = (uint32_t)(passed_us / EBL_CONTROL_PERIOD_US - 1);
    }
    watch->step_us = now_us;
    watch->has_stepped = 1;
    watch->steps_missed += missed;
    return missed;
}

void step_watch_done(step_watch *watch) { watch->is_proven = 1; }

void step_watch_poll(step_watch *watch, const hal *board, uint64_t now_us)
{
    if (watch->stopped) return;
    if (now_us > watch->step_us + STEP_DEADLINE_US) {
        watch->stopped = 1;
        board->motor_off(board->context, EBL_RESET_CAUSE_DEADLINE);
    } else if (watch->is_proven) {
        watch->is_proven = 0;
        board->watchdog_kick(board->context);
    }
}
