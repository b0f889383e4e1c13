/* Bytes in order of arrival, as many as fit: one direction of a serial line in memory. */
#ifndef SPINDLE_BYTE_QUEUE_H
#define SPINDLE_BYTE_QUEUE_H

#include <stddef.h>
#include <stdint.h>

#define BYTE_QUEUE_CAPACITY 8192

typedef struct {
    uint8_t bytes[BYTE_QUEUE_CAPACITY];
    size_t first;
    size_t count;
} byte_queue;

size_t byte_queue_free(const byte_queue *queue);

/* Both return how many bytes were moved. */
size_t byte_queue_put(byte_queue *queue, const uint8_t *bytes, size_t length);
size_t byte_queue_take(byte_queue *queue, uint8_t *bytes, size_t capacity);

#endif
