/* The drive unit on the AN386: what a product's main() is. */
#include <stddef.h>

#include "app.h"               // app_init
#include "chip.h"              // chip_sleep
#include "clock.h"             // clock_now_us
#include "flash.h"             // flash_connect
#include "plant.h"             // plant_inputs
#include "safe_stop.h"         // safe_stop_note
#include "faults/step_watch.h" // steps_due
#include "uart.h"              // uart_read
#include "watchdog.h"          // watchdog_kick

#define HOST_BAUD 1000000u /* where bytes take no time, as in QEMU */
#define HOST_BAUDS                                                                                 \
    (EBL_BAUD_RATES_BAUD_115200 | EBL_BAUD_RATES_BAUD_230400 | EBL_BAUD_RATES_BAUD_460800 |        \
     EBL_BAUD_RATES_BAUD_921600 | EBL_BAUD_RATES_BAUD_1000000)
#define CONTROL_PERIOD_US 10000u
#define HARDWARE_REVISION 2u

static app unit;
static hal board;

/* Of the loop's present round. A control step has the time it was due at, as if a timer had called
 * it, so that rows of telemetry lie evenly. */
static uint64_t round_us;

static uint64_t now_us(void *context)
{
    (void)context;
    return round_us;
}

static size_t serial_read(void *context, uint8_t *bytes, size_t capacity)
{
    (void)context;
    return uart_read(UART_HOST, bytes, capacity);
}

static size_t serial_write(void *context, const uint8_t *bytes, size_t length)
{
    (void)context;
    return uart_write(UART_HOST, bytes, length);
}

static size_t serial_writable(void *context)
{
    (void)context;
    return uart_writable(UART_HOST);
}

static int serial_baud_set(void *context, uint32_t baud)
{
    (void)context;
    uart_baud_set(UART_HOST, baud);
    board.serial_baud = baud;
    return 0;
}

static int serial_drained(void *context)
{
    (void)context;
    return uart_is_drained(UART_HOST);
}

static void inputs_read(void *context, hal_inputs *inputs)
{
    (void)context;
    plant_inputs(inputs, round_us);
}

/* The bench is told after the step, with what else it wants to know. */
static void motor_torque_set(void *context, float motor_torque_nm)
{
    (void)context;
    plant_motor_set(motor_torque_nm);
}

static void kick(void *context)
{
    (void)context;
    watchdog_kick();
}

static void motor_off(void *context, uint8_t cause)
{
    (void)context;
    safe_stop_note(cause);
}

static int board_request(void *context, uint16_t message_id, const uint8_t *request, size_t length,
                         uint8_t *response, size_t capacity, size_t *response_length)
{
    (void)context;
    return plant_request(message_id, request, length, response, capacity, response_length);
}

static void board_connect(void)
{
    const flash_identity *identity;
    ebl_config factory;

    board.now_us = now_us;
    board.serial_read = serial_read;
    board.serial_write = serial_write;
    board.serial_writable = serial_writable;
    board.serial_baud = HOST_BAUD;
    board.inputs_read = inputs_read;
    board.motor_torque_set = motor_torque_set;
    board.watchdog_kick = kick;
    board.motor_off = motor_off;
    board.board_request = board_request;
    board.device_class = EBL_DEVICE_CLASS_MID_DRIVE_SIMULATED;
    board.hardware_revision = HARDWARE_REVISION;
    identity = flash_connect(&board);
    if (identity->serial_baud != 0) {
        board.serial_bauds = HOST_BAUDS;
        board.serial_baud_set = serial_baud_set;
        board.serial_drained = serial_drained;
        (void)serial_baud_set(NULL, identity->serial_baud);
    }
    if (identity->market_present) {
        app_factory_config(&factory, identity->market_number);
        (void)app_provision(&board, &factory); /* what it could not write the boot reports */
    }
    if (identity->unlock_key_present) {
        (void)app_provision_unlock_key(&board, identity->unlock_key);
    }
}

/* In time that the bench grants, bytes take none: it stands until the line has taken them, however
   late the host is. */
static int time_waits_for_the_line(void)
{
    return clock_is_by_bench() && !uart_is_drained(UART_HOST);
}

int main(void)
{
    uint64_t next_step_us = 0;
    uint64_t step_us;

    board.reset_cause = safe_stop_open();
    clock_open();
    uart_open(UART_HOST, HOST_BAUD);
    chip_interrupts_on();
    plant_open();
    board_connect();
    app_init(&unit, &board);
    for (;;) {
        int waits = time_waits_for_the_line();
        int passing;

        plant_poll();
        round_us = clock_now_us();
        /* Halted by the bench, as by a debugger. */
        if ((waits || !clock_runs()) && !unit.watch.stopped) watchdog_kick();
        if (clock_runs() && plant_steps_come() && steps_due(&next_step_us, round_us, &step_us)) {
            round_us = step_us;
            app_control_step(&unit);
            plant_step_tell(app_output(&unit), unit.config.in_force.assist_mode_at_start);
        }
        app_poll(&unit);
        waits = time_waits_for_the_line();
        passing = !waits && clock_pass();
        if (!passing && round_us + CONTROL_PERIOD_US > clock_now_us()) {
            if (!waits) plant_passed_tell();
            chip_sleep();
        }
    }
}
