#include "clock.h"

#include "chip.h" // CHIP_TIMER0

#define TICKS_PER_US (CHIP_CLOCK_HZ / 1000000u)
#define WAKE_PERIOD_TICKS (CHIP_CLOCK_HZ / 500u)
#define PASS_US 1000u

typedef struct {
    uint32_t value; /* the timer's, when it was last read */
    uint64_t ticks; /* of time since boot */
    int by_bench;
    uint32_t granted_us;
} clock_state;

static clock_state now;

void clock_open(void)
{
    CHIP_TIMER0->reload = UINT32_MAX;
    CHIP_TIMER0->value = UINT32_MAX;
    CHIP_TIMER0->control = 1;
    now.value = UINT32_MAX;
    CHIP_SYSTICK->reload = WAKE_PERIOD_TICKS - 1;
    CHIP_SYSTICK->value = 0;
    CHIP_SYSTICK->control = CHIP_SYSTICK_RUN;
}

uint64_t clock_now_us(void)
{
    uint32_t value = CHIP_TIMER0->value;

    if (!now.by_bench) now.ticks += now.value - value;
    now.value = value;
    return now.ticks / TICKS_PER_US;
}

uint32_t clock_timer_us(void) { return (UINT32_MAX - CHIP_TIMER0->value) / TICKS_PER_US; }

int clock_is_by_bench(void) { return now.by_bench; }

void clock_stop(void)
{
    now.by_bench = 1;
    now.granted_us = 0;
    now.ticks = 0;
}

void clock_hand_over(int to_bench, uint32_t grant_us)
{
    (void)clock_now_us();
    now.by_bench = to_bench;
    now.granted_us = to_bench ? now.granted_us + grant_us : 0;
}

int clock_runs(void) { return !now.by_bench || now.granted_us >= PASS_US; }

int clock_pass(void)
{
    if (now.granted_us < PASS_US) return 0;
    now.granted_us -= PASS_US;
    now.ticks += (uint64_t)PASS_US * TICKS_PER_US;
    return 1;
}
