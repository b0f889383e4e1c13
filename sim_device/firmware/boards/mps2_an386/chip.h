/* What this board uses of the AN386's Cortex-M4 and its CMSDK peripherals (Arm AN386, ARM DDI 0479,
 * ARM DDI 0403). */
#ifndef SPINDLE_MPS2_CHIP_H
#define SPINDLE_MPS2_CHIP_H

#include <stdint.h>

#define CHIP_CLOCK_HZ 25000000u

/* CMSDK APB UART. */
typedef struct {
    volatile uint32_t data;
    volatile uint32_t state;
    volatile uint32_t control;
    volatile uint32_t interrupts; /* reads: pending; writing a bit clears it */
    volatile uint32_t baud_divider;
} chip_uart;

#define CHIP_UART_TX_FULL 1u
#define CHIP_UART_RX_FULL 2u
#define CHIP_UART_RX_OVERRUN 8u
#define CHIP_UART_CONTROL_ALL 0xFu /* send, receive, and an interrupt for each */
#define CHIP_UART_PENDING_ALL 0xFu

#define CHIP_UART0 ((chip_uart *)0x40004000u)
#define CHIP_UART1 ((chip_uart *)0x40005000u)

/* CMSDK APB timer: counts down and starts again from `reload`. */
typedef struct {
    volatile uint32_t control;
    volatile uint32_t value;
    volatile uint32_t reload;
    volatile uint32_t interrupts;
} chip_timer;

#define CHIP_TIMER0 ((chip_timer *)0x40000000u)

/* CMSDK APB watchdog: counts down from `load`; at 0 an NMI, and once more to 0 a reset. */
typedef struct {
    volatile uint32_t load;
    volatile uint32_t value;
    volatile uint32_t control;
    volatile uint32_t clear; /* any value: the interrupt is over, the count starts again */
} chip_watchdog;

#define CHIP_WATCHDOG ((chip_watchdog *)0x40008000u)
#define CHIP_WATCHDOG_RUN 3u /* with interrupt and reset */
#define CHIP_WATCHDOG_LOCK (*(volatile uint32_t *)0x40008C00u)
#define CHIP_WATCHDOG_UNLOCK 0x1ACCE551u

typedef struct {
    volatile uint32_t control;
    volatile uint32_t reload;
    volatile uint32_t value;
} chip_systick;

#define CHIP_SYSTICK ((chip_systick *)0xE000E010u)
#define CHIP_SYSTICK_RUN 7u /* enabled, with its interrupt, on the processor's clock */

#define CHIP_INTERRUPT_ENABLE (*(volatile uint32_t *)0xE000E100u)
#define CHIP_UART_INTERRUPTS 0xFu /* 0 to 3: UART0 receive and send, UART1 receive and send */
#define CHIP_COPROCESSOR_ACCESS (*(volatile uint32_t *)0xE000ED88u)
#define CHIP_FPU_FULL_ACCESS 0xF00000u

#define CHIP_RESET (*(volatile uint32_t *)0xE000ED0Cu)
#define CHIP_RESET_ASK 0x05FA0004u

static inline void chip_interrupts_off(void) { __asm volatile("cpsid i" ::: "memory"); }
static inline void chip_interrupts_on(void) { __asm volatile("cpsie i" ::: "memory"); }
/* What was read and written before is done before what follows: to stand between the bytes of a
 * ring and the count that hands them over. `volatile` orders the counts among themselves only. */
static inline void chip_hand_over(void) { __asm volatile("dmb" ::: "memory"); }

static inline void chip_sleep(void) { __asm volatile("wfi" ::: "memory"); }

#endif
