/* The wheel's speed and way from its pulses: the number that every cut-off rests on.
 *
 * - A reading is the way of the pulses of the latest 50 ms over the time between them, of one pulse
 *   at least. It comes new with every control step that brings a pulse.
 * - While no pulse comes it falls: never more than what one would give now. Zero after 2 s.
 * - A pulse that comes sooner than at 150 km/h is a bounce and counts for nothing; where pulses
 *   keep coming so fast the reading says so, for the fault of the sensor to see.
 * - A wheel that still grips is not braked harder than 15 m/s2: where a gap says so, one pulse was
 *   missed and is added, but never two in a row.
 */
#ifndef SPINDLE_WHEEL_SPEED_H
#define SPINDLE_WHEEL_SPEED_H

#include <stdint.h>

#define WHEEL_SPEED_MARKS 8

/* A pulse that was believed: its number, and when it came. */
typedef struct {
    uint32_t number;
    uint64_t at_us;
} wheel_mark;

typedef struct {
    wheel_mark marks[WHEEL_SPEED_MARKS];
    uint8_t newest;
    uint8_t kept;       /* marks that mean anything; 0: the wheel stands, or nothing is known */
    uint8_t begun;      /* the count was read once */
    uint8_t early;      /* looks in a row whose pulses came too early */
    uint8_t mended;     /* a missed pulse was added at the latest one */
    uint32_t count;     /* as last read */
    uint32_t pending;   /* pulses that came too early, until it is known what they are */
    uint32_t uncounted; /* the count less a pulse's number: bounces, less those missed */
    float speed_ms;     /* at the newest mark */
    float before_ms;    /* and at the one before */
} wheel_speed;

/* A wheel that nothing is known of: zero until two pulses came. */
void wheel_speed_init(wheel_speed *state);

/* Reads the board's running count, which wraps, and the time of its latest pulse. `pulse_m`: the
 * wheel's circumference over its pulses a turn. Returns the way since the last call in metres. */
float wheel_speed_pulses(wheel_speed *state, float pulse_m, uint32_t count, uint64_t pulse_us);

/* The reading at this time. */
float wheel_speed_kmh(const wheel_speed *state, float pulse_m, uint64_t now_us);

#endif
