/* The board's sensors and motor: registers in memory that a test bench reads and writes, and a
 * serial line that rings.
 *
 * QEMU keeps the memory in a file that the bench maps. Once a control step the board writes what
 * its motor should do and rings; the bench writes what the sensors see ten milliseconds later and
 * rings back. Until then they show what they last did. A ring is one byte of any value. */
#ifndef SPINDLE_MPS2_PLANT_H
#define SPINDLE_MPS2_PLANT_H

#include <stddef.h>
#include <stdint.h>

#include "assist_types.h" // assist_output
#include "hal.h"          // hal_inputs

#define PLANT_REQUEST_BYTES 1024

/* Counts wrap and begin at 0: the bench clears all of it before power on. What the bench writes
 * comes first. */
typedef struct {
    uint32_t written;    /* odd while the bench writes the inputs */
    uint32_t has_clock;  /* 1: the bench has the board's clock in hand */
    uint32_t granted_us; /* ever */
    uint32_t answers;
    uint32_t answer_status;
    uint32_t answer_length;
    uint8_t answer[PLANT_REQUEST_BYTES];

    uint32_t steps;     /* control steps ever */
    uint32_t passed_us; /* of what was granted */
    uint32_t mode;
    uint32_t requests;
    uint32_t request_id;
    uint32_t request_length;
    uint8_t request[PLANT_REQUEST_BYTES];

    hal_inputs inputs;
    uint8_t spare[256 - sizeof(hal_inputs)];
    assist_output output;
    float motor_torque_nm; /* what the stage gives */
    uint32_t motor_offs;   /* how often it was switched off by hardware, ever */
    uint32_t break_asked;  /* by the bench: a plant_break, done once and set back */
} plant_registers;

/* What a test bench may break: the loop hangs, also with interrupts off; an instruction that does
 * not exist; control steps come no more. */
typedef enum {
    PLANT_BREAK_NOTHING = 0,
    PLANT_BREAK_LOOP = 1,
    PLANT_BREAK_DEAF_LOOP = 2,
    PLANT_BREAK_INSTRUCTION = 3,
    PLANT_BREAK_STEPS = 4
} plant_break;

#define PLANT_REGISTERS ((volatile plant_registers *)0x21010000u)

/* Waits for a bench that has the clock in hand before power on: not a microsecond passes without
 * it. */
void plant_open(void);

/* Reads what the bench has written. */
void plant_poll(void);

/* Leaves the inputs as they are while no bench is there. The bench tells how long ago the latest
 * pulse of the wheel came, because its clock is not the board's. */
void plant_inputs(hal_inputs *inputs, uint64_t now_us);

/* Tells the bench of a control step, and of granted time that has passed. */
void plant_step_tell(const assist_output *output, uint8_t mode);
void plant_passed_tell(void);

/* The motor's stage. off: for good, from any context. tick: it lets go where no new torque came for
 * two control periods; from the interrupt that comes every 2 ms. */
void plant_motor_set(float motor_torque_nm);
void plant_motor_off(void);
void plant_motor_tick(void);

/* 1 while control steps come, 0 after PLANT_BREAK_STEPS. The other breaks do not come back. */
int plant_steps_come(void);

/* As hal.board_request. Waits for the bench, which no product does. A bench that is not there is
 * UNKNOWN_MSG; one that is silent for two seconds INTERNAL. */
int plant_request(uint16_t message_id, const uint8_t *request, size_t length, uint8_t *response,
                  size_t capacity, size_t *response_length);

#endif
