/* The board's two serial lines: a ring for each direction, filled and emptied by interrupts. */
#ifndef SPINDLE_MPS2_UART_H
#define SPINDLE_MPS2_UART_H

#include <stddef.h>
#include <stdint.h>

typedef enum {
    UART_HOST = 0,  /* the product's line */
    UART_PLANT = 1, /* the test bench's: stands for sensors and motor */
    UART_COUNT = 2
} uart_line;

void uart_open(uart_line line, uint32_t baud);

/* Takes effect at once: what has not left goes out at the new rate. */
void uart_baud_set(uart_line line, uint32_t baud);

/* Whether all that was written has been handed to the line. */
int uart_is_drained(uart_line line);

/* Both return how many bytes were moved, without waiting. */
size_t uart_read(uart_line line, uint8_t *bytes, size_t capacity);
size_t uart_write(uart_line line, const uint8_t *bytes, size_t length);

/* Bytes that uart_write would take now. */
size_t uart_writable(uart_line line);

/* Sleeps until an interrupt, unless the line has brought something already. */
void uart_sleep(uart_line line);

/* For the vector table. */
void uart_interrupt_host(void);
void uart_interrupt_plant(void);

#endif
