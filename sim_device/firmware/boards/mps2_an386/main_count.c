/* How many instructions the firmware takes, and how deep its stack goes, told through semihosting.
 *
 * Stands alone, so that every run under QEMU's -icount gives the same numbers: the host's bench
 * board carries a ride and a talk that are written down here. SysTick counts processor ticks; with
 * -icount shift=6 one instruction is 64 ns of virtual time, 1.6 ticks. Those are instructions, not
 * cycles: no wait states, no pipeline. */
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "app.h"              // app_control_step
#include "chip.h"             // CHIP_SYSTICK
#include "ebl_bytes.h"        // ebl_put_u16
#include "ebl_frame.h"        // ebl_frame_encode
#include "ebl_layout.h"       // EBL_MESSAGE, ebl_layout_put
#include "config/signature.h" // signature_is_valid

#define STEPS 2000
#define PINGS 200
#define STREAM_CHANNELS 12
#define SYSTICK_FULL 0xFFFFFFu
#define PAINT 0x5AFEC0DEu
#define STACK_WORDS 4096

typedef struct {
    uint64_t ticks;
    uint32_t worst;
    uint32_t events;
} tally;

static app unit;
static hal board;
static uint64_t time_us;
static hal_inputs ride;
static float way_pulses; /* of the wheel, since its latest pulse */
static uint8_t to_unit[1024];
static size_t to_unit_length;
static uint32_t bytes_out;
static uint8_t flash[8192];

extern uint32_t stack_top[];

/* Semihosting: operation 4 writes a text, 0x18 ends QEMU. */
static void semihosting(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = argument;

    __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

static void tell(const char *name, uint64_t value)
{
    char digits[24];
    size_t at = sizeof digits;

    digits[--at] = '\0';
    digits[--at] = '\n';
    do {
        digits[--at] = (char)('0' + (char)(value % 10));
        value /= 10;
    } while (value > 0);
    semihosting(4, name);
    semihosting(4, " ");
    semihosting(4, digits + at);
}

static uint64_t now_us(void *context)
{
    (void)context;
    return time_us;
}

static size_t serial_read(void *context, uint8_t *bytes, size_t capacity)
{
    size_t length = to_unit_length < capacity ? to_unit_length : capacity;

    (void)context;
    memcpy(bytes, to_unit, length);
    memmove(to_unit, to_unit + length, to_unit_length - length);
    to_unit_length -= length;
    return length;
}

static size_t serial_write(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    (void)bytes;
    bytes_out += (uint32_t)length;
    return length;
}

static size_t serial_writable(void *context)
{
    (void)context;
    return 4096;
}

static void inputs_read(void *context, hal_inputs *inputs)
{
    (void)context;
    *inputs = ride;
}

static void motor_torque_set(void *context, float motor_torque_nm)
{
    (void)context;
    (void)motor_torque_nm;
}

static void watchdog_kick(void *context) { (void)context; }

static void motor_off(void *context, uint8_t cause)
{
    (void)context;
    (void)cause;
}

static int flash_read(void *context, size_t address, uint8_t *bytes, size_t length)
{
    (void)context;
    memcpy(bytes, flash + address, length);
    return 0;
}

static int flash_erase(void *context, size_t address)
{
    (void)context;
    memset(flash + address, 0xFF, 1024);
    return 0;
}

static int flash_program(void *context, size_t address, const uint8_t *bytes, size_t length)
{
    (void)context;
    for (size_t i = 0; i < length; i++) flash[address + i] &= bytes[i];
    return 0;
}

static void board_connect(void)
{
    static const uint8_t uid[12] = {0};
    ebl_config factory;

    memset(flash, 0xFF, sizeof flash);
    board.now_us = now_us;
    board.serial_read = serial_read;
    board.serial_write = serial_write;
    board.serial_writable = serial_writable;
    board.inputs_read = inputs_read;
    board.motor_torque_set = motor_torque_set;
    board.watchdog_kick = watchdog_kick;
    board.motor_off = motor_off;
    board.flash_block_size = 1024;
    board.flash_size = sizeof flash;
    board.flash_read = flash_read;
    board.flash_erase = flash_erase;
    board.flash_program = flash_program;
    board.uid = uid;
    ebl_config_default(&factory);
    (void)app_provision(&board, &factory);
}

static void count(tally *all, void (*work)(app *))
{
    uint32_t before = CHIP_SYSTICK->value;
    uint32_t ticks;

    work(&unit);
    ticks = (before - CHIP_SYSTICK->value) & SYSTICK_FULL;
    all->ticks += ticks;
    all->events++;
    if (ticks > all->worst) all->worst = ticks;
}

static void nothing(app *same) { (void)same; }

static void request(uint8_t tid, uint16_t message_id, const uint8_t *payload, size_t length)
{
    uint8_t frame[128];

    ebl_header_put(frame, EBL_KIND_REQUEST, 0, tid, message_id);
    memcpy(frame + EBL_HEADER_LENGTH, payload, length);
    (void)ebl_frame_encode(frame, EBL_HEADER_LENGTH + length, to_unit, sizeof to_unit,
                           &to_unit_length);
}

/* A rider who pushes in strokes and accelerates to 25 km/h: each law's branches are taken. */
static void ride_on(int step)
{
    int stroke = step % 40 < 20 ? step % 40 : 40 - step % 40;

    ride.torque_raw_counts = (float)(stroke * 180);
    float speed_kmh = 25.0f * (float)step / (float)STEPS;

    /* A pulse of 36 is 57.6 mm, and 1 km/h brings 0.048 of it in a step. */
    way_pulses += 0.0482f * speed_kmh;
    if (way_pulses >= 1.0f) {
        way_pulses -= 1.0f;
        ride.wheel_pulses++;
        ride.wheel_pulse_us = time_us;
    }
    ride.cadence_rpm = 3.0f * speed_kmh;
    ride.motor_speed_rpm = 120.0f * speed_kmh;
    ride.battery_voltage_v = 37.0f;
    ride.battery_current_a = 11.5f;
    ride.motor_temperature_degc = 60.0f;
    ride.mode_selected = 3; /* fuzzy */
}

static void steps_count(const char *name, const char *worst)
{
    tally all = {0, 0, 0};
    tally none = {0, 0, 0};

    for (int step = 0; step < STEPS; step++) {
        ride_on(step);
        time_us += 10000;
        count(&none, nothing);
        count(&all, app_control_step);
        app_poll(&unit);
    }
    tell(name, (all.ticks - none.ticks) * 10 / STEPS);
    tell(worst, all.worst - none.worst);
}

static void bytes_count(void)
{
    static const uint8_t payload[100] = {1, 2, 3};
    tally idle = {0, 0, 0};
    tally busy = {0, 0, 0};
    uint64_t bytes = 0;

    for (int k = 0; k < PINGS; k++) {
        time_us += 10;
        count(&idle, app_poll);
        request((uint8_t)(k % 255 + 1), EBL_MSG_PING, payload, 0);
        to_unit[to_unit_length - 2] ^= 1; /* the check value is wrong: receiving alone is counted */
        memmove(to_unit + to_unit_length, to_unit, to_unit_length);
        to_unit_length *= 2;
        bytes += to_unit_length;
        count(&busy, app_poll);
    }
    tell("idle_poll_ticks10", idle.ticks * 10 / PINGS);
    tell("byte_ticks10", (busy.ticks - idle.ticks) * 10 / bytes);
}

/* Twelve channels at 100 Hz in frames of ten rows: what the live page asks for. */
static void subscribe(void)
{
    uint8_t channels[STREAM_CHANNELS];
    uint8_t payload[64];
    size_t length = 0;
    ebl_str_subscribe_request wanted = {0};

    for (size_t i = 0; i < sizeof channels; i++) channels[i] = ebl_channels[i].id;
    wanted.stream_id = 1;
    wanted.divider = 1;
    wanted.batch = 10;
    wanted.lease_s = 255;
    wanted.channel_ids = channels;
    wanted.channel_ids_length = sizeof channels;
    (void)ebl_layout_put(EBL_MESSAGE(ebl_str_subscribe_request, &wanted), payload, sizeof payload,
                         &length);
    request(2, EBL_MSG_STR_SUBSCRIBE, payload, length);
    app_poll(&unit);
}

/* The first signature of RFC 8032, 7.1: what checking a maker's token takes. */
static void signature_count(void)
{
    static const uint8_t key[] = {0xd7, 0x5a, 0x98, 0x01, 0x82, 0xb1, 0x0a, 0xb7, 0xd5, 0x4b, 0xfe,
                                  0xd3, 0xc9, 0x64, 0x07, 0x3a, 0x0e, 0xe1, 0x72, 0xf3, 0xda, 0xa6,
                                  0x23, 0x25, 0xaf, 0x02, 0x1a, 0x68, 0xf7, 0x07, 0x51, 0x1a};
    static const uint8_t signature[] = {
        0xe5, 0x56, 0x43, 0x00, 0xc3, 0x60, 0xac, 0x72, 0x90, 0x86, 0xe2, 0xcc, 0x80,
        0x6e, 0x82, 0x8a, 0x84, 0x87, 0x7f, 0x1e, 0xb8, 0xe5, 0xd9, 0x74, 0xd8, 0x73,
        0xe0, 0x65, 0x22, 0x49, 0x01, 0x55, 0x5f, 0xb8, 0x82, 0x15, 0x90, 0xa3, 0x3b,
        0xac, 0xc6, 0x1e, 0x39, 0x70, 0x1c, 0xf9, 0xb4, 0x6b, 0xd2, 0x5b, 0xf5, 0xf0,
        0x59, 0x5b, 0xbe, 0x24, 0x65, 0x51, 0x41, 0x43, 0x8e, 0x7a, 0x10, 0x0b};
    uint32_t before;

    CHIP_TIMER0->reload = UINT32_MAX;
    CHIP_TIMER0->value = UINT32_MAX;
    CHIP_TIMER0->control = 1;
    before = CHIP_TIMER0->value;
    if (!signature_is_valid(signature, key, NULL, 0)) return;
    tell("signature_ticks", before - CHIP_TIMER0->value);
}

static void stack_paint(void)
{
    volatile uint32_t *word = stack_top - STACK_WORDS;
    const volatile uint32_t *here;

    __asm volatile("mov %0, sp" : "=r"(here));
    while (word < here) *word++ = PAINT;
}

static uint32_t stack_deepest(void)
{
    const uint32_t *word = stack_top - STACK_WORDS;

    while (*word == PAINT) word++;
    return (uint32_t)((uintptr_t)stack_top - (uintptr_t)word);
}

int main(void)
{
    static const uint8_t hello[] = {1, 1, 0, 0, 0x20, 2, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8};

    stack_paint();
    CHIP_SYSTICK->reload = SYSTICK_FULL;
    CHIP_SYSTICK->value = 0;
    CHIP_SYSTICK->control = 5; /* without its interrupt */
    board_connect();
    app_init(&unit, &board);
    request(1, EBL_MSG_HELLO, hello, sizeof hello);
    app_poll(&unit);
    steps_count("step_ticks10", "step_worst_ticks");
    subscribe();
    steps_count("streaming_step_ticks10", "streaming_step_worst_ticks");
    bytes_count();
    tell("stack_bytes", stack_deepest());
    signature_count();
    tell("signature_stack_bytes", stack_deepest());
    semihosting(0x18, (const void *)0x20026u);
    return 0;
}
