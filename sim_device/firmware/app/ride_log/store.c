#include "store.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_get_u32
#include "ebl_registry.h" // EBL_LOG_CONFIRMED

#define WORD_WRITTEN 0u
#define BLOCKS_MIN 4 /* fewer have no room for a log beside another */

size_t ride_log_store_address(const ride_log_store *store, const hal *board, uint16_t block,
                              uint32_t page)
{
    return (size_t)block * board->log_block_size +
           (size_t)(page % store->pages_per_block) * RIDE_LOG_PAGE_BYTES;
}

static int header_read(const ride_log_store *store, const hal *board, uint16_t block,
                       ride_log_header *header)
{
    uint8_t bytes[RIDE_LOG_AT_PAYLOAD];
    size_t address = ride_log_store_address(store, board, block, 0);

    if (board->log_read(board->log_context, address, bytes, sizeof bytes) < 0) return 0;
    return ride_log_header_get(header, bytes);
}

static uint16_t block_next(const ride_log_store *store, uint16_t block)
{
    return (uint16_t)(block + 1u == store->blocks ? 0 : block + 1u);
}

static uint8_t place_of_id(const ride_log_store *store, uint32_t id)
{
    for (uint8_t place = 0; place < RIDE_LOG_LOGS_MAX; place++) {
        if (store->logs[place].id == id) return place;
    }
    return RIDE_LOG_NONE;
}

uint8_t ride_log_store_free_place(const ride_log_store *store) { return place_of_id(store, 0); }

uint8_t ride_log_store_find(const ride_log_store *store, uint32_t id, uint32_t generation)
{
    uint8_t place = id == 0 ? RIDE_LOG_NONE : place_of_id(store, id);

    if (place == RIDE_LOG_NONE || store->logs[place].generation != generation) {
        return RIDE_LOG_NONE;
    }
    return place;
}

uint16_t ride_log_store_count(const ride_log_store *store)
{
    uint16_t count = 0;

    for (size_t place = 0; place < RIDE_LOG_LOGS_MAX; place++) {
        if (store->logs[place].id != 0) count++;
    }
    return count;
}

uint8_t ride_log_store_by_age(const ride_log_store *store, uint16_t number)
{
    for (uint8_t place = 0; place < RIDE_LOG_LOGS_MAX; place++) {
        uint32_t id = store->logs[place].id;
        uint16_t older = 0;

        if (id == 0) continue;
        for (size_t other = 0; other < RIDE_LOG_LOGS_MAX; other++) {
            if (store->logs[other].id != 0 && store->logs[other].id < id) older++;
        }
        if (older == number) return place;
    }
    return RIDE_LOG_NONE;
}

uint16_t ride_log_store_free_block(const ride_log_store *store, uint16_t limit)
{
    uint16_t block = store->head;

    for (uint16_t i = 0; i < store->blocks && block != limit; i++) {
        if (store->owner[block] == RIDE_LOG_NONE) return block;
        block = block_next(store, block);
    }
    return RIDE_LOG_NO_BLOCK;
}

int ride_log_store_is_before(const ride_log_store *store, uint16_t block, uint16_t limit)
{
    uint16_t to_block = (uint16_t)((block + store->blocks - store->head) % store->blocks);
    uint16_t to_limit = (uint16_t)((limit + store->blocks - store->head) % store->blocks);

    return to_block < to_limit;
}

uint8_t ride_log_store_victim(const ride_log_store *store)
{
    uint8_t oldest = RIDE_LOG_NONE;

    for (uint16_t number = 0; number < ride_log_store_count(store); number++) {
        uint8_t place = ride_log_store_by_age(store, number);
        uint8_t flags = store->logs[place].flags;

        if ((flags & EBL_LOG_RECORDING) || store->logs[place].refused) continue;
        if (flags & EBL_LOG_CONFIRMED) return place;
        if (oldest == RIDE_LOG_NONE) oldest = place;
    }
    return oldest;
}

int ride_log_store_erase(ride_log_store *store, const hal *board, uint16_t block)
{
    uint8_t *owner = &store->owner[block];

    if (board->log_erase(board->log_context, (size_t)block * board->log_block_size) >= 0) {
        store->erases++;
        return 0;
    }
    if (*owner == RIDE_LOG_NONE) {
        *owner = RIDE_LOG_REFUSED;
    } else {
        store->logs[*owner].refused = 1;
    }
    return -1;
}

void ride_log_store_forgive(ride_log_store *store)
{
    for (size_t block = 0; block < store->blocks; block++) {
        if (store->owner[block] == RIDE_LOG_REFUSED) store->owner[block] = RIDE_LOG_NONE;
    }
    for (size_t place = 0; place < RIDE_LOG_LOGS_MAX; place++) store->logs[place].refused = 0;
}

void ride_log_store_release(ride_log_store *store, uint8_t place)
{
    for (size_t block = 0; block < store->blocks; block++) {
        if (store->owner[block] == place) store->owner[block] = RIDE_LOG_NONE;
    }
    memset(&store->logs[place], 0, sizeof store->logs[place]);
}

/* The block in which the log's block of number `index` lies. Blocks of a log stand in their order
 * around the ring; where one is lost, those behind it are nearer to the first than counted. */
static uint16_t block_find(const ride_log_store *store, const hal *board, uint8_t place,
                           uint32_t index)
{
    uint16_t block = store->logs[place].first_block;
    uint16_t found = block;
    uint32_t counted = 0;
    ride_log_header header;

    for (uint16_t i = 1; i < store->blocks && counted < index; i++) {
        block = block_next(store, block);
        if (store->owner[block] != place) continue;
        found = block;
        counted++;
    }
    for (uint16_t i = 0; i < store->blocks; i++) {
        if (store->owner[found] == place && header_read(store, board, found, &header)) {
            uint32_t number = header.seq / store->pages_per_block;

            if (number == index) return found;
            if (number < index) return RIDE_LOG_NO_BLOCK;
        }
        found = (uint16_t)(found == 0 ? store->blocks - 1u : found - 1u);
    }
    return RIDE_LOG_NO_BLOCK;
}

int ride_log_store_read(const ride_log_store *store, const hal *board, uint8_t place,
                        uint32_t offset, uint8_t *bytes, size_t length)
{
    uint32_t page = offset / RIDE_LOG_PAGE_BYTES;
    size_t into = offset % RIDE_LOG_PAGE_BYTES;
    uint16_t block = block_find(store, board, place, page / store->pages_per_block);
    size_t address;

    memset(bytes, 0xFF, length);
    if (block == RIDE_LOG_NO_BLOCK) return 0;
    address = ride_log_store_address(store, board, block, page) + into;
    if (board->log_read(board->log_context, address, bytes, length) < 0) return -1;
    if (into + length > RIDE_LOG_AT_STATE) {
        size_t from = into < RIDE_LOG_AT_STATE ? RIDE_LOG_AT_STATE - into : 0;

        memset(bytes + from, 0xFF, length - from);
    }
    return 0;
}

int ride_log_store_confirm(ride_log_store *store, const hal *board, uint8_t place)
{
    ride_log_entry *log = &store->logs[place];
    size_t address = ride_log_store_address(store, board, log->first_block, 0);
    uint8_t word[4];

    ebl_put_u32(word, WORD_WRITTEN);
    if (board->log_program(board->log_context, address + RIDE_LOG_AT_STATE, word, sizeof word) <
        0) {
        return -1;
    }
    log->flags |= EBL_LOG_CONFIRMED;
    return 0;
}

uint32_t ride_log_store_length(const ride_log_store *store, uint8_t place)
{
    return store->logs[place].pages * RIDE_LOG_PAGE_BYTES;
}

/* Every log whose beginning is there, whole. What is left of others was given up and may be
 * reused, but its numbers may not: half-programmed ones do not count. */
static void logs_find(ride_log_store *store, const hal *board, uint8_t *page)
{
    for (uint16_t block = 0; block < store->blocks; block++) {
        ride_log_header header;
        ride_log_entry *log;
        uint32_t crc32;
        uint8_t place;

        if (board->log_read(board->log_context, ride_log_store_address(store, board, block, 0),
                            page, RIDE_LOG_PAGE_BYTES) < 0 ||
            !ride_log_block_get(&header, &crc32, page)) {
            continue;
        }
        if (header.log_id >= store->next_id) store->next_id = header.log_id + 1;
        /* Two beginnings of one log: the recorder makes none, a damaged flash may hold them. */
        if (header.seq != 0 || place_of_id(store, header.log_id) != RIDE_LOG_NONE) continue;
        place = ride_log_store_free_place(store);
        if (place == RIDE_LOG_NONE) continue;
        log = &store->logs[place];
        log->id = header.log_id;
        log->generation = crc32;
        log->boot_id = header.boot_id;
        log->t0_us = header.t0_us;
        log->t1_us = header.t0_us;
        log->first_block = block;
        if (ebl_get_u32(page + RIDE_LOG_AT_STATE) == WORD_WRITTEN) log->flags |= EBL_LOG_CONFIRMED;
    }
}

/* Gives every block to its log. `last` gets the number of each log's last one. */
static void owners_find(ride_log_store *store, const hal *board, uint32_t *last)
{
    uint32_t newest_id = 0;

    for (uint16_t block = 0; block < store->blocks; block++) {
        ride_log_header header;
        uint8_t place;
        uint32_t number;

        if (!header_read(store, board, block, &header)) continue;
        place = place_of_id(store, header.log_id);
        if (place == RIDE_LOG_NONE || header.boot_id != store->logs[place].boot_id) continue;
        number = header.seq / store->pages_per_block;
        /* A header that lost its power: its number ends in ones. */
        if (number >= store->blocks || header.seq % store->pages_per_block != 0) continue;
        store->owner[block] = place;
        if (number < last[place]) continue;
        last[place] = number;
        if (header.log_id < newest_id) continue;
        newest_id = header.log_id;
        store->head = block_next(store, block);
    }
}

/* How far the log goes: to its last whole block. */
static void end_find(ride_log_store *store, const hal *board, uint8_t place, uint32_t last,
                     uint32_t row_period_us, uint8_t *page)
{
    ride_log_entry *log = &store->logs[place];
    uint32_t page_count = (last + 1) * store->pages_per_block;

    for (uint16_t i = 0; i < 2u * store->pages_per_block && page_count > 0; i++) {
        ride_log_header header;
        uint32_t crc32;

        (void)ride_log_store_read(store, board, place, (page_count - 1) * RIDE_LOG_PAGE_BYTES, page,
                                  RIDE_LOG_PAGE_BYTES);
        if (ride_log_block_get(&header, &crc32, page) && header.log_id == log->id) {
            log->t1_us = header.t0_us;
            if (header.type == RIDE_LOG_DATA) log->t1_us += (uint64_t)header.n * row_period_us;
            if (header.type == RIDE_LOG_END) log->flags |= EBL_LOG_ENDED;
            break;
        }
        page_count--;
    }
    log->pages = page_count;
}

void ride_log_store_boot(ride_log_store *store, const hal *board, uint32_t row_period_us,
                         uint8_t *page)
{
    uint32_t last[RIDE_LOG_LOGS_MAX] = {0};
    size_t blocks = board->log_block_size == 0 ? 0 : board->log_size / board->log_block_size;

    memset(store, 0, sizeof *store);
    memset(store->owner, RIDE_LOG_NONE, sizeof store->owner);
    store->next_id = 1;
    store->blocks = (uint16_t)(blocks < RIDE_LOG_BLOCKS_MAX ? blocks : RIDE_LOG_BLOCKS_MAX);
    if (store->blocks < BLOCKS_MIN) store->blocks = 0;
    if (store->blocks == 0) return;
    store->pages_per_block = (uint16_t)(board->log_block_size / RIDE_LOG_PAGE_BYTES);
    logs_find(store, board, page);
    owners_find(store, board, last);
    for (uint8_t place = 0; place < RIDE_LOG_LOGS_MAX; place++) {
        if (store->logs[place].id == 0) continue;
        end_find(store, board, place, last[place], row_period_us, page);
    }
}
