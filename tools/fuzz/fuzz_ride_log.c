/* libFuzzer on the reader of ride logs: directory, bytes, window, check value.
 *
 * The input is a script of pages, sealed as the recorder seals them, because behind a CRC the
 * interesting mistakes begin: any log, number, kind and length, at any place of the flash, some
 * torn, some raw. Whatever lies there, the directory is one, and nothing else is read. */
#include <stdlib.h>
#include <string.h>

#include "ebl_registry.h"   // EBL_MTU
#include "log_flash.h"      // log_flash_open
#include "ride_log/block.h" // ride_log_block_seal
#include "ride_log/bulk.h"  // ride_log_bulk_frame
#include "ride_log/check.h" // ride_log_check_poll
#include "ride_log/store.h" // ride_log_store_boot

#define BLOCK_BYTES 1024u
#define BLOCKS 16u
#define FLASH_BYTES (BLOCK_BYTES * BLOCKS)
#define PAGES (FLASH_BYTES / RIDE_LOG_PAGE_BYTES)
#define PAGES_MAX 96
#define ROW_PERIOD_US 100000u
#define FRAMES_MAX 64
#define SESSION 3

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct {
    const uint8_t *at;
    size_t left;
} script;

static uint64_t clock_us;

static uint64_t now_us(void *context)
{
    (void)context;
    return clock_us;
}

static void require(int holds)
{
    if (!holds) abort();
}

static uint8_t byte(script *from)
{
    if (from->left == 0) return 0;
    from->left--;
    return *from->at++;
}

/* How a page comes to lie there. */
enum { SEALED, SEALED_AND_TORN, CONFIRMED, RAW, KINDS };

static void lay_page(uint8_t *flash, script *from)
{
    uint8_t *page = flash + (size_t)(byte(from) % PAGES) * RIDE_LOG_PAGE_BYTES;
    uint8_t kind = byte(from) % KINDS;
    uint8_t sealed[RIDE_LOG_PAGE_BYTES];
    ride_log_header header = {0};
    size_t length = RIDE_LOG_PAGE_BYTES;

    if (kind == RAW) {
        for (size_t i = 0; i < 40; i++) page[i] = byte(from);
        return;
    }
    memset(sealed, byte(from), sizeof sealed);
    header.type = byte(from);
    header.length = (uint16_t)(byte(from) * 2u);
    if (header.length > RIDE_LOG_PAYLOAD_BYTES) header.length = RIDE_LOG_PAYLOAD_BYTES;
    header.log_id = byte(from) % 40u;
    header.boot_id = byte(from) % 2u;
    header.seq = byte(from);
    if (header.seq > 250) header.seq = UINT32_MAX - header.seq;
    header.t0_us = (uint64_t)byte(from) << byte(from) % 60u;
    header.n = byte(from);
    (void)ride_log_block_seal(sealed, &header);
    if (kind == SEALED_AND_TORN) length = byte(from) * 2u;
    memcpy(page, sealed, length);
    if (kind == CONFIRMED) memset(page + RIDE_LOG_AT_STATE, 0, 4);
}

static void directory_is_one(const ride_log_store *store, uint8_t place)
{
    const ride_log_entry *log = &store->logs[place];

    require(log->id != 0 && log->first_block < store->blocks);
    require(ride_log_store_find(store, log->id, log->generation) == place);
    require(store->owner[log->first_block] == place);
    require(ride_log_store_length(store, place) <= FLASH_BYTES);
    for (uint8_t other = 0; other < RIDE_LOG_LOGS_MAX; other++) {
        require(other == place || store->logs[other].id != log->id);
    }
}

/* The whole log in pieces of every size: what the unit says twice it says alike. */
static void read_whole(const ride_log_store *store, const hal *board, uint8_t place)
{
    uint32_t length = ride_log_store_length(store, place);

    for (uint32_t at = 0; at < length; at += RIDE_LOG_PAGE_BYTES) {
        uint8_t whole[RIDE_LOG_PAGE_BYTES], part[RIDE_LOG_PAGE_BYTES];
        uint32_t into = (at / 7u) % RIDE_LOG_PAGE_BYTES;

        require(ride_log_store_read(store, board, place, at, whole, sizeof whole) == 0);
        require(ride_log_store_read(store, board, place, at + into, part, sizeof part - into) == 0);
        require(memcmp(whole + into, part, sizeof part - into) == 0);
        for (size_t i = RIDE_LOG_AT_STATE; i < sizeof whole; i++) require(whole[i] == 0xFF);
    }
}

static void check_whole(const ride_log_store *store, const hal *board, uint8_t place)
{
    ride_log_check check = {0};
    int state = RIDE_LOG_CHECK_RUNNING;

    check.place = place;
    check.log_id = store->logs[place].id;
    check.end = ride_log_store_length(store, place);
    for (uint32_t i = 0; i < PAGES && state == RIDE_LOG_CHECK_RUNNING; i++) {
        state = ride_log_check_poll(&check, store, board);
    }
    require(state == RIDE_LOG_CHECK_DONE);
}

/* A host that acknowledges whatever it likes. */
static void send(const ride_log_store *store, const hal *board, uint8_t place, script *from)
{
    uint8_t frame[EBL_MTU];
    ride_log_bulk bulk;
    uint32_t length = ride_log_store_length(store, place);
    uint16_t chunk = ride_log_bulk_chunk((uint16_t)(byte(from) * 4u + 64u));
    uint8_t window = (uint8_t)(byte(from) % RIDE_LOG_WINDOW_MAX + 1u);
    uint32_t offset = (uint32_t)byte(from) * chunk;

    if (offset > length) offset = length;
    ride_log_bulk_open(&bulk, store, place, offset, chunk, window, SESSION, clock_us);
    for (int i = 0; i < FRAMES_MAX; i++) {
        size_t sent = ride_log_bulk_frame(&bulk, store, board, frame, sizeof frame);
        uint64_t map = (uint64_t)byte(from) << byte(from) % 57u;

        require(sent <= sizeof frame);
        require(bulk.base <= bulk.next && bulk.next <= bulk.total);
        if (bulk.session == 0) break;
        (void)ride_log_bulk_ack(&bulk, (uint32_t)byte(from) * chunk, map, clock_us);
        clock_us += (uint64_t)byte(from) * 3000u;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    script from = {data, size};
    static ride_log_store store;
    log_flash flash;
    hal board;
    uint8_t page[RIDE_LOG_PAGE_BYTES];

    memset(&board, 0, sizeof board);
    board.now_us = now_us;
    clock_us = 0;
    require(log_flash_open(&flash, BLOCK_BYTES, FLASH_BYTES, NULL) == 0);
    log_flash_connect(&flash, &board, &clock_us);
    for (int i = byte(&from) % PAGES_MAX; i > 0 && from.left > 0; i--) {
        lay_page(flash.bytes, &from);
    }
    ride_log_store_boot(&store, &board, ROW_PERIOD_US, page);
    for (uint16_t number = 0; number < ride_log_store_count(&store); number++) {
        uint8_t place = ride_log_store_by_age(&store, number);

        require(place != RIDE_LOG_NONE);
        directory_is_one(&store, place);
        read_whole(&store, &board, place);
        check_whole(&store, &board, place);
        send(&store, &board, place, &from);
    }
    while (ride_log_store_count(&store) > 0) {
        uint8_t victim = ride_log_store_victim(&store);

        require(victim != RIDE_LOG_NONE);
        ride_log_store_release(&store, victim);
    }
    require(ride_log_store_free_block(&store, RIDE_LOG_NO_BLOCK) != RIDE_LOG_NO_BLOCK);
    log_flash_close(&flash);
    return 0;
}
