#include "uart.h"

#include "chip.h" // CHIP_UART0

/* Powers of two, so that free-running counts wrap without a division. */
#define RECEIVE_BYTES 2048u
#define SEND_BYTES 1024u

typedef struct {
    chip_uart *port;
    uint8_t received[RECEIVE_BYTES];
    uint8_t sent[SEND_BYTES];
    volatile uint32_t received_in; /* bytes ever put in, and taken out */
    volatile uint32_t received_out;
    volatile uint32_t sent_in;
    volatile uint32_t sent_out;
} ring_pair;

static ring_pair lines[UART_COUNT];

/* A byte that finds the ring full is left in the port: the next one then overruns, and the frame's
 * check value tells. */
static void receive(ring_pair *line, uint32_t state)
{
    if ((state & CHIP_UART_RX_FULL) == 0) return;
    if (line->received_in - line->received_out == RECEIVE_BYTES) return;
    line->received[line->received_in % RECEIVE_BYTES] = (uint8_t)line->port->data;
    chip_hand_over();
    line->received_in++;
}

static void send(ring_pair *line, uint32_t state)
{
    while ((state & CHIP_UART_TX_FULL) == 0 && line->sent_in != line->sent_out) {
        line->port->data = line->sent[line->sent_out % SEND_BYTES];
        chip_hand_over();
        line->sent_out++;
        state = line->port->state;
    }
}

/* Clears first and looks then: a byte that comes in between raises the interrupt again. */
static void serve(ring_pair *line)
{
    uint32_t state;

    line->port->interrupts = CHIP_UART_PENDING_ALL;
    state = line->port->state;
    if ((state & CHIP_UART_RX_OVERRUN) != 0) line->port->state = CHIP_UART_RX_OVERRUN;
    receive(line, state);
    send(line, state);
}

void uart_interrupt_host(void) { serve(&lines[UART_HOST]); }

void uart_interrupt_plant(void) { serve(&lines[UART_PLANT]); }

void uart_baud_set(uart_line line, uint32_t baud)
{
    lines[line].port->baud_divider = CHIP_CLOCK_HZ / baud;
}

int uart_is_drained(uart_line line)
{
    const ring_pair *ring = &lines[line];

    return ring->sent_in == ring->sent_out && (ring->port->state & CHIP_UART_TX_FULL) == 0;
}

void uart_open(uart_line line, uint32_t baud)
{
    chip_uart *port = line == UART_HOST ? CHIP_UART0 : CHIP_UART1;

    lines[line].port = port;
    uart_baud_set(line, baud);
    port->control = CHIP_UART_CONTROL_ALL;
    chip_hand_over();
    CHIP_INTERRUPT_ENABLE = CHIP_UART_INTERRUPTS;
}

size_t uart_read(uart_line line, uint8_t *bytes, size_t capacity)
{
    ring_pair *ring = &lines[line];
    size_t taken = 0;

    while (taken < capacity && ring->received_in != ring->received_out) {
        chip_hand_over();
        bytes[taken++] = ring->received[ring->received_out % RECEIVE_BYTES];
        chip_hand_over();
        ring->received_out++;
    }
    /* A byte that found the ring full waits in the port and interrupts no more. */
    chip_interrupts_off();
    receive(ring, ring->port->state);
    chip_interrupts_on();
    return taken;
}

size_t uart_writable(uart_line line)
{
    return SEND_BYTES - (lines[line].sent_in - lines[line].sent_out);
}

size_t uart_write(uart_line line, const uint8_t *bytes, size_t length)
{
    ring_pair *ring = &lines[line];
    size_t space = uart_writable(line);
    size_t taken = length < space ? length : space;

    for (size_t i = 0; i < taken; i++) {
        ring->sent[(ring->sent_in + i) % SEND_BYTES] = bytes[i];
    }
    chip_hand_over();
    chip_interrupts_off();
    ring->sent_in += (uint32_t)taken;
    send(ring, ring->port->state);
    chip_interrupts_on();
    return taken;
}

/* With interrupts off a pending one still ends the sleep: none can slip in before it. */
void uart_sleep(uart_line line)
{
    chip_interrupts_off();
    if (lines[line].received_in == lines[line].received_out) chip_sleep();
    chip_interrupts_on();
}
