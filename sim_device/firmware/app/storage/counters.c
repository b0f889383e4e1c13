#include "counters.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_get_u32, ebl_put_u32
#include "ebl_frame.h"    // ebl_crc32
#include "ebl_registry.h" // EBL_CONTROL_PERIOD_US, EBL_RESTING_KMH
#include "flash_verify.h" // STORAGE_OK, flash_program_verified, flash_is_blank

#define AREAS COUNTERS_BLOCKS
#define SAVE_PERIOD_US 60000000u
#define STANDING_SAVE_S 600u
#define STEPS_PER_S (1000000u / EBL_CONTROL_PERIOD_US)
#define SPEED_KMH_MAX 150.0f /* what is faster is a disturbed sensor */

enum {
    AT_SEQUENCE = 0,
    AT_DISTANCE = 4,
    AT_OPERATING = 8,
    AT_LOG_ERASES = 12,
    AT_CRC = 16,
    RECORD_LENGTH = 20
};

static size_t records_per_area(const counters *state) { return state->area_bytes / RECORD_LENGTH; }

static size_t record_address(const counters *state, size_t place)
{
    size_t area = place / records_per_area(state);

    return state->address + area * state->area_bytes +
           place % records_per_area(state) * RECORD_LENGTH;
}

/* True with the record at this place, if it is whole. */
static int record_read(const counters *state, const hal *board, size_t place, uint8_t *record)
{
    size_t address = record_address(state, place);

    if (board->flash_read(board->context, address, record, RECORD_LENGTH) < 0) return 0;
    return ebl_get_u32(record + AT_CRC) == ebl_crc32(0, record, AT_CRC);
}

/* Places that a torn write has touched are passed over; the end of an area is left as it is. */
static void next_find(counters *state, const hal *board)
{
    while (state->next % records_per_area(state) != 0 &&
           !flash_is_blank(board, record_address(state, state->next), RECORD_LENGTH)) {
        state->next++;
    }
    if (state->next == AREAS * records_per_area(state)) state->next = 0;
}

void counters_boot(counters *state, const hal *board, size_t address)
{
    uint8_t record[RECORD_LENGTH];

    memset(state, 0, sizeof *state);
    state->address = address;
    if (board->flash_block_size < RECORD_LENGTH) return;
    if (board->flash_size < address + AREAS * board->flash_block_size) return;
    state->area_bytes = board->flash_block_size;
    for (size_t place = 0; place < AREAS * records_per_area(state); place++) {
        uint32_t sequence;

        if (!record_read(state, board, place, record)) continue;
        sequence = ebl_get_u32(record + AT_SEQUENCE);
        if (sequence <= state->sequence) continue;
        state->sequence = sequence;
        state->distance_m = ebl_get_u32(record + AT_DISTANCE);
        state->operating_s = ebl_get_u32(record + AT_OPERATING);
        state->log_erases = ebl_get_u32(record + AT_LOG_ERASES);
        state->next = place + 1;
    }
    state->saved_distance_m = state->distance_m;
    state->saved_operating_s = state->operating_s;
    state->save_due_us = SAVE_PERIOD_US;
    next_find(state, board);
}

void counters_step(counters *state, float speed_kmh, float way_m)
{
    if (++state->steps >= STEPS_PER_S) {
        state->steps = 0;
        state->operating_s++;
    }
    state->speed_kmh = speed_kmh;
    if (!(way_m > 0.0f && speed_kmh < SPEED_KMH_MAX)) return;
    state->distance_rest_m += way_m;
    state->distance_m += (uint32_t)state->distance_rest_m;
    state->distance_rest_m -= (float)(uint32_t)state->distance_rest_m;
}

/* True where a record fits at `next`: an area that is begun anew is erased first. */
static int room_make(const counters *state, const hal *board)
{
    size_t address = record_address(state, state->next);

    if (state->next % records_per_area(state) != 0) return 1;
    if (flash_is_blank(board, address, state->area_bytes)) return 1;
    if (!(state->speed_kmh < EBL_RESTING_KMH)) return 0;
    return board->flash_erase(board->context, address) >= 0;
}

/* A bike that stands has only its time to tell. */
static int is_worth_saving(const counters *state)
{
    return state->distance_m != state->saved_distance_m ||
           state->operating_s - state->saved_operating_s >= STANDING_SAVE_S;
}

void counters_poll(counters *state, const hal *board, uint64_t now_us)
{
    uint8_t record[RECORD_LENGTH];

    if (state->area_bytes == 0 || now_us < state->save_due_us) return;
    state->save_due_us = now_us + SAVE_PERIOD_US;
    if (!is_worth_saving(state) || !room_make(state, board)) return;
    ebl_put_u32(record + AT_SEQUENCE, state->sequence + 1);
    ebl_put_u32(record + AT_DISTANCE, state->distance_m);
    ebl_put_u32(record + AT_OPERATING, state->operating_s);
    ebl_put_u32(record + AT_LOG_ERASES, state->log_erases);
    ebl_put_u32(record + AT_CRC, ebl_crc32(0, record, AT_CRC));
    if (flash_program_verified(board, record_address(state, state->next), record, RECORD_LENGTH) ==
        STORAGE_OK) {
        state->sequence++;
        state->saved_distance_m = state->distance_m;
        state->saved_operating_s = state->operating_s;
    }
    state->next++;
    next_find(state, board);
}
