#include "battery.h"

#include <math.h>
#include <stddef.h>

#define CELLS_IN_SERIES 10.0
#define S_PER_H 3600.0
#define REFERENCE_DEGC 20.0
#define EMPTY_SOC_PCT 15.0 /* below it the resistance doubles towards empty */

typedef struct {
    double soc_pct;
    double cell_v;
} charge_point;

/* Shape of an ordinary NMC cell at rest; 30 to 42 V for the pack as in thesis_checks 6. */
static const charge_point CHARGE_CURVE[] = {
    {0.0, 3.00}, {5.0, 3.30}, {10.0, 3.45}, {20.0, 3.55}, {50.0, 3.68}, {80.0, 3.98}, {100.0, 4.20},
};
#define CHARGE_POINTS (sizeof CHARGE_CURVE / sizeof CHARGE_CURVE[0])

double battery_open_circuit_v(double soc_pct)
{
    if (soc_pct <= CHARGE_CURVE[0].soc_pct) {
        return CELLS_IN_SERIES * CHARGE_CURVE[0].cell_v;
    }
    for (size_t k = 1; k < CHARGE_POINTS; k++) {
        const charge_point low = CHARGE_CURVE[k - 1];
        const charge_point high = CHARGE_CURVE[k];
        if (soc_pct <= high.soc_pct) {
            const double share = (soc_pct - low.soc_pct) / (high.soc_pct - low.soc_pct);
            return CELLS_IN_SERIES * (low.cell_v + share * (high.cell_v - low.cell_v));
        }
    }
    return CELLS_IN_SERIES * CHARGE_CURVE[CHARGE_POINTS - 1].cell_v;
}

double battery_resistance_ohm(const battery_config *config, double soc_pct)
{
    const double colder_k = fmax(REFERENCE_DEGC - config->temperature_degc, 0.0);
    const double emptier = fmax(EMPTY_SOC_PCT - soc_pct, 0.0) / EMPTY_SOC_PCT;
    return config->resistance_ohm * (1.0 + config->resistance_share_per_k_cold * colder_k) *
           (1.0 + emptier);
}

static battery_source source_of(const battery_config *config, const battery_state *state)
{
    const battery_source source = {
        .open_v = state->cut ? 0.0 : battery_open_circuit_v(state->soc_pct) - state->polarisation_v,
        .resistance_ohm = battery_resistance_ohm(config, state->soc_pct),
    };
    return source;
}

void battery_reset(const battery_config *config, battery_state *state)
{
    const battery_state rested = {
        .soc_pct = config->soc_pct_start,
        .voltage_v = battery_open_circuit_v(config->soc_pct_start),
    };
    *state = rested;
    state->source = source_of(config, state);
}

/* The management waits a moment: a spark is no reason to leave a rider without light. */
static void watch(const battery_config *config, battery_state *state, int fault_cut, double dt_s)
{
    const int out_of_bounds = state->voltage_v < config->cut_voltage_v_min ||
                              state->current_a > config->cut_current_a_max;
    state->over_s = out_of_bounds ? state->over_s + dt_s : 0.0;
    if (fault_cut || state->over_s > config->cut_after_s) {
        state->cut = 1;
    }
}

double battery_voltage_v(battery_source source, battery_load load)
{
    const double left_v = fmax(source.open_v - source.resistance_ohm * load.current_a, 0.0);
    /* U (E - U) / R = P; the larger root is the one a load settles at, and P is most at E/2. */
    const double root = left_v * left_v - 4.0 * source.resistance_ohm * fmax(load.power_w, 0.0);
    return 0.5 * (left_v + sqrt(fmax(root, 0.0)));
}

void battery_step(const battery_config *config, battery_state *state, battery_load load,
                  int fault_cut, double dt_s)
{
    if (state->cut) {
        state->voltage_v = 0.0;
        state->current_a = 0.0;
        state->polarisation_v -= state->polarisation_v * dt_s / config->polarisation_s;
        return;
    }
    const battery_source source = state->source;
    state->voltage_v = battery_voltage_v(source, load);
    state->current_a = (source.open_v - state->voltage_v) / source.resistance_ohm;
    const double settled_v = state->current_a * config->polarisation_ohm;
    state->polarisation_v += (settled_v - state->polarisation_v) * dt_s / config->polarisation_s;
    const double charge_ah = state->current_a * dt_s / S_PER_H;
    state->soc_pct = fmax(state->soc_pct - 100.0 * charge_ah / config->capacity_ah, 0.0);
    watch(config, state, fault_cut, dt_s);
    state->source = source_of(config, state);
}
