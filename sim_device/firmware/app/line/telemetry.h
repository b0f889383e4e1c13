/* Rows of channels, taken at every control step, to subscribed streams of counted frames. */
#ifndef SPINDLE_TELEMETRY_H
#define SPINDLE_TELEMETRY_H

#include <stddef.h>
#include <stdint.h>

#include "assist_types.h" // assist_input, assist_output
#include "ebl_registry.h" // EBL_CHANNEL_COUNT
#include "events.h"       // event_log
#include "hal.h"          // hal_inputs
#include "link.h"         // unit_link

#define TELEMETRY_STREAMS 4

/* What a row is made of. */
typedef struct {
    const hal_inputs *inputs;
    const assist_input *given; /* to the law */
    const assist_output *output;
    float motor_torque_delivered_nm;
    uint32_t fault_flags;
} telemetry_sources;

typedef struct {
    uint8_t active;
    uint8_t stream_id;
    uint8_t batch;
    uint8_t epoch;
    uint16_t divider;
    uint16_t steps_left; /* until the next row */
    uint64_t lease_end_us;
    uint64_t stats_due_us;
    uint16_t seq;   /* of the frame being built */
    uint32_t built; /* since the subscription, like dropped_tx */
    uint32_t dropped_tx;
    uint32_t missed; /* control steps that came too late for a row of their own */
    uint8_t rows;    /* in the frame being built */
    uint8_t flags;   /* of the frame being built, without the epoch */
    uint8_t overrun; /* the frame before this one was dropped */
    uint8_t channel_count;
    uint8_t channels[EBL_CHANNEL_COUNT]; /* places in the row */
    uint8_t frame[LINK_MTU];
} telemetry_stream;

typedef struct {
    int16_t row[EBL_CHANNEL_COUNT]; /* the latest, in the order of ebl_channels */
    uint32_t clipped;               /* a bit for each place in the row */
    uint64_t row_us;
    uint8_t epoch; /* of the latest subscription, 0 to 7 */
    telemetry_stream streams[TELEMETRY_STREAMS];
} telemetry;

void telemetry_init(telemetry *state);

/* Takes a row and gives it to every stream whose turn it is. */
void telemetry_step(telemetry *state, const telemetry_sources *sources, uint64_t now_us,
                    unit_link *link);

/* Ends streams whose lease is over, and reports each stream once a second. */
void telemetry_poll(telemetry *state, event_log *events, unit_link *link, uint64_t now_us);

/* What frames go out on: `baud` 0 is a line without a limit. */
typedef struct {
    uint16_t tx_mtu;
    uint32_t baud;
} telemetry_line;

/* Starts or changes a stream, if all streams together then leave the line its reserve. Returns an
 * ebl_status. */
uint8_t telemetry_subscribe(telemetry *state, const ebl_str_subscribe_request *request,
                            const telemetry_line *line, uint64_t now_us,
                            ebl_str_subscribe_response *response, uint16_t *detail);

/* Whether the streams that run would leave a line of this rate its reserve. */
int telemetry_fits(const telemetry *state, uint32_t baud);

/* Ends a stream and tells its last counts. */
uint8_t telemetry_unsubscribe(telemetry *state, event_log *events, unit_link *link, uint64_t now_us,
                              uint8_t stream_id);

/* Bytes a second that the stream needs at most. */
uint32_t telemetry_bytes_per_s(const telemetry_stream *stream);
uint8_t telemetry_renew(telemetry *state, uint8_t stream_id, uint8_t lease_s, uint64_t now_us);
void telemetry_end_all(telemetry *state);

/* The latest row of the channels as i16 counts. Returns an ebl_status. */
uint8_t telemetry_snapshot(const telemetry *state, const uint8_t *channel_ids, size_t count,
                           uint8_t *values, uint16_t *detail);

#endif
