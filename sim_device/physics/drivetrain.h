/* Cranks and motor on one chainring, each behind a one-way clutch (thesis_checks I-29).
 *
 * Everything is referred to the chainring. A clutch passes torque forwards only: a crank that turns
 * slower than the chainring, or backwards, is free, and so is the motor; the bike can never turn
 * either of them, which is why nothing is regenerated. */
#ifndef SPINDLE_DRIVETRAIN_H
#define SPINDLE_DRIVETRAIN_H

typedef struct {
    double gear_ratio; /* motor turns per chainring turn */
    double chainring_teeth;
    double cog_teeth; /* without a cassette (gears.h) */
    double gear_efficiency;
    double gear_drag_nm; /* at the motor's shaft whenever it turns, whatever the load */
    double chain_efficiency;
    double chain_drag_nm;       /* at the chainring while it is driven */
    double crank_inertia_kg_m2; /* cranks and pedals, without the legs */
    int literal_4_14;           /* eq. 4.14 as printed: i_1 times the power put in (I-11) */
} drivetrain_config;

/* What acts on the chainring in one instant. */
typedef struct {
    double bike_inertia_kg_m2;
    double pull_nm;        /* grade and air; negative pushes forward */
    double friction_nm;    /* never moves anything by itself */
    double crank_nm;       /* on the cranks */
    double motor_shaft_nm; /* at the motor's shaft */
    double motor_inertia_kg_m2;
    int moving;
    int crank_engaged; /* as fast as the chainring */
    int motor_engaged;
} drivetrain_load;

typedef struct {
    double acceleration_rad_s2; /* of the chainring */
    double crank_nm;            /* passed from the cranks to the chainring, never negative */
    double motor_nm; /* passed from the motor, referred to the chainring, before losses */
    int crank_engaged;
    int motor_engaged;
} drivetrain_flow;

/* Wheel turns per crank turn, without a cassette. */
double drivetrain_chain_ratio(const drivetrain_config *config);

/* Share of the torque that leaves the gears, and the chain. Eq. 4.14 as printed knows no losses and
 * drops the division by the chain's ratio. */
double drivetrain_gear_share(const drivetrain_config *config);
double drivetrain_chain_share(const drivetrain_config *config);

/* Acceleration and transmitted torques: the energy-consistent equation of thesis_checks I-11 with
 * both efficiencies on the drive terms. A clutch that would have to pull opens. A standing bike
 * stays put until the drive beats its friction, and is never pulled backwards: a foot is down. */
drivetrain_flow drivetrain_solve(const drivetrain_config *config, const drivetrain_load *load);

/* What drives the rear wheel, referred to the chainring, after all losses. */
double drivetrain_wheel_nm(const drivetrain_config *config, const drivetrain_flow *flow);

#endif
