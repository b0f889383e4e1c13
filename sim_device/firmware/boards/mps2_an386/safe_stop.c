#include "safe_stop.h"

#include "chip.h"         // CHIP_RESET
#include "ebl_registry.h" // EBL_RESET_CAUSE_WATCHDOG
#include "plant.h"        // plant_motor_off
#include "watchdog.h"     // watchdog_open

#define NOTE_MAGIC 0x53544F50u

/* Kept over a reset. After power on it holds anything: a note counts with its complement alone. */
typedef struct {
    uint32_t cause; /* NOTE_MAGIC ^ ebl_reset_cause */
    uint32_t complement;
} cause_note;

__attribute__((section(".kept"))) static volatile cause_note note;

void board_fault(void);
void board_watchdog_bites(void);
void board_tick(void);

uint8_t safe_stop_open(void)
{
    uint32_t cause = note.cause ^ NOTE_MAGIC;
    int is_noted = note.complement == ~note.cause && cause <= EBL_RESET_CAUSE_SOFTWARE;

    note.cause = 0;
    note.complement = 0;
    watchdog_open();
    return is_noted ? (uint8_t)cause : EBL_RESET_CAUSE_POWER_ON;
}

/* What was noted first is the cause; what follows from it is not. */
void safe_stop_note(uint8_t cause)
{
    plant_motor_off();
    if (note.complement == ~note.cause) return;
    note.cause = NOTE_MAGIC ^ cause;
    note.complement = ~note.cause;
}

static void stop_and_start_anew(uint8_t cause)
{
    safe_stop_note(cause);
    __asm volatile("dsb");
    CHIP_RESET = CHIP_RESET_ASK;
    for (;;) {
    }
}

void board_fault(void) { stop_and_start_anew(EBL_RESET_CAUSE_FAULT_HANDLER); }

void board_watchdog_bites(void) { stop_and_start_anew(EBL_RESET_CAUSE_WATCHDOG); }

void board_tick(void) { plant_motor_tick(); }
