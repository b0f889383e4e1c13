#include "app.h"

#include <string.h>

#include "float32.h"           // float32_max, float32_min, float32_missing
#include "market.h"            // market_profile_of
#include "private/report.h"    // report_faults_cleared, report_faults_set
#include "private/unit.h"      // app, config_sensor_as_drawn
#include "requests/dispatch.h" // dispatch_frame
#include "requests/services.h" // requests_log_poll

#define RECEIVE_BLOCK_BYTES 64

/* Bytes served in one poll: at 1 Mbaud the line brings 100 in a millisecond, and a flood must not
 * keep the unit from its other work. */
#define RECEIVE_BLOCKS_MAX 32

/* A fault of the start itself, which no control step sees. */
static void fault_at_start(app *unit, uint32_t flag)
{
    uint64_t now_us = unit_now_us(unit);

    if (!faults_latch(&unit->faults, flag)) return;
    faults_freeze(&unit->faults, flag, now_us, unit->telemetry.row);
    event_faults_set(&unit->events, &unit->link, now_us, flag);
}

/* Tells what the boot found in flash that is not as it was written. */
static void config_tell(app *unit)
{
    uint64_t now_us = unit_now_us(unit);
    const config_tally *tally = &unit->config.store.tally;
    uint32_t fault =
        unit->config.store.is_provisioned ? EBL_FAULT_CONFIG_DEFAULTED : EBL_FAULT_NOT_PROVISIONED;

    if (tally->added != 0 || tally->dropped != 0 || tally->clamped != 0) {
        event_config_converted(&unit->events, &unit->link, now_us, &unit->config.store);
    }
    if (unit->config.store.lost == 0) return;
    event_config(&unit->events, &unit->link, now_us, EBL_EVENT_CONFIG_DEFAULTED,
                 unit->config.store.generation, unit->config.store.crc32);
    fault_at_start(unit, fault);
    faults_hold(&unit->faults, fault);
}

/* EN 15194 4.2.13: a unit that stopped itself while it drove does not drive on by itself. */
static int stopped_itself(uint8_t reset_cause)
{
    return reset_cause == EBL_RESET_CAUSE_WATCHDOG ||
           reset_cause == EBL_RESET_CAUSE_FAULT_HANDLER || reset_cause == EBL_RESET_CAUSE_DEADLINE;
}

/* Bytes of flash that slots and counters take, from its start. */
static size_t flash_before_unlock(const hal *board)
{
    return config_store_flash_bytes(board) + COUNTERS_BLOCKS * board->flash_block_size;
}

void app_init(app *unit, const hal *board)
{
    memset(unit, 0, sizeof *unit);
    unit->board = board;
    unit->tx_mtu = EBL_MTU_BEFORE_HELLO;
    unit->output.fuzzy_gain = float32_missing();
    road_speed_init(&unit->speed);
    link_init(&unit->link);
    baud_rate_init(&unit->baud_rate, board);
    telemetry_init(&unit->telemetry);
    config_store_boot(&unit->config.store, board);
    trial_boot(&unit->config.trial, &unit->config.store);
    counters_boot(&unit->counters, board, config_store_flash_bytes(board));
    unlock_boot(&unit->config.unlock, board, flash_before_unlock(board));
    ride_log_init(&unit->ride_log, board);
    unit->link.bulk = requests_log_bulk;
    unit->link.bulk_context = unit;
    step_watch_init(&unit->watch, board->now_us(board->context));
    event_boot(&unit->events, &unit->link, board->now_us(board->context), board);
    if (unit->config.store.returned_generation != 0) {
        config_rolled_back(&unit->config, &unit->events, &unit->link, board);
    } else {
        config_apply(&unit->config);
    }
    config_tell(unit);
    if (stopped_itself(board->reset_cause)) fault_at_start(unit, EBL_FAULT_SAFE_STOP);
}

void app_factory_config(ebl_config *config, uint8_t market_number)
{
    float cutoff_kmh = market_profile_of(market_number)->cutoff_kmh;

    ebl_config_default(config);
    config->market = market_number;
    config->assist_cutoff_kmh = float32_min(config->assist_cutoff_kmh, cutoff_kmh);
    config->assist_cutoff_extra_kmh = cutoff_kmh - config->assist_cutoff_kmh;
    config_sensor_as_drawn(config);
}

int app_provision(const hal *board, const ebl_config *config)
{
    uint8_t image[EBL_IMAGE_LENGTH];

    ebl_config_pack(config, image);
    return config_store_provision(board, image);
}

int app_provision_unlock_key(const hal *board, const uint8_t *key)
{
    return unlock_store_provision(board, flash_before_unlock(board), key);
}

static void receive(app *unit)
{
    uint8_t block[RECEIVE_BLOCK_BYTES];

    for (int i = 0; i < RECEIVE_BLOCKS_MAX; i++) {
        size_t length = unit->board->serial_read(unit->board->context, block, sizeof block);
        size_t at = 0;

        if (length == 0) return;
        while (at < length) {
            const uint8_t *frame = NULL;
            size_t frame_length = 0;

            at += ebl_decoder_feed(&unit->link.decoder, block + at, length - at, &frame,
                                   &frame_length);
            if (frame != NULL) dispatch_frame(unit, frame, frame_length);
        }
    }
}

/* A rate that was given back leaves answers behind that promised it. A host that was not heard for
 * seconds has no streams, and at the first rate they might not fit. */
static void baud_rate_serve(app *unit, uint64_t now_us)
{
    switch (baud_rate_poll(&unit->baud_rate, &unit->link, unit->board, now_us)) {
    case BAUD_RATE_GIVEN_BACK: dispatch_forget(unit, EBL_MSG_SET_BAUD); break;
    case BAUD_RATE_FORGOTTEN: telemetry_end_all(&unit->telemetry); break;
    default: break;
    }
}

void app_poll(app *unit)
{
    uint64_t now_us = unit_now_us(unit);

    transaction_poll(&unit->config.transaction, now_us);
    if (trial_is_over(&unit->config.trial, &unit->config.store, now_us)) {
        trial_return(&unit->config.trial, &unit->config.store, unit->board,
                     EBL_ROLLBACK_CAUSE_TIME_OUT);
        config_rolled_back(&unit->config, &unit->events, &unit->link, unit->board);
    }
    if (live_expire(&unit->config.live, now_us)) config_apply(&unit->config);
    counters_poll(&unit->counters, unit->board, now_us);
    telemetry_poll(&unit->telemetry, &unit->events, &unit->link, now_us);
    receive(unit);
    baud_rate_serve(unit, now_us);
    events_poll(&unit->events, &unit->link, now_us);
    ride_log_poll(&unit->ride_log, unit->board, &unit->config.store, &unit->events, &unit->link);
    requests_log_poll(unit);
    unit->counters.log_erases += unit->ride_log.store.erases;
    unit->ride_log.store.erases = 0;
    link_transmit(&unit->link, unit->board);
    dispatch_answers_left(unit);
    step_watch_poll(&unit->watch, unit->board, now_us);
}

static uint8_t mode_select(const app *unit, const hal_inputs *inputs)
{
    if (inputs->mode_selected < ASSIST_MODE_SLOTS) return inputs->mode_selected;
    return unit->config.in_force.assist_mode_at_start;
}

/* The law refuses what is not a number, so that is what a broken sensor becomes. */
static void assist_input_from(const hal_inputs *inputs, float speed_kmh, uint8_t mode, int inhibit,
                              assist_input *input)
{
    memset(input, 0, sizeof *input);
    input->torque_raw_counts = inputs_torque_is_plausible(inputs->torque_raw_counts)
                                   ? inputs->torque_raw_counts
                                   : float32_missing();
    input->speed_kmh = speed_kmh;
    input->cadence_rpm = inputs->cadence_rpm;
    input->motor_speed_rpm = inputs->motor_speed_rpm;
    input->battery_voltage_v = inputs->battery_voltage_v;
    input->battery_current_a = inputs->battery_current_a;
    input->motor_temperature_degc = inputs->motor_temperature_degc;
    input->controller_temperature_degc = inputs->controller_temperature_degc;
    input->sensor_temperature_degc = inputs->sensor_temperature_degc;
    input->torque_age_ms = inputs->torque_age_ms;
    input->mode = mode;
    input->brake = inputs->brake;
    input->walk_button = inputs->walk_button;
    input->inhibit = (uint8_t)inhibit;
}

static void faults_report(app *unit, const hal_inputs *inputs, float speed_kmh, uint64_t now_us)
{
    const assist_output *output = &unit->output;
    const fault_law law = {
        output->rider_torque_nm,
        output->motor_torque_nm,
        float32_max(output->motor_torque_nm, output->motor_torque_demanded_nm),
        unit->assist_state.torque_filtered_nm,
        unit->law_lost,
        speed_kmh,
    };
    uint32_t set;
    uint32_t cleared;

    faults_step(&unit->faults, inputs, &unit->config.in_force, &law, &set, &cleared);
    unit->faults_new = set;
    if (set != 0) report_faults_set(unit, set, now_us);
    if (cleared != 0) report_faults_cleared(unit, cleared, now_us);
}

/* The bike is being ridden, and a ride log is kept: the same comparison as the host's. */
static int is_moving(const hal_inputs *inputs, float speed_kmh)
{
    return speed_kmh > EBL_MOVING_KMH || inputs->cadence_rpm > EBL_MOVING_RPM;
}

/* Once more before the motor: whatever the law says, only a number within the limit goes there. */
static void motor_drive(app *unit, int result)
{
    float motor_nm = unit->output.motor_torque_nm;
    int sound = motor_nm >= 0.0f && motor_nm <= unit->config.law.motor_torque_nm_max;

    unit->law_lost = result == ASSIST_RESULT_LOST || !sound;
    if (!sound) unit->output.motor_torque_nm = 0.0f;
    unit->board->motor_torque_set(unit->board->context, unit->output.motor_torque_nm);
}

void app_control_step(app *unit)
{
    uint64_t now_us = unit_now_us(unit);
    hal_inputs inputs;
    assist_input input;
    telemetry_sources sources = {&inputs, &input, &unit->output, 0.0f, 0};
    float speed_kmh;
    float way_m;
    uint8_t mode;

    if (step_watch_begin(&unit->watch, now_us) > 0) assist_interrupted(&unit->assist_state);
    inputs_take(unit->board, &inputs);
    way_m = road_speed_step(&unit->speed, &unit->config.in_force, &inputs);
    speed_kmh = road_speed_kmh(&unit->speed, &unit->config.in_force, now_us);
    mode = mode_select(unit, &inputs);
    /* Before the law: what it finds holds in this step. */
    faults_report(unit, &inputs, speed_kmh, now_us);
    assist_input_from(&inputs, speed_kmh, mode, faults_inhibit(&unit->faults), &input);
    motor_drive(unit, assist_step(&unit->config.law, &unit->assist_state, &input, &unit->output));

    counters_step(&unit->counters, speed_kmh, way_m);
    ride_log_mode_set(&unit->ride_log, mode, now_us);
    sources.motor_torque_delivered_nm = motor_torque_delivered_nm(
        &unit->config.law, inputs.motor_current_a, inputs.motor_speed_rpm);
    sources.fault_flags = unit->faults.active;
    telemetry_step(&unit->telemetry, &sources, now_us, &unit->link);
    faults_freeze(&unit->faults, unit->faults_new, now_us, unit->telemetry.row);
    ride_log_step(&unit->ride_log, unit->telemetry.row, now_us, is_moving(&inputs, speed_kmh));
    step_watch_done(&unit->watch);
}

const assist_output *app_output(const app *unit) { return &unit->output; }
