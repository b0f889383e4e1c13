/* The battery: an open-circuit voltage that falls with the charge, behind a resistance. */
#ifndef SPINDLE_BATTERY_H
#define SPINDLE_BATTERY_H

typedef struct {
    double capacity_ah;
    double resistance_ohm;
    double soc_pct_start;
} battery_config;

typedef struct {
    double soc_pct;
    double voltage_v; /* at the terminals, under load */
    double current_a; /* out of the battery, never negative: the drive cannot regenerate */
} battery_state;

void battery_reset(const battery_config *config, battery_state *state);

/* Open-circuit voltage of ten lithium-ion cells in series. */
double battery_open_circuit_v(double soc_pct);

/* Delivers `power_w` at the terminals for `dt_s`; more than the cells can give is cut to their
 * maximum. */
void battery_step(const battery_config *config, battery_state *state, double power_w, double dt_s);

#endif
