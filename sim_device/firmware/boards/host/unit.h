/* A simulated drive unit: the firmware and the physics on one virtual clock.
 *
 * Time passes only in unit_advance_us: physics every millisecond, the control law every ten. The
 * serial line and the flash are memory, so the unit can live in a test, a scenario or a process. */
#ifndef SPINDLE_UNIT_H
#define SPINDLE_UNIT_H

#include <stddef.h>
#include <stdint.h>

#include "assist_types.h" // assist_output
#include "hal.h"          // hal_inputs
#include "physics.h"      // physics_config

#define UNIT_UID_LENGTH 12
#define UNIT_UNLOCK_KEY_LENGTH 32
#define UNIT_FLASH_BLOCK_SIZE 1024
#define UNIT_FLASH_SIZE 8192 /* the data flash of the RX24T in eight blocks */
#define UNIT_LOG_BLOCK_SIZE 4096
#define UNIT_LOG_SIZE 4194304 /* a serial flash beside the chip: two hours of rides */
#define UNIT_MODE_NOT_SELECTED 255
#define UNIT_TORQUE_HOLD_US 20000 /* the motor's stage lets go where no new torque comes */
#define UNIT_WATCHDOG_US 200000   /* without a kick: motor off, and the firmware starts anew */

/* Answers board requests (SIM_GET, SIM_SET). Same meaning as hal.board_request. */
typedef int (*unit_request)(void *context, uint16_t message_id, const uint8_t *request,
                            size_t length, uint8_t *response, size_t capacity,
                            size_t *response_length);

typedef struct {
    physics_config physics;
    double speed_kmh; /* the bike starts rolling at this speed */
    uint64_t seed;
    uint8_t uid[UNIT_UID_LENGTH];
    uint32_t boot_id;
    const uint8_t *flash;      /* UNIT_FLASH_SIZE bytes, or NULL for an erased one */
    size_t log_size;           /* of the flash for ride logs, whole blocks; 0: UNIT_LOG_SIZE */
    const uint8_t *log;        /* so many bytes, or NULL for an erased one */
    const uint8_t *unlock_key; /* the maker's, 32 bytes, or NULL for what the flash has */
    uint8_t market_number;     /* the factory's, for a flash that never had a configuration */
    uint8_t not_provisioned;   /* 1: the factory was not there */
    uint32_t line_baud; /* the serial line's rate at boot; 0: bytes take no time and have no rate */
    unit_request request; /* NULL: the unit knows no board requests */
    void *request_context;
    uint8_t bike_alone; /* 1: the firmware runs on another board, and only its bike is here */
} unit_setup;

/* What an observer beside the bike sees, and what the law last decided. */
typedef struct {
    double t_s;
    double speed_kmh;
    double wheel_speed_kmh;
    double distance_m;
    double height_m;
    double cadence_rpm;
    double crank_angle_deg;
    double spindle_torque_nm;
    double rider_torque_nm;   /* as the law has it; NaN if it was refused */
    double torque_raw_counts; /* as the receiver gives it out */
    double torque_age_ms;
    double sensor_temperature_degc; /* of the last word */
    double motor_demand_nm;
    double motor_torque_nm;
    double motor_speed_rpm;
    double motor_current_a;
    double motor_temperature_degc; /* winding */
    double motor_housing_degc;
    double controller_temperature_degc;
    double battery_voltage_v;
    double battery_current_a;
    double battery_soc_pct;
    double assist_ratio;
    double torque_rate;
    double fuzzy_gain; /* NaN where the mode does not use it */
    double rider_work_j;
    double motor_electric_j;
    double losses_j;
    double rider_reserve_j;          /* W' left, of a rider that tires */
    double energy_balance_error_pct; /* NaN before any work was done */
    int assist_mode;
    int limit_flags;
    uint32_t fault_flags;
    int crank_engaged;
    int motor_engaged;
    int slipping;
    int battery_cut;
    int energy_consistent;   /* 0: a printed equation that makes energy (I-9, I-11) */
    uint32_t link_exchanges; /* with the rotor, 500 a second */
    uint32_t words_damaged;  /* in truth; the other three are what the receiver noticed */
    uint32_t words_good;
    uint32_t words_bad;
    uint32_t words_lost;
    double cog_teeth; /* of the cog the chain is on; the unit does not know */
} unit_observation;

typedef struct unit unit;

/* NULL if there is no memory, or if the flash has another unlock key. */
unit *unit_create(const unit_setup *setup);
void unit_destroy(unit *self);

/* Lets time pass; what is left below a millisecond counts towards the next call. */
void unit_advance_us(unit *self, uint64_t duration_us);

/* The same, but not beyond the millisecond in which the bike comes to `distance_m` of its way. How
 * long that took. */
uint64_t unit_advance_to_m(unit *self, uint64_t duration_us, double distance_m);

/* Lets the unit answer what it has received while its clock stands. */
void unit_poll(unit *self);

/* Bytes from the host to the unit, and back. Return how many were taken. */
size_t unit_receive(unit *self, const uint8_t *bytes, size_t length);
size_t unit_transmit(unit *self, uint8_t *bytes, size_t capacity);

/* The far end of a line that has a rate sends and listens at this one from now on. */
void unit_host_baud(unit *self, uint32_t baud);

/* The unit's own rate now; 0: its line has none. */
uint32_t unit_line_baud(const unit *self);

void unit_observe(const unit *self, unit_observation *seen);

/* For a bike alone: what the sensors of its unit see now, and what that unit last decided. It has a
 * clock of its own: wheel_pulse_us is how long ago the latest pulse came. */
void unit_inputs(unit *self, hal_inputs *inputs);
void unit_drive(unit *self, const assist_output *output, uint8_t mode);

/* The bike and what happens to it, to be changed between two advances. A change of masses needs
 * unit_begin_ledger, because energy would appear from nowhere. */
physics_config *unit_bike(unit *self);
physics_command *unit_stimulus(unit *self);
void unit_begin_ledger(unit *self);

/* Puts the bike on a workbench, its wheel held, and hangs a mass there; NULL takes it off again. */
void unit_hang_mass(unit *self, const hung_mass *hung);

/* Puts the bike on the road at this speed, its energy ledger and noise started afresh. */
void unit_place(unit *self, double speed_kmh, uint64_t seed);
/* A fresh battery, rider and sensor on the bike as it rolls; its configuration may have changed. */
void unit_renew(unit *self);
void unit_seed_noise(unit *self, uint64_t seed);

/* Presses the handlebar's mode button; UNIT_MODE_NOT_SELECTED leaves the choice to the unit. */
void unit_select_mode(unit *self, uint8_t mode);

/* The handlebar's button for walk assist. */
void unit_hold_walk_button(unit *self, int held);

/* Control steps, polls, or both (3) come no more, until the watchdog starts the firmware anew. */
#define UNIT_HANG_STEPS 1
#define UNIT_HANG_POLLS 2
void unit_hang(unit *self, int hung);

const uint8_t *unit_flash(const unit *self);

/* The flash for ride logs, and how often it was erased or programmed since the unit was made. */
const uint8_t *unit_log(const unit *self);
size_t unit_log_size(const unit *self);
uint32_t unit_log_changes(const unit *self);

/* Where all lies that changed in it since the last call, as an address and a length. */
size_t unit_log_changed(unit *self, size_t *address);

/* Brown-out: the supply fails after `bytes` more bytes were erased or programmed, and with it the
 * whole unit; what the flash holds then is for the next life. 0 takes the battery out now. */
void unit_flash_cut_after(unit *self, uint32_t bytes);
void unit_log_cut_after(unit *self, uint32_t bytes); /* of the flash for ride logs */
int unit_is_powered(const unit *self);

#endif
