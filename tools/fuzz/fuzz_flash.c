/* libFuzzer on what a boot reads: the configuration's slots and the blocks of ride logs.
 *
 * The input lies in both flashes. Where its first byte is odd the slot's check value is made good,
 * because behind a CRC the interesting mistakes begin. Whatever lies there: the unit boots, runs,
 * and the configuration it reports breaks no rule. */
#include <stdlib.h>
#include <string.h>

#include "bench_board.h"  // bench_create
#include "ebl_bytes.h"    // ebl_put_u32
#include "ebl_frame.h"    // ebl_crc32
#include "ebl_layout.h"   // EBL_MESSAGE, ebl_layout_get
#include "ebl_registry.h" // ebl_cfg_read_response
#include "ebl_values.h"   // ebl_image_violations

#define FLASH_BLOCK_BYTES 1024
#define FLASH_BYTES 8192
#define RUN_US 200000u

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A provisioned slot with some of its bytes replaced by the input, and check values over them: of
 * each record, and of the header with the table of records, which is there twice. */
static void forge(uint8_t *slot, const uint8_t *data, size_t size)
{
    const size_t table = 36, rows = 4, copy = 68, records = 124;
    size_t at = 8, place = records;

    for (size_t i = 0; i + 1 < size; i += 2) {
        at = 8 + (at - 8 + data[i]) % (FLASH_BLOCK_BYTES - 8);
        slot[at] = data[i + 1];
    }
    for (size_t i = 0; i < rows; i++) {
        uint8_t *row = slot + table + 8 * i;
        size_t length = ebl_get_u16(row + 4);

        if (place + length > FLASH_BLOCK_BYTES) break;
        ebl_put_u32(row, ebl_crc32(0, slot + place, length));
        place += length;
    }
    ebl_put_u32(slot + 4, ebl_crc32(ebl_crc32(0, slot + 8, 16), slot + table, 32));
    memcpy(slot + copy, slot, 24);
    memcpy(slot + copy + 24, slot + table, 32);
}

static void lay(uint8_t *flash, size_t flash_size, const uint8_t *data, size_t size)
{
    memcpy(flash, data, size < flash_size ? size : flash_size);
}

static void say(bench_board *board, const uint8_t *frame, size_t length)
{
    uint8_t wire[64];
    size_t wire_length = 0;

    if (ebl_frame_encode(frame, length, wire, sizeof wire, &wire_length) != EBL_OK) abort();
    bench_send(board, wire, wire_length);
}

/* The unit's answer to CFG_READ is a whole image without a violation. */
static int image_is_good(const uint8_t *frame, size_t length)
{
    ebl_header header;
    ebl_cfg_read_response answer;
    ebl_refusal found[4];

    if (ebl_frame_check(&header, frame, length) != EBL_OK) return 0;
    if (header.kind != EBL_KIND_RESPONSE || header.word != EBL_MSG_CFG_READ) return 0;
    if (header.payload[0] != EBL_STATUS_OK) abort();
    if (ebl_layout_get(EBL_MESSAGE(ebl_cfg_read_response, &answer), header.payload + 1,
                       header.payload_length - 1) != EBL_OK)
        abort();
    if (answer.data_length != EBL_IMAGE_LENGTH) abort();
    return ebl_image_violations(answer.data, found, 4) == 0;
}

static void check(bench_board *board)
{
    static const uint8_t hello[] = {0x20, 1, 1, 0, 1, 1, 0, 0, 0x20, 2, 0, 1, 2, 3, 4, 5, 6, 7};
    static const uint8_t image_read[] = {0x20, 2, 1, 1, 0, 0, 0, 0xff, 0xff};
    static uint8_t heard[BENCH_LINE_BYTES];
    uint8_t buffer[EBL_MTU];
    ebl_decoder decoder;
    size_t at = 0, length;
    int good = 0;

    say(board, hello, sizeof hello);
    say(board, image_read, sizeof image_read);
    bench_advance_us(board, 50000);
    length = bench_receive(board, heard, sizeof heard);
    ebl_decoder_init(&decoder, buffer, sizeof buffer);
    while (at < length) {
        const uint8_t *frame;
        size_t frame_length;

        at += ebl_decoder_feed(&decoder, heard + at, length - at, &frame, &frame_length);
        if (frame != NULL) good |= image_is_good(frame, frame_length);
    }
    if (!good) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bench_board *board = bench_create(FLASH_BLOCK_BYTES, FLASH_BYTES);

    if (board == NULL || bench_provision(board) < 0) abort();
    if (size > 0 && (data[0] & 1)) {
        forge(bench_flash(board), data + 1, size - 1);
    } else {
        lay(bench_flash(board), bench_flash_size(board), data, size);
    }
    if (size > 1) lay(bench_log(board), bench_log_size(board), data + 1, size - 1);
    bench_boot(board, 1);
    bench_advance_us(board, RUN_US);
    check(board);
    bench_boot(board, 2);
    bench_destroy(board);
    return 0;
}
