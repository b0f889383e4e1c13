#include "byte_queue.h"

size_t byte_queue_free(const byte_queue *queue) { return BYTE_QUEUE_CAPACITY - queue->count; }

size_t byte_queue_put(byte_queue *queue, const uint8_t *bytes, size_t length)
{
    const size_t free_bytes = byte_queue_free(queue);
    const size_t taken = length < free_bytes ? length : free_bytes;
    for (size_t k = 0; k < taken; k++) {
        queue->bytes[(queue->first + queue->count + k) % BYTE_QUEUE_CAPACITY] = bytes[k];
    }
    queue->count += taken;
    return taken;
}

size_t byte_queue_take(byte_queue *queue, uint8_t *bytes, size_t capacity)
{
    const size_t taken = capacity < queue->count ? capacity : queue->count;
    for (size_t k = 0; k < taken; k++) {
        bytes[k] = queue->bytes[(queue->first + k) % BYTE_QUEUE_CAPACITY];
    }
    queue->first = (queue->first + taken) % BYTE_QUEUE_CAPACITY;
    queue->count -= taken;
    return taken;
}
