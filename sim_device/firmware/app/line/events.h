/* What the unit tells without being asked. */
#ifndef SPINDLE_EVENTS_H
#define SPINDLE_EVENTS_H

#include <stddef.h>
#include <stdint.h>

#include "storage/config_store.h" // config_store
#include "hal.h"                  // hal
#include "link.h"                 // unit_link

#define EVENTS_KEPT_MAX 8
#define EVENT_KEPT_BYTES_MAX 17 /* code, time, and 12 bytes of fields */

/* An event that matters: it is sent again until the host has it, or newer ones took its place. */
typedef struct {
    uint16_t seq;
    uint8_t length;
    uint8_t payload[EVENT_KEPT_BYTES_MAX];
} kept_event;

typedef struct {
    uint16_t seq;     /* of the next event; counts also those the line had no room for */
    uint8_t attended; /* a host is there: repeating makes sense */
    uint8_t kept_count;
    uint16_t pushed_out; /* kept events given up for newer ones since boot */
    uint64_t repeat_us;
    kept_event kept[EVENTS_KEPT_MAX]; /* the oldest first */
} event_log;

/* A host came, or left. */
void events_attend(event_log *events, int attended, uint64_t now_us);

/* The host has this one. */
void events_acknowledge(event_log *events, uint16_t seq);

/* Sends again what was not acknowledged. */
void events_poll(event_log *events, unit_link *link, uint64_t now_us);

void event_boot(event_log *events, unit_link *link, uint64_t now_us, const hal *board);

/* `fault_flags`: only the bits that changed. */
void event_faults_set(event_log *events, unit_link *link, uint64_t now_us, uint32_t fault_flags);
void event_faults_cleared(event_log *events, unit_link *link, uint64_t now_us,
                          uint32_t fault_flags);

/* `code`: EBL_EVENT_CONFIG_COMMITTED, _ROLLED_BACK or _DEFAULTED. */
void event_config(event_log *events, unit_link *link, uint64_t now_us, uint8_t code,
                  uint32_t generation, uint32_t crc32);

void event_config_provisional(event_log *events, unit_link *link, uint64_t now_us,
                              uint32_t generation, uint32_t crc32, uint8_t confirm_s);

/* What the boot made of an image of other firmware; the counts of `store->tally`. */
void event_config_converted(event_log *events, unit_link *link, uint64_t now_us,
                            const config_store *store);

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
