#include "plant.h"

#include <string.h>

#include "chip.h"         // chip_sleep
#include "clock.h"        // clock_hand_over
#include "ebl_registry.h" // EBL_STATUS_UNKNOWN_MSG
#include "uart.h"         // uart_read
#include "watchdog.h"     // watchdog_kick

#define BENCH_BAUD 1000000u
#define ANSWER_WAIT_US 2000000u
#define TORQUE_HOLD_US 20000u

typedef struct {
    hal_inputs inputs;
    uint8_t present;
    uint8_t steps_broken;
    uint32_t granted_us; /* as last seen */
    uint32_t told_us;    /* of what has passed */
    uint32_t torque_us;  /* of the timer, when the motor was last told a torque */
    uint8_t motor_is_off;
} plant_state;

static plant_state plant;

static void ring(void)
{
    static const uint8_t bell = 1;

    (void)uart_write(UART_PLANT, &bell, sizeof bell);
}

/* What the bench is just writing is left alone: it rings again when that is done. */
static void look(void)
{
    uint32_t written = PLANT_REGISTERS->written;
    hal_inputs seen;
    uint32_t granted_us;
    int has_clock;

    if (written == 0 || written % 2 != 0) return;
    seen = *(const hal_inputs *)(uintptr_t)&PLANT_REGISTERS->inputs;
    granted_us = PLANT_REGISTERS->granted_us;
    has_clock = PLANT_REGISTERS->has_clock != 0;
    if (PLANT_REGISTERS->written != written) return;
    clock_hand_over(has_clock, granted_us - plant.granted_us);
    plant.granted_us = granted_us;
    plant.inputs = seen;
    plant.present = 1;
}

static void break_as_asked(void)
{
    uint32_t what = PLANT_REGISTERS->break_asked;

    if (what == PLANT_BREAK_NOTHING) return;
    PLANT_REGISTERS->break_asked = PLANT_BREAK_NOTHING;
    if (what == PLANT_BREAK_STEPS) plant.steps_broken = 1;
    if (what == PLANT_BREAK_INSTRUCTION) __asm volatile("udf #0");
    if (what == PLANT_BREAK_DEAF_LOOP) chip_interrupts_off();
    while (what == PLANT_BREAK_LOOP || what == PLANT_BREAK_DEAF_LOOP) {
    }
}

void plant_poll(void)
{
    uint8_t bells[16];

    if (uart_read(UART_PLANT, bells, sizeof bells) == 0) return;
    look();
    break_as_asked();
}

/* After a reset the bench is there already, and what it granted before goes on. */
void plant_open(void)
{
    uart_open(UART_PLANT, BENCH_BAUD);
    plant.granted_us = PLANT_REGISTERS->passed_us;
    plant.told_us = plant.granted_us;
    if (PLANT_REGISTERS->has_clock) clock_stop();
    look();
    while (PLANT_REGISTERS->has_clock && !plant.present) {
        watchdog_kick(); /* a bench that is late hangs nothing */
        plant_poll();
    }
}

void plant_motor_set(float motor_torque_nm)
{
    plant.torque_us = clock_timer_us();
    PLANT_REGISTERS->motor_torque_nm = plant.motor_is_off ? 0.0f : motor_torque_nm;
}

void plant_motor_off(void)
{
    plant.motor_is_off = 1;
    PLANT_REGISTERS->motor_torque_nm = 0.0f;
    PLANT_REGISTERS->motor_offs++;
}

void plant_motor_tick(void)
{
    if (clock_is_by_bench() || clock_timer_us() - plant.torque_us < TORQUE_HOLD_US) return;
    PLANT_REGISTERS->motor_torque_nm = 0.0f;
}

int plant_steps_come(void) { return !plant.steps_broken; }

void plant_inputs(hal_inputs *inputs, uint64_t now_us)
{
    if (!plant.present) return;
    *inputs = plant.inputs;
    inputs->wheel_pulse_us = now_us - plant.inputs.wheel_pulse_us;
}

void plant_step_tell(const assist_output *output, uint8_t mode)
{
    memcpy((void *)(uintptr_t)&PLANT_REGISTERS->output, output, sizeof *output);
    PLANT_REGISTERS->mode = mode;
    PLANT_REGISTERS->steps++;
    ring();
}

void plant_passed_tell(void)
{
    if (plant.told_us == plant.granted_us) return;
    plant.told_us = plant.granted_us;
    PLANT_REGISTERS->passed_us = plant.granted_us;
    ring();
}

int plant_request(uint16_t message_id, const uint8_t *request, size_t length, uint8_t *response,
                  size_t capacity, size_t *response_length)
{
    uint32_t begin_us = clock_timer_us();
    uint32_t number = PLANT_REGISTERS->requests + 1;

    *response_length = 0;
    if (!plant.present) return EBL_STATUS_UNKNOWN_MSG;
    if (length > PLANT_REQUEST_BYTES) return EBL_STATUS_LENGTH;
    memcpy((void *)(uintptr_t)PLANT_REGISTERS->request, request, length);
    PLANT_REGISTERS->request_id = message_id;
    PLANT_REGISTERS->request_length = (uint32_t)length;
    PLANT_REGISTERS->requests = number;
    ring();
    while (PLANT_REGISTERS->answers != number) {
        if (clock_timer_us() - begin_us > ANSWER_WAIT_US) return EBL_STATUS_INTERNAL;
        watchdog_kick();
        chip_sleep();
    }
    length = PLANT_REGISTERS->answer_length;
    if (PLANT_REGISTERS->answer_status == EBL_STATUS_OK && length > capacity) {
        return EBL_STATUS_NO_SPACE;
    }
    *response_length = length < capacity ? length : capacity;
    memcpy(response, (const void *)(uintptr_t)PLANT_REGISTERS->answer, *response_length);
    return (int)PLANT_REGISTERS->answer_status;
}
