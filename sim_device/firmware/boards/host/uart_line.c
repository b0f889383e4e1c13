#include "uart_line.h"

#include <string.h>

#define BITS_PER_BYTE 10 /* start, eight, stop */
#define DATA_BITS 8
#define US_PER_S 1e6

/* A receiver samples the stop bit nine and a half bits after the edge: 5 % is half a bit. */
#define TOLERANCE 0.04

void uart_line_init(uart_line *line, size_t waiting_max)
{
    memset(line, 0, sizeof *line);
    line->waiting_max = waiting_max;
    line->level_before = 1;
}

size_t uart_line_room(const uart_line *line)
{
    return line->waiting.count < line->waiting_max ? line->waiting_max - line->waiting.count : 0;
}

size_t uart_line_send(uart_line *line, const uint8_t *bytes, size_t length)
{
    const size_t room = uart_line_room(line);
    return byte_queue_put(&line->waiting, bytes, length < room ? length : room);
}

int uart_line_is_drained(const uart_line *line, uint64_t now_us)
{
    return line->waiting.count == 0 && line->free_us <= (double)now_us;
}

static int rates_agree(uint32_t sender_baud, uint32_t receiver_baud)
{
    const double ratio = (double)sender_baud / (double)receiver_baud;
    return ratio > 1.0 - TOLERANCE && ratio < 1.0 + TOLERANCE;
}

/* Takes the sample that is due. Returns 1 when it ends a byte. */
static int sample(uart_line *line, uint8_t level, double bit_us, uint8_t *byte)
{
    line->sample_us += bit_us;
    line->bits++;
    if (line->bits == 1) {
        if (level == 1) line->receiving = 0; /* a spike and no start bit */
        return 0;
    }
    if (line->bits <= 1 + DATA_BITS) {
        line->value = (uint8_t)(line->value >> 1 | (level ? 0x80u : 0u));
        return 0;
    }
    line->receiving = 0;
    *byte = level ? line->value : 0;
    return 1;
}

/* The line is at `level` from one time to another. */
static void hold(uart_line *line, uint8_t level, double from_us, double to_us, double bit_us,
                 byte_queue *arrived)
{
    if (!line->receiving && level == 0 && line->level_before == 1) {
        line->receiving = 1;
        line->bits = 0;
        line->value = 0;
        line->sample_us = from_us + 0.5 * bit_us;
    }
    while (line->receiving && line->sample_us < to_us) {
        uint8_t byte = 0;
        if (sample(line, level, bit_us, &byte)) byte_queue_put(arrived, &byte, 1);
    }
    line->level_before = level;
}

static void carry(uart_line *line, uint8_t byte, double start_us, double sender_bit_us,
                  double bit_us, byte_queue *arrived)
{
    const uint32_t bits = 0x200u | (uint32_t)byte << 1;
    for (int k = 0; k < BITS_PER_BYTE; k++) {
        const double at_us = start_us + k * sender_bit_us;
        hold(line, bits >> k & 1u, at_us, at_us + sender_bit_us, bit_us, arrived);
    }
}

void uart_line_advance(uart_line *line, uint64_t from_us, uint64_t to_us, uint32_t sender_baud,
                       uint32_t receiver_baud, byte_queue *arrived)
{
    const double sender_bit_us = US_PER_S / (double)sender_baud;
    const double bit_us = US_PER_S / (double)receiver_baud;
    const int agree = rates_agree(sender_baud, receiver_baud) && !line->receiving;

    while (line->waiting.count > 0 && line->free_us < (double)to_us) {
        const double idle_us = line->free_us;
        uint8_t byte;
        if (line->free_us < (double)from_us) line->free_us = (double)from_us;
        byte_queue_take(&line->waiting, &byte, 1);
        if (agree) {
            byte_queue_put(arrived, &byte, 1);
        } else {
            hold(line, 1, idle_us, line->free_us, bit_us, arrived);
            carry(line, byte, line->free_us, sender_bit_us, bit_us, arrived);
        }
        line->free_us += BITS_PER_BYTE * sender_bit_us;
    }
    if (line->free_us < (double)to_us) hold(line, 1, line->free_us, (double)to_us, bit_us, arrived);
}
