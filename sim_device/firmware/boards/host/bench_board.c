#include "bench_board.h"

#include <stdlib.h>
#include <string.h>

#include "app.h"         // app
#include "wheel_speed.h" // wheel_speed_pulses
#include "log_flash.h"   // log_flash

#define BENCH_POLL_US 1000u
#define BENCH_CONTROL_US 10000u
#define FLASH_NEVER UINT32_MAX
#define LOG_BLOCK_SIZE 2048
#define LOG_SIZE 16384

typedef struct {
    uint8_t bytes[BENCH_LINE_BYTES];
    size_t length;
    size_t capacity;
} line;

struct bench_board {
    app app;
    hal hal;
    uint64_t now_us;
    line to_unit;
    line to_host;
    hal_inputs inputs;
    float wheel_kmh;
    double pulse_period_us; /* 0: the wheel stands */
    double pulse_due_us;
    float motor_torque_nm;
    uint8_t *flash;
    uint32_t flash_steps;
    uint32_t flash_steps_left;
    uint32_t flash_weak_bit_countdown;
    log_flash log;
    uint8_t uid[12];
    uint8_t powered;
    uint8_t hung; /* bits of bench_hang */
    uint8_t motor_is_off;
    uint32_t kicks;
};

static size_t line_write(line *queue, const uint8_t *bytes, size_t length)
{
    size_t space = queue->length < queue->capacity ? queue->capacity - queue->length : 0;
    size_t taken = length < space ? length : space;

    memcpy(queue->bytes + queue->length, bytes, taken);
    queue->length += taken;
    return taken;
}

static size_t line_read(line *queue, uint8_t *bytes, size_t capacity)
{
    size_t taken = queue->length < capacity ? queue->length : capacity;

    memcpy(bytes, queue->bytes, taken);
    memmove(queue->bytes, queue->bytes + taken, queue->length - taken);
    queue->length -= taken;
    return taken;
}

static uint64_t now_us(void *context) { return ((const bench_board *)context)->now_us; }

static size_t serial_read(void *context, uint8_t *bytes, size_t capacity)
{
    return line_read(&((bench_board *)context)->to_unit, bytes, capacity);
}

static size_t serial_write(void *context, const uint8_t *bytes, size_t length)
{
    return line_write(&((bench_board *)context)->to_host, bytes, length);
}

static size_t serial_writable(void *context)
{
    const line *queue = &((const bench_board *)context)->to_host;

    return queue->length < queue->capacity ? queue->capacity - queue->length : 0;
}

static int serial_baud_set(void *context, uint32_t baud)
{
    ((bench_board *)context)->hal.serial_baud = baud;
    return 0;
}

static int serial_drained(void *context)
{
    return ((const bench_board *)context)->to_host.length == 0;
}

static void wheel_turn(bench_board *board)
{
    double behind;

    if (!(board->pulse_period_us > 0.0)) return;
    /* A clock that was set far ahead: whole pulses at once. */
    behind = ((double)board->now_us - board->pulse_due_us) / board->pulse_period_us;
    if (behind > 1000.0) {
        board->inputs.wheel_pulses += (uint32_t)(uint64_t)behind;
        board->pulse_due_us = (double)board->now_us;
    }
    while (board->pulse_due_us <= (double)board->now_us) {
        board->inputs.wheel_pulses++;
        board->inputs.wheel_pulse_us = (uint64_t)(board->pulse_due_us + 0.5);
        board->pulse_due_us += board->pulse_period_us;
    }
}

static void inputs_read(void *context, hal_inputs *inputs)
{
    bench_board *board = context;

    wheel_turn(board);
    *inputs = board->inputs;
}

static void watchdog_kick(void *context) { ((bench_board *)context)->kicks++; }

static void motor_off(void *context, uint8_t cause)
{
    bench_board *board = context;

    board->motor_is_off = 1;
    board->motor_torque_nm = 0.0f;
    board->hal.reset_cause = cause;
}

static void motor_torque_set(void *context, float motor_torque_nm)
{
    bench_board *board = context;

    board->motor_torque_nm = board->motor_is_off ? 0.0f : motor_torque_nm;
}

/* One byte of wear. False once the power is gone. */
static int flash_step(bench_board *board)
{
    if (board->flash_steps_left == 0) return 0;
    if (board->flash_steps_left != FLASH_NEVER) board->flash_steps_left--;
    board->flash_steps++;
    return 1;
}

static int flash_read(void *context, size_t address, uint8_t *bytes, size_t length)
{
    const bench_board *board = context;

    if (address > board->hal.flash_size || length > board->hal.flash_size - address) return -1;
    memcpy(bytes, board->flash + address, length);
    return 0;
}

static int flash_erase(void *context, size_t address)
{
    bench_board *board = context;

    if (address >= board->hal.flash_size || address % board->hal.flash_block_size != 0) return -1;
    for (size_t i = 0; i < board->hal.flash_block_size; i++) {
        if (!flash_step(board)) return -1;
        board->flash[address + i] = 0xFF;
    }
    return 0;
}

static int flash_program(void *context, size_t address, const uint8_t *bytes, size_t length)
{
    bench_board *board = context;

    if (address > board->hal.flash_size || length > board->hal.flash_size - address) return -1;
    for (size_t i = 0; i < length; i++) {
        uint8_t before = board->flash[address + i];

        if (!flash_step(board)) return -1;
        board->flash[address + i] = before & bytes[i];
        if (board->flash_weak_bit_countdown == 0 && before != bytes[i]) {
            board->flash[address + i] = before;
            board->flash_weak_bit_countdown = FLASH_NEVER;
        }
    }
    if (board->flash_weak_bit_countdown != FLASH_NEVER && board->flash_weak_bit_countdown > 0) {
        board->flash_weak_bit_countdown--;
    }
    return 0;
}

static int board_request(void *context, uint16_t message_id, const uint8_t *request, size_t length,
                         uint8_t *response, size_t capacity, size_t *response_length)
{
    (void)context;
    (void)message_id;
    *response_length = length < capacity ? length : capacity;
    memcpy(response, request, *response_length);
    return 0;
}

static void hal_fill(bench_board *board, size_t flash_block_size, size_t flash_size)
{
    hal *door = &board->hal;

    door->context = board;
    door->now_us = now_us;
    door->serial_read = serial_read;
    door->serial_write = serial_write;
    door->serial_writable = serial_writable;
    door->inputs_read = inputs_read;
    door->motor_torque_set = motor_torque_set;
    door->watchdog_kick = watchdog_kick;
    door->motor_off = motor_off;
    door->flash_block_size = flash_block_size;
    door->flash_size = flash_size;
    door->flash_read = flash_read;
    door->flash_erase = flash_erase;
    door->flash_program = flash_program;
    door->uid = board->uid;
    door->device_class = 129;
    door->hardware_revision = 1;
}

bench_board *bench_create(size_t flash_block_size, size_t flash_size)
{
    bench_board *board = calloc(1, sizeof *board);

    if (board == NULL) return NULL;
    board->flash = malloc(flash_size > 0 ? flash_size : 1);
    if (board->flash == NULL) {
        free(board);
        return NULL;
    }
    memset(board->flash, 0xFF, flash_size);
    if (bench_log_flash(board, LOG_BLOCK_SIZE, LOG_SIZE) < 0) {
        bench_destroy(board);
        return NULL;
    }
    memcpy(board->uid, "bench-unit-1", sizeof board->uid);
    hal_fill(board, flash_block_size, flash_size);
    board->to_unit.capacity = BENCH_LINE_BYTES;
    board->to_host.capacity = BENCH_LINE_BYTES;
    board->inputs.battery_voltage_v = 36.0f;
    board->inputs.battery_soc_pct = 80.0f;
    board->inputs.sensor_temperature_degc = 25.0f;
    board->inputs.motor_temperature_degc = 25.0f;
    board->inputs.controller_temperature_degc = 25.0f;
    board->inputs.mode_selected = HAL_MODE_NOT_SELECTED;
    board->flash_steps_left = FLASH_NEVER;
    board->flash_weak_bit_countdown = FLASH_NEVER;
    return board;
}

void bench_destroy(bench_board *board)
{
    if (board == NULL) return;
    log_flash_close(&board->log);
    free(board->flash);
    free(board);
}

int bench_provision(bench_board *board)
{
    ebl_config config;

    ebl_config_default(&config);
    return app_provision(&board->hal, &config);
}

int bench_provision_unlock_key(bench_board *board, const uint8_t *key)
{
    return app_provision_unlock_key(&board->hal, key);
}

void bench_uid(bench_board *board, const uint8_t *uid)
{
    memcpy(board->uid, uid, sizeof board->uid);
}

/* Eight pulses of the past: more than bounces that nobody believes, and enough for the window. */
static void wheel_roll(bench_board *board)
{
    const ebl_config *config = &board->app.config.in_force;
    double pulse_m = (double)config->wheel_circumference_m / (double)config->wheel_pulses_per_turn;
    float pulse = config->wheel_circumference_m / (float)config->wheel_pulses_per_turn;
    hal_inputs *inputs = &board->inputs;

    wheel_speed_init(&board->app.speed.wheel);
    (void)wheel_speed_pulses(&board->app.speed.wheel, pulse, inputs->wheel_pulses, 0);
    board->pulse_period_us = 0.0;
    if (!(board->wheel_kmh > 0.0f)) return;
    board->pulse_period_us = pulse_m * 3.6e6 / (double)board->wheel_kmh;
    if (board->pulse_period_us < 1.0) board->pulse_period_us = 1.0;
    for (int back = 7; back >= 0; back--) {
        int64_t ago_us = (int64_t)(board->pulse_period_us * (double)back + 0.5);

        inputs->wheel_pulses++;
        inputs->wheel_pulse_us = board->now_us - (uint64_t)ago_us;
        (void)wheel_speed_pulses(&board->app.speed.wheel, pulse, inputs->wheel_pulses,
                                 inputs->wheel_pulse_us);
    }
    board->pulse_due_us = (double)board->now_us + board->pulse_period_us;
}

void bench_boot(bench_board *board, uint32_t boot_id)
{
    board->now_us = 0;
    board->to_unit.length = 0;
    board->to_host.length = 0;
    board->motor_torque_nm = 0.0f;
    board->motor_is_off = 0;
    board->hung = 0;
    board->kicks = 0;
    board->flash_steps = 0;
    board->flash_steps_left = FLASH_NEVER;
    board->flash_weak_bit_countdown = FLASH_NEVER;
    board->hal.boot_id = boot_id;
    log_flash_power_on(&board->log);
    app_init(&board->app, &board->hal);
    wheel_roll(board);
    board->powered = 1;
}

void bench_poll(bench_board *board)
{
    if (board->powered) app_poll(&board->app);
}

void bench_advance_us(bench_board *board, uint32_t duration_us)
{
    uint64_t end_us = board->now_us + duration_us;

    while (board->powered && board->now_us < end_us) {
        uint64_t next_us = board->now_us - board->now_us % BENCH_POLL_US + BENCH_POLL_US;

        board->now_us = next_us < end_us ? next_us : end_us;
        if (board->now_us % BENCH_CONTROL_US == 0 && !(board->hung & BENCH_HANG_STEPS)) {
            app_control_step(&board->app);
        }
        if (!(board->hung & BENCH_HANG_POLLS)) app_poll(&board->app);
    }
}

void bench_hang(bench_board *board, int hung) { board->hung = (uint8_t)hung; }

uint32_t bench_kicks(const bench_board *board) { return board->kicks; }

int bench_motor_is_off(const bench_board *board) { return board->motor_is_off; }

void bench_reset_cause(bench_board *board, uint8_t cause) { board->hal.reset_cause = cause; }

void bench_hurt_law(bench_board *board, int which)
{
    switch (which) {
    case 0: board->app.assist_state.torque_filtered_nm = __builtin_nanf(""); break;
    case 1: board->app.config.law.table.gain_points[4] = __builtin_nanf(""); break;
    case 2: board->app.config.law.motor_torque_nm_max = __builtin_nanf(""); break;
    default: board->app.config.law.gear_ratio = __builtin_nanf("");
    }
}

size_t bench_send(bench_board *board, const uint8_t *bytes, size_t length)
{
    return line_write(&board->to_unit, bytes, length);
}

size_t bench_receive(bench_board *board, uint8_t *bytes, size_t capacity)
{
    return line_read(&board->to_host, bytes, capacity);
}

void bench_line_capacity(bench_board *board, size_t bytes)
{
    board->to_host.capacity = bytes < BENCH_LINE_BYTES ? bytes : BENCH_LINE_BYTES;
}

void bench_line_baud(bench_board *board, uint32_t baud) { board->hal.serial_baud = baud; }

void bench_line_offers(bench_board *board, uint16_t bauds)
{
    board->hal.serial_bauds = bauds;
    board->hal.serial_baud_set = serial_baud_set;
    board->hal.serial_drained = serial_drained;
}

uint32_t bench_line_baud_now(const bench_board *board) { return board->hal.serial_baud; }

void bench_wheel_set(bench_board *board, float speed_kmh)
{
    board->wheel_kmh = speed_kmh;
    wheel_roll(board);
}

void bench_inputs_get(const bench_board *board, hal_inputs *inputs) { *inputs = board->inputs; }

void bench_inputs_set(bench_board *board, const hal_inputs *inputs) { board->inputs = *inputs; }

void bench_board_requests(bench_board *board, int present)
{
    board->hal.board_request = present ? board_request : NULL;
}

float bench_motor_torque_nm(const bench_board *board) { return board->motor_torque_nm; }

uint64_t bench_now_us(const bench_board *board) { return board->now_us; }

void bench_output(const bench_board *board, assist_output *output)
{
    *output = *app_output(&board->app);
}

uint32_t bench_flash_steps(const bench_board *board) { return board->flash_steps; }

void bench_flash_cut_after(bench_board *board, uint32_t steps) { board->flash_steps_left = steps; }

void bench_flash_weak_bit_after(bench_board *board, uint32_t count)
{
    board->flash_weak_bit_countdown = count;
}

uint8_t *bench_flash(bench_board *board) { return board->flash; }

size_t bench_flash_size(const bench_board *board) { return board->hal.flash_size; }

int bench_log_flash(bench_board *board, size_t block_size, size_t size)
{
    log_flash_close(&board->log);
    if (log_flash_open(&board->log, block_size, size, NULL) < 0) return -1;
    log_flash_connect(&board->log, &board->hal, &board->now_us);
    return 0;
}

uint8_t *bench_log(bench_board *board) { return board->log.bytes; }

size_t bench_log_size(const bench_board *board) { return board->log.size; }

uint32_t bench_log_steps(const bench_board *board) { return board->log.steps; }

void bench_log_cut_after(bench_board *board, uint32_t steps) { board->log.steps_left = steps; }

uint32_t bench_log_changes(const bench_board *board) { return board->log.changes; }

void bench_log_worn(bench_board *board, size_t address) { board->log.worn_address = address; }

void bench_log_stuck(bench_board *board, int stuck)
{
    board->log.busy_until_us = stuck ? UINT64_MAX : 0;
}

uint32_t bench_bulk_sent(const bench_board *board) { return board->app.bulk.frames_sent; }

uint32_t bench_bulk_repeated(const bench_board *board) { return board->app.bulk.frames_repeated; }

void bench_skip_us(bench_board *board, uint64_t duration_us)
{
    board->now_us += duration_us;
    board->app.watch.step_us += duration_us;
}

uint32_t bench_unlock_nonces(bench_board *board, uint8_t level, uint32_t count, uint8_t *nonces)
{
    ebl_auth_challenge_response given;
    uint16_t detail;

    for (uint32_t i = 0; i < count; i++) {
        if (unlock_challenge(&board->app.config.unlock, &board->hal, level, &given, &detail) !=
            EBL_STATUS_OK) {
            return i;
        }
        memcpy(nonces + (size_t)i * sizeof given.nonce, given.nonce, sizeof given.nonce);
    }
    return count;
}

uint8_t bench_unlock_attempt(bench_board *board, const uint8_t *signature, uint16_t *detail)
{
    ebl_auth_response_request token = {0};

    token.expires_us = UINT64_MAX;
    memcpy(token.signature, signature, sizeof token.signature);
    return unlock_respond(&board->app.config.unlock, &board->hal, &token,
                          board->app.config.store.image, detail);
}

size_t bench_app_bytes(void) { return sizeof(app); }
