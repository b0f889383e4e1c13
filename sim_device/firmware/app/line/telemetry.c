#include "telemetry.h"

#include <string.h>

#include "stream_budget.h" // stream_bytes_per_s
#include "ebl_bytes.h"     // ebl_put_i16, ebl_put_u32
#include "ebl_frame.h"     // EBL_HEADER_LENGTH, ebl_header_put
#include "ebl_values.h"    // ebl_channel_counts
#include "float32.h"       // float32_missing

#define COUNT_MAX 32767    /* what a value beyond the range of its channel becomes */
#define FLAGS_MASK 0x7fffu /* what an int16 carries of them: bits 15 and 31 are never given */
#define STREAM_OVERHEAD (EBL_HEADER_LENGTH + STREAM_HEAD_LENGTH)
#define FLAG_OVERRUN 0x08
#define FLAG_CLIPPED 0x10
#define EPOCH_MASK 0x07
#define STATS_PERIOD_US 1000000u
#define US_PER_S 1000000u

/* telemetry.clipped has a bit for each place in the row. */
typedef char clipped_has_a_bit_for_each[EBL_CHANNEL_COUNT <= 32 ? 1 : -1];

static float input_flags_of(const assist_input *given)
{
    unsigned flags = given->brake ? EBL_INPUT_BRAKE : 0u;

    if (given->walk_button) flags |= EBL_INPUT_WALK_BUTTON;
    if (given->inhibit) flags |= EBL_INPUT_INHIBIT;
    return (float)flags;
}

/* One line for each channel; one that has no line here is missing. */
static float channel_value(uint8_t channel_id, const telemetry_sources *sources)
{
    const hal_inputs *inputs = sources->inputs;
    const assist_input *given = sources->given;
    const assist_output *output = sources->output;

    switch (channel_id) {
    case EBL_CHANNEL_SPEED_KMH: return given->speed_kmh;
    case EBL_CHANNEL_CADENCE_RPM: return inputs->cadence_rpm;
    case EBL_CHANNEL_CRANK_ANGLE_DEG: return inputs->crank_angle_deg;
    case EBL_CHANNEL_RIDER_TORQUE_NM: return output->rider_torque_nm;
    case EBL_CHANNEL_RIDER_TORQUE_RAW: return inputs->torque_raw_counts;
    case EBL_CHANNEL_RIDER_TORQUE_FILTERED_NM: return output->rider_torque_filtered_nm;
    case EBL_CHANNEL_TORQUE_RATE: return output->torque_rate;
    case EBL_CHANNEL_MOTOR_TORQUE_NM: return sources->motor_torque_delivered_nm;
    case EBL_CHANNEL_MOTOR_CURRENT_A: return inputs->motor_current_a;
    case EBL_CHANNEL_MOTOR_SPEED_RPM: return inputs->motor_speed_rpm;
    case EBL_CHANNEL_BATTERY_CURRENT_A: return inputs->battery_current_a;
    case EBL_CHANNEL_BATTERY_VOLTAGE_V: return inputs->battery_voltage_v;
    case EBL_CHANNEL_BATTERY_SOC_PCT: return inputs->battery_soc_pct;
    case EBL_CHANNEL_ASSIST_RATIO: return output->assist_ratio;
    case EBL_CHANNEL_FUZZY_GAIN: return output->fuzzy_gain;
    case EBL_CHANNEL_ASSIST_MODE: return (float)given->mode;
    case EBL_CHANNEL_LIMIT_FLAGS: return (float)output->limit_flags;
    case EBL_CHANNEL_MOTOR_TEMPERATURE_DEGC: return inputs->motor_temperature_degc;
    case EBL_CHANNEL_SENSOR_TEMPERATURE_DEGC: return inputs->sensor_temperature_degc;
    case EBL_CHANNEL_FAULT_FLAGS: return (float)(sources->fault_flags & FLAGS_MASK);
    case EBL_CHANNEL_FAULT_FLAGS_HIGH: return (float)(sources->fault_flags >> 16 & FLAGS_MASK);
    case EBL_CHANNEL_INPUT_FLAGS: return input_flags_of(given);
    case EBL_CHANNEL_TORQUE_AGE_MS: return (float)given->torque_age_ms;
    case EBL_CHANNEL_CONTROLLER_TEMPERATURE_DEGC: return given->controller_temperature_degc;
    case EBL_CHANNEL_MOTOR_TORQUE_DEMANDED_NM: return output->motor_torque_demanded_nm;
    case EBL_CHANNEL_MOTOR_TORQUE_AVAILABLE_NM: return output->motor_torque_available_nm;
    default: return float32_missing();
    }
}

void telemetry_init(telemetry *state)
{
    memset(state, 0, sizeof *state);
    for (size_t i = 0; i < EBL_CHANNEL_COUNT; i++) state->row[i] = EBL_MISSING;
}

static size_t row_bytes(const telemetry_stream *stream)
{
    return (size_t)stream->channel_count * 2;
}

static void frame_send(telemetry_stream *stream, unit_link *link)
{
    uint8_t *head = stream->frame + EBL_HEADER_LENGTH;

    ebl_header_put(stream->frame, EBL_KIND_STREAM, 0, stream->stream_id, stream->seq);
    head[4] = stream->rows;
    head[5] = (uint8_t)(stream->epoch | stream->flags | (stream->overrun ? FLAG_OVERRUN : 0));
    stream->overrun = 0;
    if (!link_send(link, LINK_STREAM, stream->frame,
                   STREAM_OVERHEAD + stream->rows * row_bytes(stream))) {
        stream->dropped_tx++;
        stream->overrun = 1;
    }
    stream->seq++;
    stream->built++;
    stream->rows = 0;
    stream->flags = 0;
}

static void row_add(telemetry_stream *stream, const telemetry *state, unit_link *link)
{
    uint8_t *bytes = stream->frame + STREAM_OVERHEAD + stream->rows * row_bytes(stream);

    if (stream->rows == 0) {
        ebl_put_u32(stream->frame + EBL_HEADER_LENGTH, (uint32_t)state->row_us);
    }
    for (size_t i = 0; i < stream->channel_count; i++) {
        uint8_t place = stream->channels[i];

        ebl_put_i16(bytes + 2 * i, state->row[place]);
        if (state->clipped >> place & 1u) stream->flags |= FLAG_CLIPPED;
    }
    stream->rows++;
    if (stream->rows == stream->batch) frame_send(stream, link);
}

/* A step that came late leaves a hole: the rows before it go out, so that every frame's rows are a
 * period apart. */
static void steps_missed(telemetry *state, uint64_t now_us, unit_link *link)
{
    uint64_t late_us = now_us - state->row_us;

    if (state->row_us == 0 || late_us < 2 * EBL_CONTROL_PERIOD_US) return;
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        telemetry_stream *stream = &state->streams[i];

        if (!stream->active) continue;
        stream->missed += (uint32_t)(late_us / EBL_CONTROL_PERIOD_US) - 1;
        if (stream->rows > 0) frame_send(stream, link);
    }
}

void telemetry_step(telemetry *state, const telemetry_sources *sources, uint64_t now_us,
                    unit_link *link)
{
    steps_missed(state, now_us, link);
    state->row_us = now_us;
    state->clipped = 0;
    for (size_t i = 0; i < EBL_CHANNEL_COUNT; i++) {
        float value = channel_value(ebl_channels[i].id, sources);
        int16_t count = ebl_channel_counts(ebl_channels[i].scale, value);

        state->row[i] = count;
        if (count == COUNT_MAX || count == -COUNT_MAX) state->clipped |= 1u << i;
    }
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        telemetry_stream *stream = &state->streams[i];

        if (!stream->active || --stream->steps_left > 0) continue;
        stream->steps_left = stream->divider;
        row_add(stream, state, link);
    }
}

static void counts_tell(const telemetry_stream *stream, event_log *events, unit_link *link,
                        uint64_t now_us)
{
    ebl_stream_counts_event counts = {stream->stream_id, stream->epoch, stream->built,
                                      stream->dropped_tx, stream->missed};

    event_stream_counts(events, link, now_us, &counts);
}

void telemetry_poll(telemetry *state, event_log *events, unit_link *link, uint64_t now_us)
{
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        telemetry_stream *stream = &state->streams[i];

        if (!stream->active) continue;
        if (now_us >= stream->lease_end_us) {
            stream->active = 0;
            counts_tell(stream, events, link, now_us);
        } else if (now_us >= stream->stats_due_us) {
            stream->stats_due_us = now_us + STATS_PERIOD_US;
            counts_tell(stream, events, link, now_us);
        }
    }
}

static telemetry_stream *stream_find(telemetry *state, uint8_t stream_id)
{
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        telemetry_stream *stream = &state->streams[i];

        if (stream->active && stream->stream_id == stream_id) return stream;
    }
    return NULL;
}

static telemetry_stream *stream_free(telemetry *state)
{
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        if (!state->streams[i].active) return &state->streams[i];
    }
    return NULL;
}

/* Places in the row of the channels. The unknown id goes to `detail`. */
static uint8_t places_find(const uint8_t *channel_ids, size_t count, uint8_t *places,
                           uint16_t *detail)
{
    if (count == 0 || count > EBL_CHANNEL_COUNT) return EBL_STATUS_LENGTH;
    for (size_t i = 0; i < count; i++) {
        const ebl_channel *channel = ebl_channel_find(channel_ids[i]);

        if (channel == NULL) {
            *detail = channel_ids[i];
            return EBL_STATUS_UNKNOWN_ID;
        }
        places[i] = (uint8_t)(channel - ebl_channels);
    }
    return EBL_STATUS_OK;
}

/* Largest number of rows that a frame of the MTU carries. */
static uint16_t batch_max(uint16_t tx_mtu, size_t channel_count)
{
    size_t room = (size_t)tx_mtu - STREAM_OVERHEAD - EBL_CHECK_LENGTH;

    return (uint16_t)(room / (channel_count * 2));
}

uint32_t telemetry_bytes_per_s(const telemetry_stream *stream)
{
    return stream_bytes_per_s(stream->channel_count, stream->batch, stream->divider);
}

/* What the line has left for the stream of this id, and whether that is enough. */
static uint8_t bandwidth_check(const telemetry *state, const ebl_str_subscribe_request *request,
                               uint32_t baud, uint16_t *detail)
{
    uint32_t left = stream_budget_bytes_per_s(baud);
    size_t channels = request->channel_ids_length;

    if (baud == 0) return EBL_STATUS_OK;
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        const telemetry_stream *other = &state->streams[i];
        uint32_t needed = telemetry_bytes_per_s(other);

        if (!other->active || other->stream_id == request->stream_id) continue;
        left = left > needed ? left - needed : 0;
    }
    if (stream_bytes_per_s(channels, request->batch, request->divider) <= left) {
        return EBL_STATUS_OK;
    }
    *detail = stream_rate_hz_max(left, channels, request->batch);
    return EBL_STATUS_BANDWIDTH;
}

int telemetry_fits(const telemetry *state, uint32_t baud)
{
    uint32_t needed = 0;

    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) {
        if (state->streams[i].active) needed += telemetry_bytes_per_s(&state->streams[i]);
    }
    return baud == 0 || needed <= stream_budget_bytes_per_s(baud);
}

static uint8_t subscription_check(const ebl_str_subscribe_request *request, uint16_t tx_mtu,
                                  uint16_t *detail)
{
    *detail = 0;
    if (request->encoding != 0) return EBL_STATUS_UNSUPPORTED;
    if (request->divider == 0 || request->batch == 0 || request->lease_s == 0) {
        return EBL_STATUS_RANGE;
    }
    if (request->channel_ids_length == 0 || request->channel_ids_length > EBL_CHANNEL_COUNT) {
        return EBL_STATUS_LENGTH;
    }
    *detail = batch_max(tx_mtu, request->channel_ids_length);
    if (request->batch > *detail) return EBL_STATUS_RANGE;
    *detail = 0;
    return EBL_STATUS_OK;
}

uint8_t telemetry_subscribe(telemetry *state, const ebl_str_subscribe_request *request,
                            const telemetry_line *line, uint64_t now_us,
                            ebl_str_subscribe_response *response, uint16_t *detail)
{
    uint8_t places[EBL_CHANNEL_COUNT];
    telemetry_stream *stream = stream_find(state, request->stream_id);
    uint8_t status = subscription_check(request, line->tx_mtu, detail);

    if (status != EBL_STATUS_OK) return status;
    status = places_find(request->channel_ids, request->channel_ids_length, places, detail);
    if (status != EBL_STATUS_OK) return status;
    status = bandwidth_check(state, request, line->baud, detail);
    if (status != EBL_STATUS_OK) return status;
    if (stream == NULL) stream = stream_free(state);
    if (stream == NULL) return EBL_STATUS_NO_SPACE;

    state->epoch = (uint8_t)((state->epoch + 1) & EPOCH_MASK);
    memset(stream, 0, sizeof *stream);
    stream->active = 1;
    stream->stream_id = request->stream_id;
    stream->batch = request->batch;
    stream->epoch = state->epoch;
    stream->divider = request->divider;
    stream->steps_left = 1;
    stream->lease_end_us = now_us + (uint64_t)request->lease_s * US_PER_S;
    stream->stats_due_us = now_us + STATS_PERIOD_US;
    stream->channel_count = (uint8_t)request->channel_ids_length;
    memcpy(stream->channels, places, stream->channel_count);

    response->period_us = (uint32_t)stream->divider * EBL_CONTROL_PERIOD_US;
    response->batch = stream->batch;
    response->epoch = stream->epoch;
    response->start_seq = stream->seq;
    response->bytes_per_s = telemetry_bytes_per_s(stream);
    return EBL_STATUS_OK;
}

uint8_t telemetry_unsubscribe(telemetry *state, event_log *events, unit_link *link, uint64_t now_us,
                              uint8_t stream_id)
{
    telemetry_stream *stream = stream_find(state, stream_id);

    if (stream == NULL) return EBL_STATUS_NOT_FOUND;
    stream->active = 0;
    counts_tell(stream, events, link, now_us);
    return EBL_STATUS_OK;
}

uint8_t telemetry_renew(telemetry *state, uint8_t stream_id, uint8_t lease_s, uint64_t now_us)
{
    telemetry_stream *stream = stream_find(state, stream_id);

    if (stream == NULL) return EBL_STATUS_NOT_FOUND;
    if (lease_s == 0) return EBL_STATUS_RANGE;
    stream->lease_end_us = now_us + (uint64_t)lease_s * US_PER_S;
    return EBL_STATUS_OK;
}

void telemetry_end_all(telemetry *state)
{
    for (size_t i = 0; i < TELEMETRY_STREAMS; i++) state->streams[i].active = 0;
}

uint8_t telemetry_snapshot(const telemetry *state, const uint8_t *channel_ids, size_t count,
                           uint8_t *values, uint16_t *detail)
{
    uint8_t places[EBL_CHANNEL_COUNT];
    uint8_t status = places_find(channel_ids, count, places, detail);

    if (status != EBL_STATUS_OK) return status;
    for (size_t i = 0; i < count; i++) ebl_put_i16(values + 2 * i, state->row[places[i]]);
    return EBL_STATUS_OK;
}
