#include "unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"           // app_poll
#include "byte_queue.h"    // byte_queue_put
#include "ebl_registry.h"  // EBL_DEVICE_CLASS_MID_DRIVE_SIMULATED
#include "ebl_values.h"    // ebl_config_violations
#include "faults/inputs.h" // inputs_prepare
#include "hal.h"           // hal
#include "log_flash.h"     // log_flash_open
#include "unit_senses.h"   // senses_read
#include "uart_line.h"     // uart_line_advance

#define PHYSICS_PERIOD_US 1000u
#define CONTROL_PERIOD_US 10000u
#define HARDWARE_REVISION 1u

#define PI 3.14159265358979323846
#define DEG_PER_RAD (180.0 / PI)
#define RPM_PER_RAD_S (30.0 / 3.14159265358979323846)
#define KMH_PER_MS 3.6
#define FLASH_NEVER_CUT UINT32_MAX
#define UNIT_BAUD_RATES                                                                            \
    (EBL_BAUD_RATES_BAUD_115200 | EBL_BAUD_RATES_BAUD_230400 | EBL_BAUD_RATES_BAUD_460800 |        \
     EBL_BAUD_RATES_BAUD_921600 | EBL_BAUD_RATES_BAUD_1000000)

struct unit {
    app app;
    hal hal;
    physics_config bike;
    physics_state state;
    physics_command stimulus;
    uint64_t now_us;
    uint64_t target_us;
    rotor_receiver receiver;
    electric_meter meter;
    uint8_t mode_selected;
    uint8_t bike_alone;
    uint8_t walk_button;
    byte_queue from_host;
    byte_queue to_host;
    uart_line up; /* towards the host; both only where the line has a rate */
    uart_line down;
    uint32_t host_baud;
    uint8_t flash[UNIT_FLASH_SIZE];
    log_flash log;
    uint32_t flash_bytes_left; /* until the supply fails; FLASH_NEVER_CUT: it does not */
    uint8_t uid[UNIT_UID_LENGTH];
    unit_request request;
    void *request_context;
    uint64_t torque_us; /* when the motor was last told a torque, */
    uint64_t kicked_us; /* and the watchdog was last kicked */
    uint32_t boot_baud;
    uint8_t hung; /* bits of unit_hang */
    uint8_t motor_is_off;
};

static uint64_t board_now_us(void *context) { return ((const unit *)context)->now_us; }

static size_t board_serial_read(void *context, uint8_t *bytes, size_t capacity)
{
    return byte_queue_take(&((unit *)context)->from_host, bytes, capacity);
}

static size_t board_serial_write(void *context, const uint8_t *bytes, size_t length)
{
    unit *self = context;
    if (!unit_is_powered(self)) return 0;
    if (self->host_baud != 0) return uart_line_send(&self->up, bytes, length);
    return byte_queue_put(&self->to_host, bytes, length);
}

static size_t board_serial_writable(void *context)
{
    const unit *self = context;
    if (self->host_baud != 0) return uart_line_room(&self->up);
    return byte_queue_free(&self->to_host);
}

static int board_serial_baud_set(void *context, uint32_t baud)
{
    ((unit *)context)->hal.serial_baud = baud;
    return 0;
}

static int board_serial_drained(void *context)
{
    const unit *self = context;
    return uart_line_is_drained(&self->up, self->now_us);
}

static void board_inputs_read(void *context, hal_inputs *inputs)
{
    const unit *self = context;
    senses_read(&self->state, &self->stimulus, &self->receiver, &self->meter, self->now_us, inputs);
    inputs->mode_selected = self->mode_selected;
    inputs->walk_button = self->walk_button;
}

void unit_inputs(unit *self, hal_inputs *inputs)
{
    inputs_prepare(inputs);
    board_inputs_read(self, inputs);
    inputs->wheel_pulse_us = self->now_us - inputs->wheel_pulse_us;
}

void unit_drive(unit *self, const assist_output *output, uint8_t mode)
{
    self->stimulus.motor_torque_nm = (double)output->motor_torque_nm;
    self->app.output = *output;
    self->app.config.in_force.assist_mode_at_start = mode;
}

static void board_motor_torque_set(void *context, float motor_torque_nm)
{
    unit *self = context;
    self->torque_us = self->now_us;
    self->stimulus.motor_torque_nm = self->motor_is_off ? 0.0 : (double)motor_torque_nm;
}

static void board_watchdog_kick(void *context)
{
    unit *self = context;
    self->kicked_us = self->now_us;
}

static void board_motor_off(void *context, uint8_t cause)
{
    unit *self = context;
    if (!self->motor_is_off) self->hal.reset_cause = cause;
    self->motor_is_off = 1;
    self->stimulus.motor_torque_nm = 0.0;
}

/* The hardware beside the processor: a stage that lets go, and a watchdog that starts it anew. */
static void hardware_advance(unit *self)
{
    if (self->now_us >= self->torque_us + UNIT_TORQUE_HOLD_US) self->stimulus.motor_torque_nm = 0.0;
    if (!unit_is_powered(self) || self->now_us < self->kicked_us + UNIT_WATCHDOG_US) return;
    board_motor_off(self, EBL_RESET_CAUSE_WATCHDOG);
    self->kicked_us = self->now_us;
    self->motor_is_off = 0;
    self->hung = 0;
    self->hal.boot_id = self->hal.boot_id == UINT32_MAX ? 1 : self->hal.boot_id + 1;
    self->hal.serial_baud = self->boot_baud;
    app_init(&self->app, &self->hal);
}

/* Wears one byte. False once the supply has failed. */
static int flash_wear(unit *self)
{
    if (!unit_is_powered(self)) return 0;
    if (self->flash_bytes_left != FLASH_NEVER_CUT) self->flash_bytes_left--;
    /* One supply: what was being written to the other flash ends as well. */
    if (self->flash_bytes_left == 0) self->log.steps_left = 0;
    return 1;
}

static int flash_holds(size_t address, size_t length)
{
    return address <= UNIT_FLASH_SIZE && length <= UNIT_FLASH_SIZE - address;
}

static int board_flash_read(void *context, size_t address, uint8_t *bytes, size_t length)
{
    if (!flash_holds(address, length)) {
        return -1;
    }
    memcpy(bytes, ((const unit *)context)->flash + address, length);
    return 0;
}

static int board_flash_erase(void *context, size_t address)
{
    if (address % UNIT_FLASH_BLOCK_SIZE != 0 || !flash_holds(address, UNIT_FLASH_BLOCK_SIZE)) {
        return -1;
    }
    unit *self = context;
    for (size_t k = 0; k < UNIT_FLASH_BLOCK_SIZE; k++) {
        if (!flash_wear(self)) return -1;
        self->flash[address + k] = 0xFF;
    }
    return 0;
}

static int board_flash_program(void *context, size_t address, const uint8_t *bytes, size_t length)
{
    if (!flash_holds(address, length)) {
        return -1;
    }
    unit *self = context;
    uint8_t *flash = self->flash + address;
    for (size_t k = 0; k < length; k++) {
        if (!flash_wear(self)) return -1;
        flash[k] = (uint8_t)(flash[k] & bytes[k]);
    }
    return 0;
}

static int board_request(void *context, uint16_t message_id, const uint8_t *request, size_t length,
                         uint8_t *response, size_t capacity, size_t *response_length)
{
    const unit *self = context;
    return self->request(self->request_context, message_id, request, length, response, capacity,
                         response_length);
}

static void connect_board(unit *self, const unit_setup *setup)
{
    const hal board = {
        .context = self,
        .now_us = board_now_us,
        .serial_read = board_serial_read,
        .serial_write = board_serial_write,
        .serial_writable = board_serial_writable,
        .inputs_read = board_inputs_read,
        .motor_torque_set = board_motor_torque_set,
        .watchdog_kick = board_watchdog_kick,
        .motor_off = board_motor_off,
        .flash_block_size = UNIT_FLASH_BLOCK_SIZE,
        .flash_size = UNIT_FLASH_SIZE,
        .flash_read = board_flash_read,
        .flash_erase = board_flash_erase,
        .flash_program = board_flash_program,
        .board_request = setup->request != NULL ? board_request : NULL,
        .uid = self->uid,
        .device_class = EBL_DEVICE_CLASS_MID_DRIVE_SIMULATED,
        .hardware_revision = HARDWARE_REVISION,
        .boot_id = setup->boot_id,
    };
    self->hal = board;
    if (setup->line_baud != 0) {
        self->hal.serial_baud = setup->line_baud;
        self->hal.serial_bauds = UNIT_BAUD_RATES;
        self->hal.serial_baud_set = board_serial_baud_set;
        self->hal.serial_drained = board_serial_drained;
        self->host_baud = setup->line_baud;
        self->boot_baud = setup->line_baud;
        uart_line_init(&self->up, UART_LINE_BYTES);
        uart_line_init(&self->down, BYTE_QUEUE_CAPACITY);
    }
    log_flash_connect(&self->log, &self->hal, &self->now_us);
}

/* A unit leaves the factory for its bike. A wheel that no unit can be told of is left as it is. */
static void measure_wheel(const physics_config *bike, ebl_config *factory)
{
    const double circumference_m = 2.0 * PI * bike->road.wheel_radius_m;
    ebl_config measured = *factory;
    measured.wheel_circumference_m = (float)(floor(circumference_m * 1e6 + 0.5) * 1e-6);
    measured.wheel_circumference_m_factory = measured.wheel_circumference_m;
    measured.wheel_pulses_per_turn = (uint8_t)bike->wheel.pulses_per_turn;
    if (ebl_config_violations(&measured, NULL, 0) == 0) *factory = measured;
}

unit *unit_create(const unit_setup *setup)
{
    unit *self = calloc(1, sizeof *self);
    size_t log_size;

    if (self == NULL) {
        return NULL;
    }
    memset(self->flash, 0xFF, sizeof self->flash);
    if (setup->flash != NULL) {
        memcpy(self->flash, setup->flash, sizeof self->flash);
    }
    self->flash_bytes_left = FLASH_NEVER_CUT;
    memcpy(self->uid, setup->uid, sizeof self->uid);
    self->request = setup->request;
    self->request_context = setup->request_context;
    self->bike_alone = setup->bike_alone;
    self->bike = setup->physics;
    self->mode_selected = UNIT_MODE_NOT_SELECTED;
    unit_place(self, setup->speed_kmh, setup->seed);
    log_size = setup->log_size != 0 ? setup->log_size : UNIT_LOG_SIZE;
    if (log_flash_open(&self->log, UNIT_LOG_BLOCK_SIZE, log_size, setup->log) < 0) {
        free(self);
        return NULL;
    }
    connect_board(self, setup);
    ebl_config factory;
    app_factory_config(&factory, setup->market_number);
    measure_wheel(&self->bike, &factory);
    if ((!setup->not_provisioned && app_provision(&self->hal, &factory) < 0) ||
        (setup->unlock_key != NULL &&
         app_provision_unlock_key(&self->hal, setup->unlock_key) < 0)) {
        unit_destroy(self);
        return NULL;
    }
    app_init(&self->app, &self->hal);
    return self;
}

void unit_destroy(unit *self)
{
    if (self == NULL) {
        return;
    }
    log_flash_close(&self->log);
    free(self);
}

/* A millisecond of the line. What the host sends is there when the unit looks; what the unit sent
 * has left when the host looks. */
static void line_advance(unit *self)
{
    const uint64_t end_us = self->now_us + PHYSICS_PERIOD_US;
    if (self->host_baud == 0) return;
    uart_line_advance(&self->down, self->now_us, end_us, self->host_baud, self->hal.serial_baud,
                      &self->from_host);
    uart_line_advance(&self->up, self->now_us, end_us, self->hal.serial_baud, self->host_baud,
                      &self->to_host);
}

void unit_advance_us(unit *self, uint64_t duration_us)
{
    (void)unit_advance_to_m(self, duration_us, HUGE_VAL);
}

uint64_t unit_advance_to_m(unit *self, uint64_t duration_us, double distance_m)
{
    const uint64_t from_us = self->target_us;
    self->target_us += duration_us;
    while (self->now_us + PHYSICS_PERIOD_US <= self->target_us) {
        if (self->now_us % CONTROL_PERIOD_US == 0) senses_meter_end_step(&self->meter);
        if (unit_is_powered(self) && !self->bike_alone) {
            if (self->now_us % CONTROL_PERIOD_US == 0 && !(self->hung & UNIT_HANG_STEPS)) {
                app_control_step(&self->app);
            }
            if (!(self->hung & UNIT_HANG_POLLS)) app_poll(&self->app);
        }
        if (!self->bike_alone) hardware_advance(self);
        line_advance(self);
        physics_step(&self->bike, &self->state, &self->stimulus, PHYSICS_PERIOD_US * 1e-6);
        senses_rotor_exchange(&self->state, &self->receiver);
        senses_meter_convert(&self->meter, &self->state);
        self->now_us += PHYSICS_PERIOD_US;
        if (self->state.distance_m >= distance_m) self->target_us = self->now_us;
    }
    return self->target_us - from_us;
}

void unit_poll(unit *self)
{
    if (unit_is_powered(self)) app_poll(&self->app);
}

size_t unit_receive(unit *self, const uint8_t *bytes, size_t length)
{
    if (self->host_baud != 0) return uart_line_send(&self->down, bytes, length);
    return byte_queue_put(&self->from_host, bytes, length);
}

void unit_host_baud(unit *self, uint32_t baud)
{
    if (self->host_baud != 0 && baud != 0) self->host_baud = baud;
}

uint32_t unit_line_baud(const unit *self) { return self->hal.serial_baud; }

size_t unit_transmit(unit *self, uint8_t *bytes, size_t capacity)
{
    return byte_queue_take(&self->to_host, bytes, capacity);
}

void unit_observe(const unit *self, unit_observation *seen)
{
    const physics_state *state = &self->state;
    const assist_output *law = app_output(&self->app);
    const unit_observation now = {
        .t_s = (double)self->now_us * 1e-6,
        .speed_kmh = state->speed_ms * KMH_PER_MS,
        .wheel_speed_kmh = state->wheel_speed_ms * KMH_PER_MS,
        .distance_m = state->distance_m,
        .height_m = state->height_m,
        .cadence_rpm = state->crank_speed_rad_s * RPM_PER_RAD_S,
        .crank_angle_deg = state->crank_angle_rad * DEG_PER_RAD,
        .spindle_torque_nm = state->spindle_torque_nm,
        .rider_torque_nm = (double)law->rider_torque_nm,
        .torque_raw_counts = (double)self->receiver.torque_raw_counts,
        .torque_age_ms = self->receiver.age_ms,
        .sensor_temperature_degc = self->receiver.temperature_degc,
        .motor_demand_nm = self->stimulus.motor_torque_nm,
        .motor_torque_nm = state->motor_shaft_nm,
        .motor_speed_rpm = state->motor_speed_rad_s * RPM_PER_RAD_S,
        .motor_current_a = state->motor_current_a,
        .motor_temperature_degc = state->heat.winding_degc,
        .motor_housing_degc = state->heat.housing_degc,
        .controller_temperature_degc = state->heat.bridge_degc,
        .battery_voltage_v = state->battery.voltage_v,
        .battery_current_a = state->battery.current_a,
        .battery_soc_pct = state->battery.soc_pct,
        .assist_ratio = (double)law->assist_ratio,
        .torque_rate = (double)law->torque_rate,
        .fuzzy_gain = (double)law->fuzzy_gain,
        .rider_work_j = state->ledger.rider_work_j,
        .motor_electric_j = state->ledger.motor_electric_j,
        .losses_j = ledger_losses_j(&state->ledger),
        .rider_reserve_j = state->rider.reserve_j,
        .energy_balance_error_pct = physics_energy_balance_error_pct(&self->bike, state),
        .assist_mode = self->mode_selected < ASSIST_MODE_SLOTS
                           ? self->mode_selected
                           : self->app.config.in_force.assist_mode_at_start,
        .limit_flags = law->limit_flags,
        .fault_flags = self->app.faults.active,
        .crank_engaged = state->crank_engaged,
        .motor_engaged = state->motor_engaged,
        .slipping = state->slipping,
        .battery_cut = state->battery.cut,
        .energy_consistent = physics_is_energy_consistent(&self->bike),
        .link_exchanges = state->link.exchanges,
        .words_damaged = state->link.words_damaged,
        .words_good = self->receiver.words_good,
        .words_bad = self->receiver.words_bad,
        .words_lost = self->receiver.words_lost,
        .cog_teeth = physics_cog_teeth(&self->bike, state),
    };
    *seen = now;
}

physics_config *unit_bike(unit *self) { return &self->bike; }

physics_command *unit_stimulus(unit *self) { return &self->stimulus; }

void unit_begin_ledger(unit *self) { physics_begin_ledger(&self->bike, &self->state); }

void unit_hang_mass(unit *self, const hung_mass *hung)
{
    self->stimulus.road.held = hung != NULL;
    if (hung == NULL) return;
    self->stimulus.hung = *hung;
    physics_hang(&self->bike, &self->state, hung);
}

void unit_place(unit *self, double speed_kmh, uint64_t seed)
{
    const uint32_t pulses = self->state.wheel.pulses; /* the unit's counter goes on */
    physics_reset(&self->bike, &self->state, speed_kmh, seed);
    self->state.wheel.pulses = pulses;
    rotor_receiver_init(&self->receiver, torque_sensor_temperature_degc(&self->state.sensor));
    senses_meter_reset(&self->meter, &self->state);
}

void unit_renew(unit *self) { physics_renew(&self->bike, &self->state); }

void unit_seed_noise(unit *self, uint64_t seed) { physics_seed(&self->state, seed); }

void unit_select_mode(unit *self, uint8_t mode) { self->mode_selected = mode; }

void unit_hold_walk_button(unit *self, int held) { self->walk_button = held ? 1 : 0; }

void unit_hang(unit *self, int hung) { self->hung = (uint8_t)hung; }

void unit_flash_cut_after(unit *self, uint32_t bytes) { self->flash_bytes_left = bytes; }

void unit_log_cut_after(unit *self, uint32_t bytes) { self->log.steps_left = bytes; }

int unit_is_powered(const unit *self)
{
    return self->flash_bytes_left != 0 && self->log.steps_left != 0;
}

const uint8_t *unit_flash(const unit *self) { return self->flash; }

const uint8_t *unit_log(const unit *self) { return self->log.bytes; }

size_t unit_log_size(const unit *self) { return self->log.size; }

uint32_t unit_log_changes(const unit *self) { return self->log.changes; }

size_t unit_log_changed(unit *self, size_t *address)
{
    return log_flash_changed(&self->log, address);
}
