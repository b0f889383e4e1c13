#include "events.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_put_u32
#include "ebl_frame.h"    // EBL_HEADER_LENGTH, ebl_header_put
#include "ebl_layout.h"   // EBL_MESSAGE, ebl_layout_put
#include "ebl_registry.h" // ebl_boot_event

#define EVENT_CHANNEL 0
#define EVENT_HEAD_LENGTH 5 /* code u8, time u32 */
#define EVENT_FIELDS_LENGTH_MAX 18

/* Twice what the slowest adapter and a full line take for an event and its acknowledgement. */
#define REPEAT_US 250000u

static int frame_send(unit_link *link, uint8_t flags, uint16_t seq, const uint8_t *payload,
                      size_t length)
{
    uint8_t frame[EBL_HEADER_LENGTH + EVENT_HEAD_LENGTH + EVENT_FIELDS_LENGTH_MAX];

    ebl_header_put(frame, EBL_KIND_ASYNC, flags, EVENT_CHANNEL, seq);
    memcpy(frame + EBL_HEADER_LENGTH, payload, length);
    return link_send(link, LINK_EVENT, frame, EBL_HEADER_LENGTH + length);
}

static void kept_remove(event_log *events, size_t place)
{
    events->kept_count--;
    memmove(&events->kept[place], &events->kept[place + 1],
            (events->kept_count - place) * sizeof events->kept[0]);
}

/* All but those that HELLO or the next second tells anew. */
static int is_kept(uint8_t code)
{
    return code != EBL_EVENT_BOOT && code != EBL_EVENT_STREAM_COUNTS;
}

static void keep(event_log *events, uint64_t now_us, const uint8_t *payload, size_t length)
{
    kept_event *kept;

    if (length > EVENT_KEPT_BYTES_MAX) return;
    if (events->kept_count == 0) events->repeat_us = now_us + REPEAT_US;
    if (events->kept_count == EVENTS_KEPT_MAX) {
        kept_remove(events, 0);
        if (events->pushed_out < UINT16_MAX) events->pushed_out++;
    }
    kept = &events->kept[events->kept_count++];
    kept->seq = events->seq;
    kept->length = (uint8_t)length;
    memcpy(kept->payload, payload, length);
}

void events_attend(event_log *events, int attended, uint64_t now_us)
{
    events->attended = attended != 0;
    events->repeat_us = now_us + REPEAT_US;
}

void events_acknowledge(event_log *events, uint16_t seq)
{
    for (size_t i = 0; i < events->kept_count; i++) {
        if (events->kept[i].seq != seq) continue;
        kept_remove(events, i);
        return;
    }
}

void events_poll(event_log *events, unit_link *link, uint64_t now_us)
{
    if (!events->attended || events->kept_count == 0 || now_us < events->repeat_us) return;
    /* A line that has not taken the last ones would only be fuller for it. */
    if (!link_has_told(link)) return;
    events->repeat_us = now_us + REPEAT_US;
    for (size_t i = 0; i < events->kept_count; i++) {
        const kept_event *kept = &events->kept[i];

        (void)frame_send(link, EBL_FLAG_RETRANSMIT, kept->seq, kept->payload, kept->length);
    }
}

/* The number is used up even if the line has no room, so the host sees the gap. */
static void event_send(event_log *events, unit_link *link, uint64_t now_us, uint8_t code,
                       const uint8_t *layout, const void *event)
{
    uint8_t payload[EVENT_HEAD_LENGTH + EVENT_FIELDS_LENGTH_MAX];
    size_t length;

    payload[0] = code;
    ebl_put_u32(payload + 1, (uint32_t)now_us);
    if (ebl_layout_put(layout, event, payload + EVENT_HEAD_LENGTH, EVENT_FIELDS_LENGTH_MAX,
                       &length) != EBL_OK) {
        return;
    }
    length += EVENT_HEAD_LENGTH;
    if (is_kept(code)) keep(events, now_us, payload, length);
    (void)frame_send(link, 0, events->seq, payload, length);
    events->seq++;
}

void event_boot(event_log *events, unit_link *link, uint64_t now_us, const hal *board)
{
    ebl_boot_event event = {board->boot_id, board->reset_cause};

    event_send(events, link, now_us, EBL_EVENT_BOOT, EBL_MESSAGE(ebl_boot_event, &event));
}

void event_faults_set(event_log *events, unit_link *link, uint64_t now_us, uint32_t fault_flags)
{
    ebl_fault_set_event event = {fault_flags};

    event_send(events, link, now_us, EBL_EVENT_FAULT_SET, EBL_MESSAGE(ebl_fault_set_event, &event));
}

void event_faults_cleared(event_log *events, unit_link *link, uint64_t now_us, uint32_t fault_flags)
{
    ebl_fault_cleared_event event = {fault_flags};

    event_send(events, link, now_us, EBL_EVENT_FAULT_CLEARED,
               EBL_MESSAGE(ebl_fault_cleared_event, &event));
}

void event_config(event_log *events, unit_link *link, uint64_t now_us, uint8_t code,
                  uint32_t generation, uint32_t crc32)
{
    ebl_config_committed_event event = {generation, crc32};

    event_send(events, link, now_us, code, EBL_MESSAGE(ebl_config_committed_event, &event));
}

void event_config_provisional(event_log *events, unit_link *link, uint64_t now_us,
                              uint32_t generation, uint32_t crc32, uint8_t confirm_s)
{
    ebl_config_provisional_event event = {generation, crc32, confirm_s};

    event_send(events, link, now_us, EBL_EVENT_CONFIG_PROVISIONAL,
               EBL_MESSAGE(ebl_config_provisional_event, &event));
}

void event_config_converted(event_log *events, unit_link *link, uint64_t now_us,
                            const config_store *store)
{
    ebl_config_converted_event event = {store->generation, store->crc32, store->tally.added,
                                        store->tally.dropped, store->tally.clamped};

    event_send(events, link, now_us, EBL_EVENT_CONFIG_CONVERTED,
               EBL_MESSAGE(ebl_config_converted_event, &event));
}

void event_stream_counts(event_log *events, unit_link *link, uint64_t now_us,
                         const ebl_stream_counts_event *counts)
{
    event_send(events, link, now_us, EBL_EVENT_STREAM_COUNTS,
               EBL_MESSAGE(ebl_stream_counts_event, counts));
}

void event_auth_changed(event_log *events, unit_link *link, uint64_t now_us, uint8_t level,
                        uint16_t failures)
{
    ebl_auth_changed_event event = {level, failures};

    event_send(events, link, now_us, EBL_EVENT_AUTH_CHANGED,
               EBL_MESSAGE(ebl_auth_changed_event, &event));
}

void event_log_closed(event_log *events, unit_link *link, uint64_t now_us, uint32_t log_id,
                      uint32_t generation, uint32_t length_bytes)
{
    ebl_log_closed_event event = {log_id, generation, length_bytes};

    event_send(events, link, now_us, EBL_EVENT_LOG_CLOSED,
               EBL_MESSAGE(ebl_log_closed_event, &event));
}

void event_log_overwritten(event_log *events, unit_link *link, uint64_t now_us, uint32_t log_id,
                           uint32_t generation, uint32_t overwritten)
{
    ebl_log_overwritten_event event = {log_id, generation, overwritten};

    event_send(events, link, now_us, EBL_EVENT_LOG_OVERWRITTEN,
               EBL_MESSAGE(ebl_log_overwritten_event, &event));
}
