#include "check.h"

#include "ebl_frame.h" // ebl_crc32

#define PIECE_BYTES 128 /* on the stack */
#define PIECES_PER_POLL 16

int ride_log_check_poll(ride_log_check *check, const ride_log_store *store, const hal *board)
{
    if (store->logs[check->place].id != check->log_id) return RIDE_LOG_CHECK_GONE;
    for (int i = 0; i < PIECES_PER_POLL && check->offset < check->end; i++) {
        uint8_t piece[PIECE_BYTES];
        uint32_t length = PIECE_BYTES - check->offset % PIECE_BYTES;

        if (board->log_busy(board->log_context)) return RIDE_LOG_CHECK_RUNNING;
        if (length > check->end - check->offset) length = check->end - check->offset;
        if (ride_log_store_read(store, board, check->place, check->offset, piece, length) < 0) {
            return RIDE_LOG_CHECK_RUNNING;
        }
        check->crc32 = ebl_crc32(check->crc32, piece, length);
        check->offset += length;
    }
    return check->offset < check->end ? RIDE_LOG_CHECK_RUNNING : RIDE_LOG_CHECK_DONE;
}
