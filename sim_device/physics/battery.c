#include "battery.h"

#include <math.h>
#include <stddef.h>

#define CELLS_IN_SERIES 10.0
#define S_PER_H 3600.0

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

void battery_reset(const battery_config *config, battery_state *state)
{
    state->soc_pct = config->soc_pct_start;
    state->voltage_v = battery_open_circuit_v(state->soc_pct);
    state->current_a = 0.0;
}

void battery_step(const battery_config *config, battery_state *state, double power_w, double dt_s)
{
    const double open_v = battery_open_circuit_v(state->soc_pct);
    /* P = (U - iR)i has its maximum at i = U/2R; the smaller root is the one a load settles at. */
    const double root = fmax(open_v * open_v - 4.0 * config->resistance_ohm * power_w, 0.0);
    state->current_a = (open_v - sqrt(root)) / (2.0 * config->resistance_ohm);
    state->voltage_v = open_v - state->current_a * config->resistance_ohm;
    const double charge_ah = state->current_a * dt_s / S_PER_H;
    state->soc_pct = fmax(state->soc_pct - 100.0 * charge_ah / config->capacity_ah, 0.0);
}
