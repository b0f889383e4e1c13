/* What a stream costs on the line, and what the line has for all of them. */
#ifndef SPINDLE_STREAM_BUDGET_H
#define SPINDLE_STREAM_BUDGET_H

#include <stddef.h>
#include <stdint.h>

#define STREAM_HEAD_LENGTH 6 /* t0_us u32, rows u8, flags u8 */

/* Bytes a second of the line at most, stuffing and delimiters included. A divider or batch of 0
 * costs nothing. */
uint32_t stream_bytes_per_s(size_t channel_count, uint8_t batch, uint16_t divider);

/* What all streams may take together: the rest is for answers, events and logs. */
uint32_t stream_budget_bytes_per_s(uint32_t baud);

/* The largest whole rate in rows a second that fits into `bytes_per_s`; 0 where not even one. */
uint16_t stream_rate_hz_max(uint32_t bytes_per_s, size_t channel_count, uint8_t batch);

#endif
