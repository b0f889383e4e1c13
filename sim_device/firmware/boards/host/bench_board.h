/* A board that is all memory: the whole application on a test bench, with a hand on every input.
 *
 * Time stands still until it is advanced; the serial line is two byte queues; the flash counts
 * every byte it erases or programs and can lose power after any of them. */
#ifndef SPINDLE_BENCH_BOARD_H
#define SPINDLE_BENCH_BOARD_H

#include <stddef.h>
#include <stdint.h>

#include "assist_types.h" // assist_output
#include "hal.h"          // hal_inputs

#define BENCH_LINE_BYTES 65536

typedef struct bench_board bench_board;

/* A board with erased flash, not yet powered. NULL without memory. */
bench_board *bench_create(size_t flash_block_size, size_t flash_size);
void bench_destroy(bench_board *board);

/* The factory's last step: the default configuration in the first slot. 0 or negative. */
int bench_provision(bench_board *board);

/* The factory's choice: the maker's public key of 32 bytes. 0 or negative. */
int bench_provision_unlock_key(bench_board *board, const uint8_t *key);

/* Another serial number, of 12 bytes. */
void bench_uid(bench_board *board, const uint8_t *uid);

/* Power on: RAM starts anew, flash keeps what it holds, the flash works again. */
void bench_boot(bench_board *board, uint32_t boot_id);

/* Lets time pass: the line is served every millisecond, the control step runs every ten. */
void bench_advance_us(bench_board *board, uint32_t duration_us);

/* Serves the line once without letting time pass. */
void bench_poll(bench_board *board);

/* Host to unit; returns how many bytes the line took. */
size_t bench_send(bench_board *board, const uint8_t *bytes, size_t length);

/* Unit to host; returns how many bytes were waiting, at most `capacity`. */
size_t bench_receive(bench_board *board, uint8_t *bytes, size_t capacity);

/* Bytes the unit may write before the host reads: a full line takes nothing. */
void bench_line_capacity(bench_board *board, size_t bytes);

/* What the unit believes the line carries, bits per second; 0: no limit. */
void bench_line_baud(bench_board *board, uint32_t baud);

/* Rates that SET_BAUD may ask for, as bits of ebl_baud_rates; 0: the line has one rate. */
void bench_line_offers(bench_board *board, uint16_t bauds);
uint32_t bench_line_baud_now(const bench_board *board);

void bench_inputs_get(const bench_board *board, hal_inputs *inputs);
void bench_inputs_set(bench_board *board, const hal_inputs *inputs);

/* The wheel rolls at this speed from now on, as if it always had: the unit reads it at once, and
 * its pulses follow to the microsecond. 0: it stands, and has for long. */
void bench_wheel_set(bench_board *board, float speed_kmh);

/* 1: requests from 0x7000 on are echoed by the board; 0: the board has none. From the next boot. */
void bench_board_requests(bench_board *board, int present);

float bench_motor_torque_nm(const bench_board *board);

/* Control steps, polls, or both (3) come no more, until 0 is said or the next boot. */
#define BENCH_HANG_STEPS 1
#define BENCH_HANG_POLLS 2
void bench_hang(bench_board *board, int hung);

/* Kicks of the watchdog since the boot; whether the unit switched the motor off by hardware; and
 * what the next boot is told of its cause, an ebl_reset_cause. */
uint32_t bench_kicks(const bench_board *board);
int bench_motor_is_off(const bench_board *board);
void bench_reset_cause(bench_board *board, uint8_t cause);

/* Damages the law's memory: what it remembers (0), a point of its table (1), its limit (2) or its
 * gear (3). */
void bench_hurt_law(bench_board *board, int which);
uint64_t bench_now_us(const bench_board *board);
void bench_output(const bench_board *board, assist_output *output);

/* Bytes erased or programmed since the last boot, one step each. */
uint32_t bench_flash_steps(const bench_board *board);

/* Power for the flash ends after `steps` more steps, in the middle of an operation if need be. */
void bench_flash_cut_after(bench_board *board, uint32_t steps);

/* Programming succeeds `count` more times, then one bit of a byte stays as it was, unreported. */
void bench_flash_weak_bit_after(bench_board *board, uint32_t count);

uint8_t *bench_flash(bench_board *board);
size_t bench_flash_size(const bench_board *board);

/* Flash for ride logs; gives up the one before. Without it the board has 8 blocks of 2 KB. */
int bench_log_flash(bench_board *board, size_t block_size, size_t size);
uint8_t *bench_log(bench_board *board);
size_t bench_log_size(const bench_board *board);

/* As for the other flash: bytes erased or programmed since the last boot, and the end of power. */
uint32_t bench_log_steps(const bench_board *board);
void bench_log_cut_after(bench_board *board, uint32_t steps);

/* The flash stays busy for ever, or works again. */
void bench_log_stuck(bench_board *board, int stuck);

/* Erases and programs begun in it, the refused ones of a lost supply included. */
uint32_t bench_log_changes(const bench_board *board);

/* A block of it that is never erased again. */
void bench_log_worn(bench_board *board, size_t address);

/* Frames of ride logs sent, and how many of them again, in the latest session. */
uint32_t bench_bulk_sent(const bench_board *board);
uint32_t bench_bulk_repeated(const bench_board *board);

/* Time passes at once, without a poll, and without being missed. */
void bench_skip_us(bench_board *board, uint64_t duration_us);

/* Challenges of the lock past the line, 16 bytes each; returns how many were given. */
uint32_t bench_unlock_nonces(bench_board *board, uint8_t level, uint32_t count, uint8_t *nonces);

/* An attempt past the line, for what is active. A status, and its detail. */
uint8_t bench_unlock_attempt(bench_board *board, const uint8_t *signature, uint16_t *detail);

/* RAM that one application takes. */
size_t bench_app_bytes(void);

#endif
