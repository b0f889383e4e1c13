/* What holds the bike back: a road with grade, tyres and air, or the bench's dynamometer. */
#ifndef SPINDLE_ROAD_H
#define SPINDLE_ROAD_H

typedef enum { LOAD_ROAD = 0, LOAD_DYNO = 1 } load_source;

/* How the dynamometer's torque is said to reach the cranks (thesis_checks I-9). */
typedef enum {
    DYNO_PHYSICAL = 0, /* by energy: chain ratio times the load */
    DYNO_THESIS = 1    /* eq. 5.1 as printed: the load over the chain ratio */
} dyno_convention;

typedef struct {
    int source;                 /* load_source */
    double mass_kg;             /* bike and rider */
    double wheel_inertia_kg_m2; /* both wheels */
    double wheel_radius_m;
    double rolling_coefficient;
    double drag_area_m2; /* C_w S */
    double air_density_kg_m3;
    double gravity_m_s2;
    double brake_force_n; /* of a pulled lever; both wheels, and no more than their tyres hold */
    int dyno_convention;  /* dyno_convention */
    double dyno_roller_radius_m;
    double flywheel_kg_m2; /* the bench's, on the roller's shaft */
    double rollers_kg_m2;
    double dyno_mass_kg;       /* more of it, as a mass at the tyre */
    double roller_coefficient; /* rubber on the rollers */
    double grip;               /* tyre on the road; 0: never slips */
    double rear_wheel_share;   /* of the weight */
} road_config;

typedef struct {
    double grade_deg; /* on the bench: the lift, and the load that eq. 4.3 gives it */
    double wind_ms;   /* headwind positive */
    double dyno_nm;   /* at the roller */
    int brake;
    int held; /* the wheel is in a clamp */
} road_command;

typedef struct {
    double grade_n;   /* pulls back uphill, forward downhill */
    double air_n;     /* against the motion relative to the air */
    double rolling_n; /* friction: never more than what it opposes */
    double brake_n;   /* friction */
    double dyno_n;    /* friction */
} road_forces;

/* Forces at the tyre at `speed_ms` (thesis eq. 4.2 to 4.4, with the wind's sign of I-25).
 * `chain_ratio` and `chain_efficiency` matter to the printed dynamometer convention only. */
road_forces road_forces_at(const road_config *config, const road_command *command, double speed_ms,
                           double chain_ratio, double chain_efficiency);

/* What has to be accelerated along the road, wheels included (thesis eq. 4.5). */
double road_moving_mass_kg(const road_config *config);

/* The part of it that is the rear wheel. */
double road_rear_wheel_mass_kg(const road_config *config);

/* Most the rear tyre can push with at this slope; infinite where it never slips. */
double road_grip_n(const road_config *config, const road_command *command);

#endif
