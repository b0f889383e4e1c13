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

void reset_handler(void)
{
    CHIP_COPROCESSOR_ACCESS |= CHIP_FPU_FULL_ACCESS;
    __asm volatile("dsb\n isb");
    for (uint32_t i = 0; data_start + i < data_end; i++) data_start[i] = data_image[i];
    for (uint32_t *word = bss_start; word < bss_end; word++) *word = 0;
    (void)main();
    for (;;) chip_sleep();
}

/* A fault stops the unit where a debugger finds it; the motor's stage has lost its control step and
 * lets go by itself. */
static void fault_handler(void)
{
    for (;;) chip_sleep();
}

static void tick_handler(void) {}

typedef void (*handler)(void);

#define CORE_VECTORS 16
#define BOARD_VECTORS 4

__attribute__((section(".vectors"), used)) static const handler vectors[] = {
    (handler)(uintptr_t)stack_top,
    reset_handler,
    fault_handler, /* NMI */
    fault_handler, /* hard fault */
    fault_handler, /* memory */
    fault_handler, /* bus */
    fault_handler, /* usage */
    0,
    0,
    0,
    0,
    fault_handler, /* SVC */
    fault_handler, /* debug */
    0,
    fault_handler, /* PendSV */
    tick_handler,  /* SysTick: only wakes */
    uart_interrupt_host,
    uart_interrupt_host,
    uart_interrupt_plant,
    uart_interrupt_plant,
};

typedef char vectors_are_complete[sizeof vectors / sizeof vectors[0] == CORE_VECTORS + BOARD_VECTORS
                                      ? 1
                                      : -1];
