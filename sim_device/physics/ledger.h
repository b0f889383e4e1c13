/* The energy books of a run: what rider and battery put in, and where all of it went. */
#ifndef SPINDLE_LEDGER_H
#define SPINDLE_LEDGER_H

/* Joules since the books were opened. */
typedef struct {
    double rider_work_j;
    double motor_electric_j; /* from the battery's terminals */
    double stored_start_j;   /* kinetic energy and field, then */
    double potential_j;
    double copper_j; /* winding and bridge */
    double switching_j;
    double standby_j;
    double motor_friction_j;
    double gear_j;
    double chain_j;
    double clutch_j;
    double legs_j;
    double rolling_j;
    double air_j;
    double brake_j;
    double dyno_j;
    double slip_j; /* tyre on the road */
} physics_ledger;

/* All that became heat. */
double ledger_losses_j(const physics_ledger *ledger);

/* |work in - change of stored and potential energy - losses| over work in; NaN below a joule. */
double ledger_balance_error_pct(const physics_ledger *ledger, double stored_j);

#endif
