#include "flash_verify.h"

#include <string.h>

#include "ebl_frame.h" // ebl_crc32

#define PIECE_BYTES 32 /* so that the stack stays small */
#define BYTE_ERASED 0xFF

int flash_program_verified(const hal *board, size_t address, const uint8_t *bytes, size_t length)
{
    uint8_t piece[PIECE_BYTES];

    if (board->flash_program(board->context, address, bytes, length) < 0) {
        return STORAGE_FLASH_FAIL;
    }
    for (size_t at = 0; at < length; at += sizeof piece) {
        size_t count = length - at < sizeof piece ? length - at : sizeof piece;

        if (board->flash_read(board->context, address + at, piece, count) < 0) {
            return STORAGE_FLASH_FAIL;
        }
        if (memcmp(piece, bytes + at, count) != 0) return STORAGE_VERIFY_FAIL;
    }
    return STORAGE_OK;
}

int flash_crc32(const hal *board, size_t address, size_t length, uint32_t *crc)
{
    uint8_t piece[PIECE_BYTES];

    for (size_t at = 0; at < length; at += sizeof piece) {
        size_t count = length - at < sizeof piece ? length - at : sizeof piece;

        if (board->flash_read(board->context, address + at, piece, count) < 0) return -1;
        *crc = ebl_crc32(*crc, piece, count);
    }
    return 0;
}

int flash_is_blank(const hal *board, size_t address, size_t length)
{
    uint8_t piece[PIECE_BYTES];

    for (size_t at = 0; at < length; at += sizeof piece) {
        size_t count = length - at < sizeof piece ? length - at : sizeof piece;

        if (board->flash_read(board->context, address + at, piece, count) < 0) return 0;
        for (size_t i = 0; i < count; i++) {
            if (piece[i] != BYTE_ERASED) return 0;
        }
    }
    return 1;
}
