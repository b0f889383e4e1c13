/* One direction of an asynchronous serial line, bit by bit where it matters: bytes leave at the
 * sender's rate and are sampled at the receiver's. Where the rates differ the receiver gets what a
 * real one gets: other bytes, another number of them, and zeros where a stop bit was missing. */
#ifndef SPINDLE_UART_LINE_H
#define SPINDLE_UART_LINE_H

#include <stddef.h>
#include <stdint.h>

#include "byte_queue.h" // byte_queue

/* What a UART with DMA holds: a little more than a fast line carries in a millisecond. */
#define UART_LINE_BYTES 256

typedef struct {
    byte_queue waiting;
    size_t waiting_max;
    double free_us; /* when the line has carried everything so far */

    /* The receiver, in the middle of a byte or between two. */
    uint8_t receiving;
    uint8_t level_before;
    uint8_t bits;
    uint8_t value;
    double sample_us;
} uart_line;

/* `waiting_max`: how many bytes the sender's side holds. */
void uart_line_init(uart_line *line, size_t waiting_max);

/* Returns how many bytes the sender's side took. */
size_t uart_line_send(uart_line *line, const uint8_t *bytes, size_t length);
size_t uart_line_room(const uart_line *line);

/* Whether everything sent has left the line. */
int uart_line_is_drained(const uart_line *line, uint64_t now_us);

/* Carries what leaves between two times into `arrived`; what does not fit there is lost. */
void uart_line_advance(uart_line *line, uint64_t from_us, uint64_t to_us, uint32_t sender_baud,
                       uint32_t receiver_baud, byte_queue *arrived);

#endif
