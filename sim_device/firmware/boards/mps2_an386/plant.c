#include "plant.h"

#include <string.h>

#include "chip.h"         // chip_sleep
#include "clock.h"        // clock_hand_over
#include "ebl_registry.h" // EBL_STATUS_UNKNOWN_MSG
#include "uart.h"         // uart_read

#define BENCH_BAUD 1000000u
#define ANSWER_WAIT_US 2000000u

typedef struct {
    hal_inputs inputs;
    uint8_t present;
    uint32_t granted_us; /* as last seen */
    uint32_t told_us;    /* of what has passed */
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

void plant_poll(void)
{
    uint8_t bells[16];

    if (uart_read(UART_PLANT, bells, sizeof bells) > 0) look();
}

void plant_open(void)
{
    uart_open(UART_PLANT, BENCH_BAUD);
    if (!PLANT_REGISTERS->has_clock) return;
    clock_stop();
    while (!plant.present) plant_poll();
}

void plant_inputs(hal_inputs *inputs)
{
    if (plant.present) *inputs = plant.inputs;
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
