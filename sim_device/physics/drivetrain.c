#include "drivetrain.h"

double drivetrain_chain_ratio(const drivetrain_config *config)
{
    return config->chainring_teeth / config->cog_teeth;
}

static double acceleration(const drivetrain_config *config, const drivetrain_load *load,
                           const drivetrain_flow *flow)
{
    const double ratio = config->gear_ratio;
    const double gear_share = config->gear_efficiency * config->chain_efficiency;
    double inertia = load->bike_inertia_kg_m2;
    double net_nm = -load->pull_nm;
    if (flow->crank_engaged) {
        inertia += config->chain_efficiency * config->crank_inertia_kg_m2;
        net_nm += config->chain_efficiency * load->crank_nm;
    }
    if (flow->motor_engaged) {
        inertia += gear_share * ratio * ratio * load->motor_inertia_kg_m2;
        net_nm += gear_share * ratio * load->motor_shaft_nm;
    }
    if (!load->moving && net_nm <= load->friction_nm) {
        return 0.0;
    }
    return (net_nm - load->friction_nm) / inertia;
}

drivetrain_flow drivetrain_solve(const drivetrain_config *config, const drivetrain_load *load)
{
    const double ratio = config->gear_ratio;
    drivetrain_flow flow = {0};
    flow.crank_engaged = load->crank_engaged;
    flow.motor_engaged = load->motor_engaged;
    /* Each round opens at least one of the two clutches or is the last. */
    for (int round = 0; round < 3; round++) {
        flow.acceleration_rad_s2 = acceleration(config, load, &flow);
        const double alpha = flow.acceleration_rad_s2;
        flow.crank_nm = load->crank_nm - config->crank_inertia_kg_m2 * alpha;
        flow.motor_nm = ratio * (load->motor_shaft_nm - load->motor_inertia_kg_m2 * ratio * alpha);
        const int crank_opens = flow.crank_engaged && flow.crank_nm < 0.0;
        const int motor_opens = flow.motor_engaged && flow.motor_nm < 0.0;
        flow.crank_engaged = flow.crank_engaged && !crank_opens;
        flow.motor_engaged = flow.motor_engaged && !motor_opens;
        if (!crank_opens && !motor_opens) {
            break;
        }
    }
    flow.crank_nm = flow.crank_engaged ? flow.crank_nm : 0.0;
    flow.motor_nm = flow.motor_engaged ? flow.motor_nm : 0.0;
    return flow;
}
