#include "stream_budget.h"

#include "ebl_frame.h"    // EBL_HEADER_LENGTH, ebl_wire_length_max
#include "ebl_registry.h" // EBL_CONTROL_PERIOD_US

#define US_PER_S 1000000u
#define BITS_PER_BYTE 10u /* start, eight, stop */
#define BUDGET_PCT 80u
#define STEPS_PER_S (US_PER_S / EBL_CONTROL_PERIOD_US)

uint32_t stream_bytes_per_s(size_t channel_count, uint8_t batch, uint16_t divider)
{
    size_t frame = EBL_HEADER_LENGTH + STREAM_HEAD_LENGTH + batch * channel_count * 2;
    uint64_t period_us = (uint64_t)divider * EBL_CONTROL_PERIOD_US * batch;

    if (period_us == 0) return 0;
    return (uint32_t)((ebl_wire_length_max(frame) * US_PER_S + period_us - 1) / period_us);
}

uint32_t stream_budget_bytes_per_s(uint32_t baud)
{
    return baud / BITS_PER_BYTE / 100u * BUDGET_PCT;
}

uint16_t stream_rate_hz_max(uint32_t bytes_per_s, size_t channel_count, uint8_t batch)
{
    for (uint16_t divider = 1; divider <= STEPS_PER_S; divider++) {
        if (stream_bytes_per_s(channel_count, batch, divider) <= bytes_per_s) {
            return (uint16_t)(STEPS_PER_S / divider);
        }
    }
    return 0;
}
