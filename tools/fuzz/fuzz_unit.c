/* libFuzzer on the whole unit: dispatcher, transaction, streams, logs, law, flash.
 *
 * The input is a script: an operation byte, then what it needs. Frames get their check value here,
 * because no fuzzer guesses a CRC; raw bytes go as they are. What must hold: the motor's demand
 * is a number within reason, and nothing is read or written where it may not be. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench_board.h"  // bench_create
#include "ebl_bytes.h"    // EBL_OK
#include "ebl_frame.h"    // ebl_frame_encode
#include "ebl_registry.h" // EBL_MTU

#define FLASH_BLOCK_BYTES 1024
#define FLASH_BYTES 8192
#define ADVANCE_US_MAX 400000u
#define DEMAND_NM_MAX 1000.0f
#define OPERATIONS_MAX 64

enum { FRAME, RAW, ADVANCE, INPUT, POWER_CUT, BOOT, LINE_ROOM, OPERATIONS };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct {
    const uint8_t *at;
    size_t left;
} script;

static uint8_t byte(script *from)
{
    if (from->left == 0) return 0;
    from->left--;
    return *from->at++;
}

static void say_frame(bench_board *board, const uint8_t *frame, size_t length)
{
    uint8_t wire[2 * EBL_MTU];
    size_t wire_length = 0;

    if (ebl_frame_encode(frame, length, wire, sizeof wire, &wire_length) != EBL_OK) abort();
    bench_send(board, wire, wire_length);
    bench_poll(board);
}

static void hear(bench_board *board)
{
    static uint8_t heard[BENCH_LINE_BYTES];

    bench_receive(board, heard, sizeof heard);
}

static void feel(bench_board *board, script *from)
{
    static const float values[8] = {0.0f, -1.0f, 30.0f, 3000.0f, 1e38f, -1e38f, NAN, INFINITY};
    hal_inputs inputs;
    float value = values[byte(from) % 8];

    bench_inputs_get(board, &inputs);
    switch (byte(from) % 6) {
    case 0: inputs.torque_raw_counts = value; break;
    case 1:
        inputs.wheel_pulses += byte(from) % 16 == 0 ? 0x80000000u : byte(from);
        inputs.wheel_pulse_us = bench_now_us(board) - byte(from) * 1000u;
        break;
    case 2: inputs.cadence_rpm = value; break;
    case 3: inputs.motor_speed_rpm = value; break;
    case 4: inputs.battery_voltage_v = value; break;
    default: inputs.mode_selected = byte(from); break;
    }
    bench_inputs_set(board, &inputs);
}

static void obey(bench_board *board, script *from)
{
    uint8_t operation = byte(from) % OPERATIONS;
    size_t length;

    switch (operation) {
    case FRAME:
    case RAW:
        length = byte(from);
        length = length > from->left ? from->left : length;
        if (operation == FRAME) {
            say_frame(board, from->at, length);
        } else {
            bench_send(board, from->at, length);
            bench_poll(board);
        }
        from->at += length;
        from->left -= length;
        break;
    case ADVANCE: bench_advance_us(board, (uint32_t)byte(from) * (ADVANCE_US_MAX / 255)); break;
    case INPUT: feel(board, from); break;
    case POWER_CUT: bench_flash_cut_after(board, (uint32_t)byte(from) * 8u); break;
    case BOOT: bench_boot(board, byte(from)); break;
    default: bench_line_capacity(board, (size_t)byte(from) * 64); break;
    }
}

static void check(const bench_board *board)
{
    float demand_nm = bench_motor_torque_nm(board);

    if (!(demand_nm >= -DEMAND_NM_MAX && demand_nm <= DEMAND_NM_MAX)) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const uint8_t hello[] = {0x20, 1, 1, 0, 1, 1, 0, 0, 0x20, 2, 0, 1, 2, 3, 4, 5, 6, 7};
    script from = {data, size};
    bench_board *board = bench_create(FLASH_BLOCK_BYTES, FLASH_BYTES);

    if (board == NULL || bench_provision(board) < 0) abort();
    bench_boot(board, 1);
    say_frame(board, hello, sizeof hello);
    for (int i = 0; i < OPERATIONS_MAX && from.left > 0; i++) {
        obey(board, &from);
        hear(board);
        check(board);
    }
    bench_destroy(board);
    return 0;
}
