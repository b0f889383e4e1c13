#include "twin.h"

#include <math.h>

#include "assist.h"  // assist_step
#include "float32.h" // float32_missing

#define KMH_PER_MS 3.6
#define RPM_PER_RAD_S (30.0 / 3.14159265358979323846)
#define CRAWLING_MS 1.5
#define PUSHED_OFF_MS 0.3 /* a foot on the ground brings a bike this far */
#define HOLD_PER_MS 2.0   /* push more by this share for each m/s below the recorded speed */
#define PUSH_SHARE_MIN 0.4
#define PUSH_SHARE_MAX 2.5
#define REACH_SHARE_MIN 0.5 /* no cassette is wider than that around the cog it is on */
#define REACH_SHARE_MAX 2.0
#define CEILING_PLAY_MS 0.05
#define STALLED_S 20.0
#define MEMORY_STEPS 500 /* the law has forgotten the ride after five seconds at rest */

typedef struct {
    const twin_road *road;
    const twin_bike *bike;
    const twin_rider *rider;
    const assist_config *law;
    assist_state state;
    twin_ride_totals *totals;
    double t_s;
    double distance_m;
    double speed_ms;
    double voltage_v;
    double current_a;
    double motor_nm; /* of the step before */
    double stalled_s;
    size_t stood_at; /* the point of the last stop */
} ride;

static size_t point_at(const twin_road *road, double distance_m)
{
    const size_t point = (size_t)(distance_m / road->spacing_m);
    return point < road->count ? point : road->count - 1;
}

static double between(double value, double low, double high)
{
    return fmin(fmax(value, low), high);
}

static int crawls(const ride *self, size_t at)
{
    return self->road->speed_ms[at] < CRAWLING_MS || self->speed_ms < CRAWLING_MS;
}

/* The recorded reach, or the one this rider shifts to at another speed. */
static double reach_m(const ride *self, size_t at)
{
    const double recorded_m = self->road->reach_m[at];
    if (!(self->rider->cadence_share > 0.0) || crawls(self, at)) return recorded_m;
    return recorded_m *
           between(pow(self->speed_ms / self->road->speed_ms[at], self->rider->cadence_share),
                   REACH_SHARE_MIN, REACH_SHARE_MAX);
}

/* The recorded push, changed as this rider changes it at another speed. */
static double push_nm(const ride *self, size_t at, double reached_m)
{
    const double recorded_nm = self->road->rider_nm[at];
    const double recorded_ms = self->road->speed_ms[at];
    double share;
    if (crawls(self, at) || recorded_nm <= 0.0) return recorded_nm;
    /* Chainring then over chainring now. */
    share = recorded_ms / self->speed_ms * reached_m / self->road->reach_m[at];
    share = pow(share, self->rider->power_share);
    share += self->rider->hold_share * HOLD_PER_MS * (recorded_ms - self->speed_ms);
    return recorded_nm *
           between(share, PUSH_SHARE_MIN * (1.0 - self->rider->hold_share), PUSH_SHARE_MAX);
}

static double assist_nm(ride *self, size_t at, double rider_nm, double chainring_rad_s, int brake,
                        assist_output *output)
{
    const twin_road *road = self->road;
    const double cadence_rpm = chainring_rad_s * road->crank_share[at] * RPM_PER_RAD_S;
    const assist_input input = {
        .torque_raw_counts = (float)(rider_nm / (double)self->law->sensor_gain_nm_per_count +
                                     (double)self->law->sensor_offset_counts),
        .speed_kmh = (float)(self->speed_ms * KMH_PER_MS),
        .cadence_rpm = (float)cadence_rpm,
        .motor_speed_rpm = (float)(chainring_rad_s * RPM_PER_RAD_S * (double)self->law->gear_ratio),
        .battery_voltage_v = (float)self->voltage_v,
        .battery_current_a = (float)self->current_a,
        .motor_temperature_degc = (float)road->motor_degc[at],
        .controller_temperature_degc = (float)road->controller_degc[at],
        .sensor_temperature_degc = float32_missing(), /* as the counts were made of torque */
        .mode = road->mode[at],
        .brake = (uint8_t)brake,
    };
    (void)assist_step(self->law, &self->state, &input, output);
    return (double)output->motor_torque_nm;
}

/* What the battery gives for this step, and what that leaves of its voltage. */
static void supply(ride *self, double motor_nm, double motor_rad_s, double step_s)
{
    const twin_bike *bike = self->bike;
    const double pushing_w = motor_nm > 0.0 ? bike->loss_w_per_rad2 * motor_rad_s * motor_rad_s +
                                                  bike->power_share * motor_nm * motor_rad_s +
                                                  bike->loss_w_per_nm2 * motor_nm * motor_nm
                                            : 0.0;
    const double power_w = fmax(pushing_w, 0.0) + bike->idle_w;
    const double open_v = bike->open_v - bike->sag_v_per_j * self->totals->battery_j;
    self->current_a = power_w / fmax(self->voltage_v, 1.0);
    self->voltage_v = fmax(open_v - bike->resistance_ohm * self->current_a, 1.0);
    self->totals->battery_j += power_w * step_s;
}

static void move(ride *self, double force_n, double step_s)
{
    const double air_n = self->bike->air_n_s2_per_m2 * self->speed_ms * fabs(self->speed_ms);
    const double before_ms = self->speed_ms;
    self->speed_ms += (force_n - air_n) / self->bike->mass_kg * step_s;
    if (self->speed_ms < PUSHED_OFF_MS) {
        self->stalled_s += step_s;
        self->speed_ms = PUSHED_OFF_MS;
    } else if (self->speed_ms > CRAWLING_MS) {
        self->stalled_s = 0.0;
    }
    if (self->speed_ms < CRAWLING_MS) self->totals->crawling_s += step_s;
    self->distance_m += 0.5 * (before_ms + self->speed_ms) * step_s;
}

/* What a step on the way adds up to. */
static void count(ride *self, const assist_output *output, double step_s)
{
    twin_ride_totals *totals = self->totals;
    const double motor_nm = (double)output->motor_torque_nm;
    const double rise_nm_per_s = (motor_nm - self->motor_nm) / step_s;
    totals->moving_s += step_s;
    totals->ripple_nm2_per_s += rise_nm_per_s * rise_nm_per_s * step_s;
    for (unsigned bit = 0; output->limit_flags >> bit != 0; bit++) {
        if (output->limit_flags >> bit & 1u) totals->limit_s[bit] += step_s;
    }
}

static void step(ride *self, int standing, assist_output *output, double *rider_nm)
{
    const twin_road *road = self->road;
    const double step_s = (double)self->law->step_s;
    const size_t at = point_at(road, self->distance_m);
    const double reached_m = reach_m(self, at);
    const double chainring_rad_s = standing ? 0.0 : self->speed_ms / reached_m;
    const double motor_rad_s = chainring_rad_s * (double)self->law->gear_ratio;
    const int brakes = road->braking[at] || self->speed_ms > road->ceiling_ms[at] + CEILING_PLAY_MS;
    double motor_nm;
    *rider_nm = standing || brakes ? 0.0 : push_nm(self, at, reached_m);
    motor_nm = assist_nm(self, at, *rider_nm, chainring_rad_s, standing || brakes, output);
    supply(self, motor_nm, motor_rad_s, step_s);
    self->t_s += step_s;
    if (!standing) count(self, output, step_s);
    self->motor_nm = motor_nm;
    if (standing) return;
    self->totals->motor_work_j += motor_nm * motor_rad_s * step_s;
    self->totals->rider_work_j += *rider_nm * chainring_rad_s * step_s;
    move(self,
         self->bike->chain_efficiency *
                 (*rider_nm +
                  self->bike->gear_efficiency * (double)self->law->gear_ratio * motor_nm) /
                 reached_m -
             road->force_n[at],
         step_s);
    if (self->speed_ms > road->ceiling_ms[at]) {
        self->speed_ms = fmax(road->ceiling_ms[at], PUSHED_OFF_MS);
    }
}

/* Stands as long as the recorded ride did, the law at work beside it. */
static void stand(ride *self, double stand_s)
{
    const double step_s = (double)self->law->step_s;
    const double end_s = self->t_s + stand_s;
    assist_output output;
    double rider_nm;
    self->speed_ms = 0.0;
    for (size_t k = 0; k < MEMORY_STEPS && self->t_s + step_s <= end_s; k++) {
        step(self, 1, &output, &rider_nm);
    }
    self->totals->battery_j += self->bike->idle_w * fmax(end_s - self->t_s, 0.0);
    self->t_s = end_s;
    /* The wheel's first pulses come a little after it moved off: from there it goes on. */
    self->speed_ms =
        fmax(self->road->speed_ms[point_at(self->road, self->distance_m + 0.1)], PUSHED_OFF_MS);
}

/* A ride that begins on the way: the law remembers a road that nobody recorded. What lies ahead
 * stands for it, ridden out and back as recorded, so that its end fits the beginning. Of the minute
 * that a market's continuous power is the mean of this tells nothing. */
static void remember(ride *self)
{
    const twin_road *road = self->road;
    const double step_s = (double)self->law->step_s;
    assist_output output;
    for (int k = -MEMORY_STEPS; k < MEMORY_STEPS; k++) {
        const size_t at = point_at(road, self->distance_m);
        const double rider_nm = road->braking[at] ? 0.0 : road->rider_nm[at];
        const double speed_ms = fmax(road->speed_ms[at], PUSHED_OFF_MS);
        const double chainring_rad_s = speed_ms / road->reach_m[at];
        self->speed_ms = speed_ms;
        self->motor_nm = assist_nm(self, at, rider_nm, chainring_rad_s, road->braking[at], &output);
        supply(self, self->motor_nm, chainring_rad_s * (double)self->law->gear_ratio, step_s);
        self->distance_m = fmax(self->distance_m + (k < 0 ? speed_ms : -speed_ms) * step_s, 0.0);
    }
    self->distance_m = 0.0;
    self->totals->battery_j = 0.0;
}

void twin_ride(const twin_road *road, const twin_bike *bike, const twin_rider *rider,
               const assist_config *law, double longest_s, size_t sample_steps,
               twin_sample *samples, size_t capacity, twin_ride_totals *totals)
{
    const twin_ride_totals nothing = {0};
    ride self = {.road = road, .bike = bike, .rider = rider, .law = law, .totals = totals};
    const double end_m = (double)(road->count - 1) * road->spacing_m;
    *totals = nothing;
    self.voltage_v = bike->open_v;
    if (!(road->stand_s[0] > 0.0)) remember(&self);
    self.speed_ms = fmax(road->speed_ms[0], PUSHED_OFF_MS);
    self.stood_at = SIZE_MAX;
    for (size_t steps = 0; self.distance_m < end_m; steps++) {
        const size_t at = point_at(road, self.distance_m);
        assist_output output;
        double rider_nm;
        if (road->stand_s[at] > 0.0 && at != self.stood_at) {
            self.stood_at = at;
            stand(&self, road->stand_s[at]);
        }
        step(&self, 0, &output, &rider_nm);
        if (steps % sample_steps == 0 && totals->samples < capacity) {
            const twin_sample sample = {self.t_s,
                                        self.distance_m,
                                        self.speed_ms,
                                        rider_nm,
                                        (double)output.motor_torque_nm,
                                        output.limit_flags};
            samples[totals->samples++] = sample;
        }
        if (self.t_s > longest_s || self.stalled_s > STALLED_S) {
            totals->gave_up = 1;
            break;
        }
    }
    totals->duration_s = self.t_s + (totals->gave_up ? 0.0 : road->stand_s[road->count - 1]);
}
