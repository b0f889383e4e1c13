/* The bench board driven by a script on standard input, for a build with sanitizers.
 *
 * Records: 'b' boot; 'a' u32 advance by microseconds; 's' u16 length and bytes to the unit; 'r' u32
 * room on the line; 'w' f32 the wheel's speed; 'i' the raw hal_inputs. Everything the unit says
 * goes to standard output. */
#include <stdio.h>

#include "bench_board.h" // bench_create
#include "ebl_bytes.h"   // ebl_get_u32

#define FLASH_BLOCK_BYTES 1024
#define FLASH_BYTES 8192

static int take(uint8_t *bytes, size_t length) { return fread(bytes, 1, length, stdin) == length; }

static void hear(bench_board *board)
{
    static uint8_t heard[BENCH_LINE_BYTES];
    size_t length = bench_receive(board, heard, sizeof heard);

    fwrite(heard, 1, length, stdout);
}

/* False when the record is cut or unknown. */
static int obey(bench_board *board, int record, uint32_t *boot_id)
{
    static uint8_t bytes[UINT16_MAX];
    hal_inputs inputs;

    switch (record) {
    case 'b': bench_boot(board, ++*boot_id); return 1;
    case 'a':
        if (!take(bytes, 4)) return 0;
        bench_advance_us(board, ebl_get_u32(bytes));
        return 1;
    case 'r':
        if (!take(bytes, 4)) return 0;
        bench_line_capacity(board, ebl_get_u32(bytes));
        return 1;
    case 's':
        if (!take(bytes, 2)) return 0;
        {
            size_t length = ebl_get_u16(bytes);

            if (!take(bytes, length)) return 0;
            bench_send(board, bytes, length);
        }
        bench_poll(board);
        return 1;
    case 'w':
        if (!take(bytes, 4)) return 0;
        bench_wheel_set(board, ebl_get_f32(bytes));
        return 1;
    case 'i':
        if (fread(&inputs, sizeof inputs, 1, stdin) != 1) return 0;
        bench_inputs_set(board, &inputs);
        return 1;
    default: return 0;
    }
}

int main(void)
{
    bench_board *board = bench_create(FLASH_BLOCK_BYTES, FLASH_BYTES);
    uint32_t boot_id = 0;
    int well = board != NULL && bench_provision(board) == 0;

    for (int record = getchar(); well && record != EOF; record = getchar()) {
        well = obey(board, record, &boot_id);
        hear(board);
    }
    bench_destroy(board);
    return well ? 0 : 2;
}
