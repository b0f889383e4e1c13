#include "app.h"

#include <math.h>
#include <string.h>

#include "dispatch.h"   // dispatch_frame
#include "parameters.h" // parameters_to_assist

#define RECEIVE_BLOCK_BYTES 64

/* Bytes served in one poll: at 1 Mbaud the line brings 100 in a millisecond, and a flood must not
 * keep the unit from its other work. */
#define RECEIVE_BLOCKS_MAX 32

void app_config_apply(app *app)
{
    ebl_config_unpack(&app->config, app->store.image);
    parameters_to_assist(&app->config, &app->assist_config_next);
    app->assist_config_pending = 1;
}

static void config_defaulted(app *app)
{
    uint64_t now_us = app->hal->now_us(app->hal->context);

    event_config(&app->events, &app->link, now_us, EBL_EVENT_CONFIG_DEFAULTED,
                 app->store.generation, app->store.crc32);
    if (!faults_latch(&app->faults, EBL_FAULT_CONFIG_DEFAULTED)) return;
    event_faults_set(&app->events, &app->link, now_us, EBL_FAULT_CONFIG_DEFAULTED);
}

void app_init(app *app, const hal *hal)
{
    memset(app, 0, sizeof *app);
    app->hal = hal;
    app->tx_mtu = EBL_MTU_BEFORE_HELLO;
    app->output.fuzzy_gain = NAN;
    link_init(&app->link);
    telemetry_init(&app->telemetry);
    config_store_boot(&app->store, hal);
    app_config_apply(app);
    event_boot(&app->events, &app->link, hal->now_us(hal->context), hal->boot_id);
    if (app->store.slot == CONFIG_STORE_NO_SLOT) config_defaulted(app);
}

int app_provision(const hal *hal, const ebl_config *config)
{
    uint8_t image[EBL_IMAGE_LENGTH];

    ebl_config_pack(config, image);
    return config_store_provision(hal, image);
}

static void receive(app *app)
{
    uint8_t block[RECEIVE_BLOCK_BYTES];

    for (int i = 0; i < RECEIVE_BLOCKS_MAX; i++) {
        size_t length = app->hal->serial_read(app->hal->context, block, sizeof block);
        size_t at = 0;

        if (length == 0) return;
        while (at < length) {
            const uint8_t *frame = NULL;
            size_t frame_length = 0;

            at += ebl_decoder_feed(&app->link.decoder, block + at, length - at, &frame,
                                   &frame_length);
            if (frame != NULL) dispatch_frame(app, frame, frame_length);
        }
    }
}

void app_poll(app *app)
{
    uint64_t now_us = app->hal->now_us(app->hal->context);

    transaction_poll(&app->transaction, now_us);
    telemetry_poll(&app->telemetry, &app->events, &app->link, now_us);
    receive(app);
    link_transmit(&app->link, app->hal);
}

static uint8_t mode_select(const app *app, const hal_inputs *inputs)
{
    if (inputs->mode_selected < ASSIST_MODE_SLOTS) return inputs->mode_selected;
    return app->config.assist_mode_at_start;
}

/* The law refuses what is not a number, so that is what a broken sensor becomes. */
static void assist_input_from(const hal_inputs *inputs, uint8_t mode, assist_input *input)
{
    input->torque_raw_counts =
        faults_torque_is_plausible(inputs->torque_raw_counts) ? inputs->torque_raw_counts : NAN;
    input->speed_kmh = inputs->speed_kmh;
    input->cadence_rpm = inputs->cadence_rpm;
    input->motor_speed_rpm = inputs->motor_speed_rpm;
    input->battery_voltage_v = inputs->battery_voltage_v;
    input->mode = mode;
    input->brake = inputs->brake;
}

static void faults_report(app *app, const hal_inputs *inputs, uint64_t now_us)
{
    uint16_t set;
    uint16_t cleared;

    faults_step(&app->faults, inputs, app->config.battery_voltage_v_min, &set, &cleared);
    if (set != 0) event_faults_set(&app->events, &app->link, now_us, set);
    if (cleared != 0) event_faults_cleared(&app->events, &app->link, now_us, cleared);
}

void app_control_step(app *app)
{
    uint64_t now_us = app->hal->now_us(app->hal->context);
    hal_inputs inputs;
    assist_input input;
    telemetry_sources sources = {&inputs, &app->output, 0, 0};

    if (app->assist_config_pending) {
        app->assist_config = app->assist_config_next;
        app->assist_config_pending = 0;
    }
    app->hal->inputs_read(app->hal->context, &inputs);
    sources.mode = mode_select(app, &inputs);
    assist_input_from(&inputs, sources.mode, &input);
    (void)assist_step(&app->assist_config, &app->assist_state, &input, &app->output);
    app->hal->motor_torque_set(app->hal->context, app->output.motor_torque_nm);

    faults_report(app, &inputs, now_us);
    sources.fault_flags = app->faults.active;
    telemetry_step(&app->telemetry, &sources, now_us, &app->link);
}

const assist_output *app_output(const app *app)
{
    return &app->output;
}
