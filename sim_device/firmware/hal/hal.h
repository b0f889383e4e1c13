/* The only way from the firmware to the world: time, serial line, sensors, motor, flash.
 *
 * A board fills in the functions; each gets `context` back. Nothing here blocks. Physical values
 * carry their unit in the name. What a board cannot measure it reports as NaN, never as zero.
 * Voltage and currents are means over the control period: a sample at an instant misses what comes
 * and goes within it, and its sum is not the charge. The inputs come prepared to inputs_read:
 * temperatures and currents NaN, ages and buttons 0, no mode selected; a board writes what it has
 * and leaves the rest.
 *
 * Speed is not among them: the unit makes it itself, from the wheel's pulses and its own
 * circumference and pulses a turn (control/wheel_speed.h). A board counts the pulses and takes the
 * time of the latest, with a timer's capture or in an interrupt, to microseconds on the clock of
 * now_us: a reading that stays within 0.005 km/h for five turns under power, while the chain's
 * speed changes, is a stuck sensor. One magnet is too slow at walking pace, six will do. */
#ifndef SPINDLE_HAL_H
#define SPINDLE_HAL_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    float torque_raw_counts; /* signed bridge reading; the sensor word is 16 bit */
    float sensor_temperature_degc;
    float crank_angle_deg; /* 0 <= angle < 360, 0 with the left crank up */
    float cadence_rpm;     /* negative when pedalling backwards */
    float motor_speed_rpm; /* NaN while the rotor's position is not known: no torque then */
    float motor_current_a;
    float motor_temperature_degc;
    float battery_voltage_v;
    float battery_current_a;
    float battery_soc_pct;
    uint8_t mode_selected; /* slot chosen on the handlebar; HAL_MODE_NOT_SELECTED: none yet */
    uint8_t brake;         /* 1 while a brake lever is pulled */
    uint8_t walk_button;   /* 1 while the button for walk assist is held */
    uint8_t battery_cut;   /* 1 while the battery's own management says that it opened its switch */
    uint16_t torque_age_ms;  /* since the torque reading was measured; 0: just now, or by wire */
    uint16_t speed_age_ms;   /* since the speed sensor was last known to work; 0: cannot tell;
                             * HAL_SPEED_NOT_MEASURED: known to be broken */
    uint32_t wheel_pulses;   /* since boot; wraps */
    uint64_t wheel_pulse_us; /* when the latest came, on the clock of now_us */
    float controller_temperature_degc;
} hal_inputs;

#define HAL_MODE_NOT_SELECTED 255
#define HAL_SPEED_NOT_MEASURED 65535

typedef struct {
    void *context;

    uint64_t (*now_us)(void *context); /* since boot, monotonic */

    /* Serial line. read: bytes copied, 0 when there are none. write: bytes taken; a full line takes
     * fewer. writable: bytes that write would take now. */
    size_t (*serial_read)(void *context, uint8_t *bytes, size_t capacity);
    size_t (*serial_write)(void *context, const uint8_t *bytes, size_t length);
    size_t (*serial_writable)(void *context);
    uint32_t serial_baud; /* bits per second of the line now; 0: nothing limits it, or not known */

    /* Other rates, as bits of ebl_baud_rates. set: 0, and serial_baud is the new rate at once;
     * negative where the UART cannot. drained: 1 when all that was written has left the line. NULL
     * and 0 where the line has one rate. */
    uint16_t serial_bauds;
    int (*serial_baud_set)(void *context, uint32_t baud);
    int (*serial_drained)(void *context);

    void (*inputs_read)(void *context, hal_inputs *inputs);
    void (*motor_torque_set)(void *context, float motor_torque_nm);

    /* Safe stop. The stage lets go by itself where no new torque comes for two control periods; the
     * watchdog, which the board starts and which takes longer than STEP_DEADLINE_US of
     * faults/step_watch.h, does motor_off where no kick comes in its time. motor_off:
     * by hardware, at once, from any context, an interrupt's too; nothing but the next start of the
     * unit ends it, and the board makes that start. `cause`, and reset_cause of the start: an
     * ebl_reset_cause. */
    void (*watchdog_kick)(void *context);
    void (*motor_off)(void *context, uint8_t cause);
    uint8_t reset_cause;

    /* Flash for configuration: erase sets a block to 0xFF, program can only clear bits.
     * 0 on success, negative on failure. */
    size_t flash_block_size;
    size_t flash_size;
    int (*flash_read)(void *context, size_t address, uint8_t *bytes, size_t length);
    int (*flash_erase)(void *context, size_t address);
    int (*flash_program)(void *context, size_t address, const uint8_t *bytes, size_t length);

    /* Flash for ride logs; log_size 0 where there is none. Blocks are whole multiples of 512 bytes.
     * Erasing and programming only begin here: until log_busy is 0 again the bytes given must stay
     * and log_read fails. At most 512 bytes within one page are programmed at once. */
    void *log_context;
    size_t log_block_size;
    size_t log_size;
    int (*log_busy)(void *log_context);
    int (*log_read)(void *log_context, size_t address, uint8_t *bytes, size_t length);
    int (*log_erase)(void *log_context, size_t address);
    int (*log_program)(void *log_context, size_t address, const uint8_t *bytes, size_t length);

    /* Requests above service 0x70 belong to the board (a simulated unit's controls). Returns a
     * status and fills the response; NULL where the board has none. */
    int (*board_request)(void *context, uint16_t message_id, const uint8_t *request, size_t length,
                         uint8_t *response, size_t capacity, size_t *response_length);

    const uint8_t *uid; /* 12 bytes */
    uint8_t device_class;
    uint16_t hardware_revision;
    uint32_t boot_id;
} hal;

#endif
