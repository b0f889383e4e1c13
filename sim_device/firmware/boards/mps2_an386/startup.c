#include "chip.h"
#include "uart.h" // uart_interrupt_host

/* From the linker script. */
extern uint32_t data_start[];
extern uint32_t data_end[];
extern const uint32_t data_image[];
extern uint32_t bss_start[];
extern uint32_t bss_end[];
extern uint32_t stack_top[];

int main(void);
void reset_handler(void);
void board_fault(void);
void board_watchdog_bites(void);
void board_tick(void);

void reset_handler(void)
{
    CHIP_COPROCESSOR_ACCESS |= CHIP_FPU_FULL_ACCESS;
    __asm volatile("dsb\n isb");
    /* To nearest, denormals and NaN as IEEE 754 has them: the host computes the same bits so. */
    __asm volatile("vmsr fpscr, %0" : : "r"(0u));
    for (uint32_t i = 0; data_start + i < data_end; i++) data_start[i] = data_image[i];
    for (uint32_t *word = bss_start; word < bss_end; word++) *word = 0;
    (void)main();
    for (;;) chip_sleep();
}

/* An image without a motor stops where a debugger finds it; one with a motor has its own. */
__attribute__((weak)) void board_fault(void)
{
    for (;;) chip_sleep();
}

__attribute__((weak)) void board_watchdog_bites(void) { board_fault(); }

__attribute__((weak)) void board_tick(void) {}

typedef void (*handler)(void);

#define CORE_VECTORS 16
#define BOARD_VECTORS 4

__attribute__((section(".vectors"), used)) static const handler vectors[] = {
    (handler)(uintptr_t)stack_top,
    reset_handler,
    board_watchdog_bites, /* NMI */
    board_fault,          /* hard fault */
    board_fault,          /* memory */
    board_fault,          /* bus */
    board_fault,          /* usage */
    0,
    0,
    0,
    0,
    board_fault, /* SVC */
    board_fault, /* debug */
    0,
    board_fault, /* PendSV */
    board_tick,  /* SysTick: wakes */
    uart_interrupt_host,
    uart_interrupt_host,
    uart_interrupt_plant,
    uart_interrupt_plant,
};

typedef char vectors_are_complete[sizeof vectors / sizeof vectors[0] == CORE_VECTORS + BOARD_VECTORS
                                      ? 1
                                      : -1];
