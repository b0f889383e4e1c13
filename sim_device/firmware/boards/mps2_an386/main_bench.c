/* The host's bench board inside the microcontroller, for the tests that the host build passes.
 *
 * A test rig calls the image's functions by their addresses: it writes function and arguments to
 * memory that it shares with QEMU and rings on the second serial line; the board calls, writes the
 * result and rings back. What crosses the product's serial line crosses the first line here. */
#include <stddef.h>
#include <stdint.h>

#include "bench_board.h" // bench_send
#include "chip.h"        // chip_interrupts_on
#include "uart.h"        // uart_read

#define BAUD 1000000u
#define ARGUMENTS 8 /* an even number: result lies on eight bytes */

typedef struct {
    uint32_t number; /* of this call, written last */
    uint32_t function;
    uint32_t arguments[ARGUMENTS];
    float floats[2];
    uint32_t gives_float;
    uint32_t done; /* number of the latest call that was answered */
    uint64_t result;
    float float_result;
} call_registers;

#define CALL ((volatile call_registers *)0x21010000u)

/* The rig's board and the buffers of its lines are the only heap. */
#define HEAP_START 0x21200000u
#define HEAP_END 0x22000000u

typedef uint64_t (*whole_function)(uint32_t, uint32_t, uint32_t, uint32_t, uint32_t, uint32_t,
                                   uint32_t, uint32_t, float, float);
typedef float (*float_function)(uint32_t, uint32_t, uint32_t, uint32_t, uint32_t, uint32_t,
                                uint32_t, uint32_t, float, float);

static uint8_t line[BENCH_LINE_BYTES];

void *_sbrk(ptrdiff_t increment);
uint32_t rig_line_in(bench_board *board, uint32_t length);
uint32_t rig_line_out(bench_board *board, uint32_t capacity);

void *_sbrk(ptrdiff_t increment)
{
    static uintptr_t end = HEAP_START;
    uintptr_t before = end;

    if (end + (uintptr_t)increment > HEAP_END) return (void *)-1;
    end += (uintptr_t)increment;
    return (void *)before;
}

/* Takes so many bytes from the first line, as soon as they are there, for the unit. */
uint32_t rig_line_in(bench_board *board, uint32_t length)
{
    uint32_t taken = 0;

    while (taken < length && taken < sizeof line) {
        uint32_t more = (uint32_t)uart_read(UART_HOST, line + taken, sizeof line - taken);

        taken += more;
        if (more == 0) uart_sleep(UART_HOST);
    }
    return (uint32_t)bench_send(board, line, taken);
}

uint32_t rig_line_out(bench_board *board, uint32_t capacity)
{
    uint32_t length = (uint32_t)bench_receive(board, line, capacity);
    uint32_t sent = 0;

    while (sent < length) sent += (uint32_t)uart_write(UART_HOST, line + sent, length - sent);
    return length;
}

static void call(void)
{
    uint32_t a[ARGUMENTS];
    float f = CALL->floats[0];
    float g = CALL->floats[1];
    uintptr_t function = CALL->function;

    for (int i = 0; i < ARGUMENTS; i++) a[i] = CALL->arguments[i];
    if (CALL->gives_float) {
        CALL->float_result =
            ((float_function)function)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], f, g);
    } else {
        CALL->result =
            ((whole_function)function)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], f, g);
    }
    CALL->done = CALL->number;
}

int main(void)
{
    static const uint8_t bell = 1;
    uint8_t bells[16];

    uart_open(UART_HOST, BAUD);
    uart_open(UART_PLANT, BAUD);
    chip_interrupts_on();
    for (;;) {
        (void)uart_read(UART_PLANT, bells, sizeof bells);
        if (CALL->number == CALL->done) {
            uart_sleep(UART_PLANT);
            continue;
        }
        call();
        (void)uart_write(UART_PLANT, &bell, sizeof bell);
    }
}
