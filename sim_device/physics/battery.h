/* The battery: an open-circuit voltage that falls with the charge, behind a resistance and a slower
 * polarisation, watched by its own management (thesis_checks 6). */
#ifndef SPINDLE_BATTERY_H
#define SPINDLE_BATTERY_H

typedef struct {
    double capacity_ah;
    double resistance_ohm;              /* at 20 degrees */
    double polarisation_ohm;            /* of the RC pair */
    double polarisation_s;              /* its time constant */
    double resistance_share_per_k_cold; /* more for every degree below 20 */
    double soc_pct_start;
    double temperature_degc;
    double cut_voltage_v_min; /* the management opens below it */
    double cut_current_a_max; /* and above it */
    double cut_after_s;       /* when either lasts so long */
} battery_config;

/* What a load meets at the terminals: a voltage behind a resistance. */
typedef struct {
    double open_v; /* without load; 0 once the management has cut */
    double resistance_ohm;
} battery_source;

typedef struct {
    double soc_pct;
    double voltage_v;      /* at the terminals, under load; 0 while the management has cut */
    double current_a;      /* out of the battery, never negative: the drive cannot regenerate */
    double polarisation_v; /* of the RC pair */
    battery_source source; /* what the next load meets */
    double over_s;         /* how long voltage or current has been out of bounds */
    int cut;               /* 1: opened by its management, for good */
} battery_state;

void battery_reset(const battery_config *config, battery_state *state);

/* Open-circuit voltage of ten lithium-ion cells in series. */
double battery_open_circuit_v(double soc_pct);

/* Ohmic resistance now: colder and emptier is more. */
double battery_resistance_ohm(const battery_config *config, double soc_pct);

/* What is taken at the terminals: a power, and a current at whatever voltage. */
typedef struct {
    double power_w;
    double current_a;
} battery_load;

/* The terminals under `load`: half of what its current leaves and no less, where the cells have no
 * more power to give. */
double battery_voltage_v(battery_source source, battery_load load);

/* Delivers `load` at the terminals for `dt_s`; what is more than the cells can give for a moment
 * the capacitor of the inverter has. `fault_cut` makes the management open its switch. */
void battery_step(const battery_config *config, battery_state *state, battery_load load,
                  int fault_cut, double dt_s);

#endif
