#include "bulk.h"

#include <string.h>

#include "ebl_bytes.h" // ebl_put_u32
#include "ebl_frame.h" // ebl_header_put

#define US_PER_S 1000000u
#define SESSION_SILENCE_US (10 * US_PER_S)
#define ROUND_TRIP_FIRST_US 100000u /* before one was measured */
#define ROUND_TRIPS_OF_SILENCE 3
#define CHUNK_MIN 64
#define FRAME_OVERHEAD (EBL_HEADER_LENGTH + EBL_BULK_HEAD_LENGTH)

uint16_t ride_log_bulk_chunk(uint16_t mtu)
{
    uint16_t chunk = RIDE_LOG_PAGE_BYTES;

    while (chunk > CHUNK_MIN && chunk + FRAME_OVERHEAD + EBL_CHECK_LENGTH > mtu) chunk /= 2;
    return chunk;
}

void ride_log_bulk_open(ride_log_bulk *bulk, const ride_log_store *store, uint8_t place,
                        uint32_t offset, uint16_t chunk, uint8_t window, uint8_t session,
                        uint64_t now_us)
{
    memset(bulk, 0, sizeof *bulk);
    bulk->session = session;
    bulk->place = place;
    bulk->window = window;
    bulk->chunk = chunk;
    bulk->log_id = store->logs[place].id;
    bulk->total = ride_log_store_length(store, place) / chunk;
    bulk->base = offset / chunk;
    bulk->next = bulk->base;
    bulk->heard_us = now_us;
    bulk->round_trip_us = ROUND_TRIP_FIRST_US;
}

void ride_log_bulk_end(ride_log_bulk *bulk) { bulk->session = 0; }

uint16_t ride_log_bulk_left_s(const ride_log_bulk *bulk, uint64_t now_us)
{
    uint64_t silent_us = now_us - bulk->heard_us;

    if (bulk->session == 0 || silent_us >= SESSION_SILENCE_US) return 0;
    return (uint16_t)((SESSION_SILENCE_US - (uint32_t)silent_us + US_PER_S - 1) / US_PER_S);
}

/* Only chunks sent once tell a round trip. */
static void round_trip_measure(ride_log_bulk *bulk, uint64_t now_us)
{
    uint32_t behind = bulk->timed - bulk->base;
    uint32_t sample;

    if (!bulk->timing) return;
    if (bulk->timed >= bulk->base && (behind >= 32 || !(bulk->received >> behind & 1u))) return;
    sample = (uint32_t)(now_us - bulk->timed_us);
    bulk->round_trip_us = bulk->round_trip_us / 8 * 7 + sample / 8;
    bulk->timing = 0;
}

/* Chunks missing below the highest received one, unless they are on their way again. */
static void holes_find(ride_log_bulk *bulk, uint64_t now_us)
{
    uint32_t above = bulk->received;

    for (uint32_t k = 0; above != 0; k++, above >>= 1) {
        uint64_t since_us = now_us - bulk->sent_us[(bulk->base + k) % RIDE_LOG_WINDOW_MAX];

        if (above & 1u) continue;
        if (since_us >= bulk->round_trip_us) bulk->resend |= 1u << k;
    }
}

int ride_log_bulk_ack(ride_log_bulk *bulk, uint32_t base, uint64_t bitmap, uint64_t now_us)
{
    uint32_t first = base / bulk->chunk;
    uint32_t advanced = first - bulk->base;
    uint32_t sent;

    if (base % bulk->chunk != 0 || first > bulk->next) return 0;
    bulk->heard_us = now_us;
    /* Overtaken by a later one: what it tells is known already. */
    if (first < bulk->base) return 1;
    bulk->received = advanced < 32 ? bulk->received >> advanced : 0;
    bulk->resend = advanced < 32 ? bulk->resend >> advanced : 0;
    bulk->base = first;
    sent = bulk->next - first;
    bulk->received |= (uint32_t)bitmap & (sent < 32 ? (1u << sent) - 1u : UINT32_MAX);
    bulk->resend &= ~bulk->received;
    round_trip_measure(bulk, now_us);
    holes_find(bulk, now_us);
    if (bulk->base == bulk->total) ride_log_bulk_end(bulk);
    return 1;
}

void ride_log_bulk_poll(ride_log_bulk *bulk, const ride_log_store *store, uint64_t now_us)
{
    if (bulk->session == 0) return;
    if (now_us - bulk->heard_us >= SESSION_SILENCE_US ||
        store->logs[bulk->place].id != bulk->log_id) {
        ride_log_bulk_end(bulk);
    }
}

/* The chunk to send now: a hole, a new one, or the oldest after a silence. False for none. */
static int chunk_choose(const ride_log_bulk *bulk, uint64_t now_us, uint32_t *chunk)
{
    uint64_t since_us = now_us - bulk->sent_us[bulk->base % RIDE_LOG_WINDOW_MAX];

    for (uint32_t k = 0; k < RIDE_LOG_WINDOW_MAX; k++) {
        if (!(bulk->resend >> k & 1u)) continue;
        *chunk = bulk->base + k;
        return 1;
    }
    if (bulk->next < bulk->total && bulk->next < bulk->base + bulk->window) {
        *chunk = bulk->next;
        return 1;
    }
    *chunk = bulk->base;
    return bulk->base < bulk->next &&
           since_us >= (uint64_t)ROUND_TRIPS_OF_SILENCE * bulk->round_trip_us;
}

static void sent_note(ride_log_bulk *bulk, uint32_t chunk, uint64_t now_us)
{
    bulk->sent_us[chunk % RIDE_LOG_WINDOW_MAX] = now_us;
    bulk->frames_sent++;
    if (chunk == bulk->next) {
        bulk->next++;
        if (bulk->timing) return;
        bulk->timing = 1;
        bulk->timed = chunk;
        bulk->timed_us = now_us;
        return;
    }
    bulk->frames_repeated++;
    bulk->resend &= ~(1u << (chunk - bulk->base));
    if (chunk == bulk->timed) bulk->timing = 0;
}

size_t ride_log_bulk_frame(ride_log_bulk *bulk, const ride_log_store *store, const hal *board,
                           uint8_t *frame, size_t capacity)
{
    uint64_t now_us = board->now_us(board->context);
    uint8_t *payload = frame + EBL_HEADER_LENGTH;
    uint32_t chunk;
    uint32_t offset;

    ride_log_bulk_poll(bulk, store, now_us);
    if (bulk->session == 0 || capacity < FRAME_OVERHEAD + (size_t)bulk->chunk) return 0;
    if (board->log_busy(board->log_context) || !chunk_choose(bulk, now_us, &chunk)) return 0;
    offset = chunk * bulk->chunk;
    if (ride_log_store_read(store, board, bulk->place, offset, payload + EBL_BULK_HEAD_LENGTH,
                            bulk->chunk) < 0) {
        return 0;
    }
    ebl_header_put(frame, EBL_KIND_ASYNC, 0, bulk->session, bulk->seq);
    bulk->seq++;
    ebl_put_u32(payload, offset);
    ebl_put_u16(payload + 4, bulk->chunk);
    ebl_put_u16(payload + 6, 0);
    sent_note(bulk, chunk, now_us);
    return FRAME_OVERHEAD + (size_t)bulk->chunk;
}
