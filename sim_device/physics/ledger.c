#include "ledger.h"

#include <math.h>

double ledger_losses_j(const physics_ledger *ledger)
{
    return ledger->copper_j + ledger->switching_j + ledger->standby_j + ledger->motor_friction_j +
           ledger->gear_j + ledger->chain_j + ledger->clutch_j + ledger->legs_j +
           ledger->rolling_j + ledger->air_j + ledger->brake_j + ledger->dyno_j + ledger->slip_j;
}

double ledger_balance_error_pct(const physics_ledger *ledger, double stored_j)
{
    const double in_j = ledger->rider_work_j + ledger->motor_electric_j;
    if (in_j < 1.0) {
        return (double)NAN;
    }
    const double gained_j = stored_j - ledger->stored_start_j + ledger->potential_j;
    return 100.0 * fabs(in_j - gained_j - ledger_losses_j(ledger)) / in_j;
}
