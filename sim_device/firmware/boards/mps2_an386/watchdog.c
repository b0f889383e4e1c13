#include "watchdog.h"

#include "chip.h" // CHIP_WATCHDOG

#define WATCHDOG_TICKS (CHIP_CLOCK_HZ / 1000000u * WATCHDOG_US)

void watchdog_open(void)
{
    CHIP_WATCHDOG_LOCK = CHIP_WATCHDOG_UNLOCK;
    CHIP_WATCHDOG->load = WATCHDOG_TICKS;
    CHIP_WATCHDOG->control = CHIP_WATCHDOG_RUN;
    CHIP_WATCHDOG_LOCK = 0;
}

void watchdog_kick(void)
{
    CHIP_WATCHDOG_LOCK = CHIP_WATCHDOG_UNLOCK;
    CHIP_WATCHDOG->clear = 1;
    CHIP_WATCHDOG_LOCK = 0;
}
