#include "wheel_speed.h"

#include <string.h>

#include "float32.h" // float32_min

#define US_PER_S 1000000.0f
#define KMH_PER_MS 3.6f

/* Long enough to even out magnets that sit badly, short against what a bike gains in it: 0.05 s at
 * 2 m/s2 are 0.36 km/h, and half of it is the reading's lateness. */
#define WINDOW_US 50000

/* A wheel with one magnet turns in it at 3.7 km/h. */
#define STILL_US 2000000

/* No e-bike goes faster: 150 km/h. */
#define FASTEST_MS 41.7f

/* A contact bounces for a millisecond or two: what is too early in two looks running is none. */
#define EARLY_MAX 2

/* Brakes on a dry road reach 8 m/s2 before a wheel lifts or slips. */
#define BRAKED_MS2 15.0f
#define EVENLY 1.25f

void wheel_speed_init(wheel_speed *state) { memset(state, 0, sizeof *state); }

static const wheel_mark *newest_mark(const wheel_speed *state)
{
    return &state->marks[state->newest];
}

static void mark(wheel_speed *state, uint32_t number, uint64_t at_us)
{
    state->newest = (uint8_t)((state->newest + 1) % WHEEL_SPEED_MARKS);
    if (state->kept < WHEEL_SPEED_MARKS) state->kept++;
    state->marks[state->newest].number = number;
    state->marks[state->newest].at_us = at_us;
}

static float speed_ms(float pulse_m, uint32_t pulses, int64_t duration_us)
{
    return pulse_m * (float)pulses * US_PER_S / (float)(duration_us > 0 ? duration_us : 1);
}

/* Over the marks of the window, or to the one before the newest. */
static float window_speed_ms(const wheel_speed *state, float pulse_m)
{
    const wheel_mark *last = newest_mark(state);
    const wheel_mark *first = last;

    for (uint8_t back = 1; back < state->kept; back++) {
        uint8_t at = (uint8_t)((state->newest + WHEEL_SPEED_MARKS - back) % WHEEL_SPEED_MARKS);
        const wheel_mark *earlier = &state->marks[at];

        if (back > 1 && (int64_t)(last->at_us - earlier->at_us) > WINDOW_US) break;
        first = earlier;
    }
    return speed_ms(pulse_m, last->number - first->number, (int64_t)(last->at_us - first->at_us));
}

/* True where this gap would be a braking that no tyre can do, and one pulse more would not. */
static int one_was_missed(const wheel_speed *state, float pulse_m, uint32_t pulses,
                          int64_t duration_us)
{
    float now_ms = speed_ms(pulse_m, pulses, duration_us);
    float duration_s = (float)duration_us / US_PER_S;

    if (state->mended || state->kept < 3) return 0;
    /* It rolled on evenly before and after, or it was something else: a bounce, for one. */
    if (state->speed_ms > EVENLY * state->before_ms) return 0;
    if (speed_ms(pulse_m, pulses + 1, duration_us) > EVENLY * state->speed_ms) return 0;
    return state->speed_ms - now_ms > BRAKED_MS2 * duration_s;
}

float wheel_speed_pulses(wheel_speed *state, float pulse_m, uint32_t count, uint64_t pulse_us)
{
    uint32_t fresh = count - state->count;
    uint32_t pulses;
    int64_t duration_us;

    state->count = count;
    if (!state->begun) {
        state->begun = 1;
        return 0.0f;
    }
    if (fresh == 0) return 0.0f;
    duration_us = (int64_t)(pulse_us - newest_mark(state)->at_us);
    if (state->kept == 0 || duration_us > STILL_US) {
        state->kept = 0;
        state->early = 0;
        state->pending = 0;
        state->mended = 0;
        state->speed_ms = 0.0f;
        mark(state, count - state->uncounted, pulse_us);
        return (float)fresh * pulse_m;
    }
    pulses = count - state->uncounted - newest_mark(state)->number;
    if (speed_ms(pulse_m, pulses, duration_us) > FASTEST_MS) {
        if (state->early < EARLY_MAX) state->early++;
        if (state->early < EARLY_MAX) {
            state->pending += fresh;
            return 0.0f;
        }
    } else {
        state->early = 0;
        state->uncounted += state->pending; /* they were bounces */
        pulses -= state->pending;
    }
    state->pending = 0;
    state->mended = (uint8_t)one_was_missed(state, pulse_m, pulses, duration_us);
    if (state->mended) {
        state->uncounted--;
        pulses++;
    }
    mark(state, count - state->uncounted, pulse_us);
    state->before_ms = state->speed_ms;
    state->speed_ms = window_speed_ms(state, pulse_m);
    return (float)pulses * pulse_m;
}

float wheel_speed_kmh(const wheel_speed *state, float pulse_m, uint64_t now_us)
{
    int64_t since_us = (int64_t)(now_us - newest_mark(state)->at_us);

    if (state->kept < 2 || since_us >= STILL_US) return 0.0f;
    if (since_us <= 0) return KMH_PER_MS * state->speed_ms;
    return KMH_PER_MS * float32_min(state->speed_ms, speed_ms(pulse_m, 1, since_us));
}
