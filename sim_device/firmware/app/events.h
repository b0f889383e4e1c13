/* What the unit tells without being asked. */
#ifndef SPINDLE_EVENTS_H
#define SPINDLE_EVENTS_H

#include <stddef.h>
#include <stdint.h>

#include "link.h" // unit_link

typedef struct {
    uint16_t seq; /* of the next event; counts also those the line had no room for */
} event_log;

void event_boot(event_log *events, unit_link *link, uint64_t now_us, uint32_t boot_id);

/* `fault_flags`: only the bits that changed. */
void event_faults_set(event_log *events, unit_link *link, uint64_t now_us, uint16_t fault_flags);
void event_faults_cleared(event_log *events, unit_link *link, uint64_t now_us,
                          uint16_t fault_flags);

/* `code`: EBL_EVENT_CONFIG_COMMITTED, _ROLLED_BACK or _DEFAULTED. */
void event_config(event_log *events, unit_link *link, uint64_t now_us, uint8_t code,
                  uint32_t generation, uint32_t crc32);

void event_config_provisional(event_log *events, unit_link *link, uint64_t now_us,
                              uint32_t generation, uint32_t crc32, uint8_t confirm_s);

void event_stream_counts(event_log *events, unit_link *link, uint64_t now_us,
                         const ebl_stream_counts_event *counts);

/* `level`: what a token allows now, RIDER where it is over; `failures`: attempts since the last
 * good one. */
void event_auth_changed(event_log *events, unit_link *link, uint64_t now_us, uint8_t level,
                        uint16_t failures);

void event_log_closed(event_log *events, unit_link *link, uint64_t now_us, uint32_t log_id,
                      uint32_t generation, uint32_t length_bytes);

/* `overwritten`: how many unconfirmed logs were given up since boot, this one included. */
void event_log_overwritten(event_log *events, unit_link *link, uint64_t now_us, uint32_t log_id,
                           uint32_t generation, uint32_t overwritten);

#endif
