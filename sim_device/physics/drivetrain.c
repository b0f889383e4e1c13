#include "drivetrain.h"

double drivetrain_chain_ratio(const drivetrain_config *config)
{
    return config->chainring_teeth / config->cog_teeth;
}

double drivetrain_gear_share(const drivetrain_config *config)
{
    return config->literal_4_14 ? 1.0 : config->gear_efficiency;
}

double drivetrain_chain_share(const drivetrain_config *config)
{
    return config->literal_4_14 ? drivetrain_chain_ratio(config) : config->chain_efficiency;
}

static double acceleration(const drivetrain_config *config, const drivetrain_load *load,
                           const drivetrain_flow *flow)
{
    const double ratio = config->gear_ratio;
    const double chain_share = drivetrain_chain_share(config);
    const double gear_share = drivetrain_gear_share(config) * chain_share;
    double inertia = load->bike_inertia_kg_m2;
    double net_nm = -load->pull_nm;
    if (flow->crank_engaged) {
        inertia += chain_share * config->crank_inertia_kg_m2;
        net_nm += chain_share * load->crank_nm;
    }
    if (flow->motor_engaged) {
        inertia += gear_share * ratio * ratio * load->motor_inertia_kg_m2;
        net_nm += gear_share * ratio * load->motor_shaft_nm;
    }
    const int driven = flow->crank_engaged || flow->motor_engaged;
    const double friction_nm = load->friction_nm + (driven ? config->chain_drag_nm : 0.0);
    if (!load->moving && net_nm <= friction_nm) {
        return 0.0;
    }
    return (net_nm - friction_nm) / inertia;
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

double drivetrain_wheel_nm(const drivetrain_config *config, const drivetrain_flow *flow)
{
    const double chain_nm = flow->crank_nm + drivetrain_gear_share(config) * flow->motor_nm;
    const int driven = flow->crank_engaged || flow->motor_engaged;
    return drivetrain_chain_share(config) * chain_nm - (driven ? config->chain_drag_nm : 0.0);
}
