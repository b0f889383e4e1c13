/* The motor with its inverter: what torque it can give and what that costs.
 *
 * Thesis eq. 4.8 and 4.9 with the constants of thesis_checks I-5. The demand is torque at the shaft
 * (T_f of eq. 4.9): the inverter's inner loop makes up for the motor's own friction. The currents
 * are those of the equivalent direct-current machine; motor_foc.h has the same machine in d and q.
 *
 * Motor and battery are solved together. The inverter takes at the terminals what the winding gets,
 * U i = V I with V = K w + R I, and V is at most U = E - R_b i. At full duty V is U and i is I:
 * I = (E - K w) / (R + R_b), and less with what the electronics take beside it. A free rotor's w is
 * that of the step's end, which the torque makes. So no value of an earlier step bounds this one,
 * and nothing can swing from step to step. */
#ifndef SPINDLE_MOTOR_H
#define SPINDLE_MOTOR_H

#include "battery.h" // battery_source

typedef enum { MOTOR_AVERAGE = 0, MOTOR_FOC = 1 } motor_model;

typedef struct {
    int model; /* motor_model */
    double torque_constant_nm_per_a;
    double resistance_ohm;         /* winding, bridge and lead at 20 degrees */
    double winding_share;          /* of the resistance and its heat; the rest is the bridge */
    double resistance_share_per_k; /* copper: 0.00393 */
    double friction_nm_s;          /* bearings, air and eddy currents: torque per rad/s */
    double hysteresis_nm;          /* iron: the same torque at every speed */
    double inertia_kg_m2;
    double torque_nm_max;
    double speed_rpm_max;        /* its regulator takes the torque back over the last 100 r/min */
    double inductance_h;         /* of a phase; detailed model only */
    double pole_pairs;           /* detailed model only */
    double current_bandwidth_hz; /* of the current loop; detailed model only */
    double winding_heat_j_per_k;
    double housing_heat_j_per_k;
    double winding_k_per_w; /* winding to housing */
    double housing_k_per_w; /* housing to air */
    double bridge_heat_j_per_k;
    double bridge_k_per_w;
    double switching_share;   /* of the phase current more from the battery: what the bridge's
                                 switching takes is proportional to voltage and current */
    double standby_current_a; /* of the unit's own electronics, while there is voltage */
    double ambient_degc;
} motor_config;

typedef struct {
    double electromagnetic_torque_nm;
    double friction_torque_nm;
    double shaft_torque_nm; /* electromagnetic less friction; negative while it spins down */
    double current_a;
    double copper_loss_w; /* winding and bridge */
    double magnetic_w;    /* into the field of the windings; 0 on average */
    double beside_a;      /* from the battery beside the winding's power: switching, standby */
} motor_drive;

/* The rotor when a step begins. */
typedef struct {
    double speed_rad_s;
    double gain_rad_s_per_nm; /* of it by the step's end: dt/J of a free one, 0 where the bike hangs
                                 on it */
} motor_rotor;

typedef struct {
    double winding_degc;
    double housing_degc;
    double bridge_degc;
} motor_heat;

/* Resistance with a winding at `winding_degc`. */
double motor_resistance_ohm(const motor_config *config, double winding_degc);

/* Largest electromagnetic torque that `source` can drive against back-EMF and speed regulator. A
 * bridge knows no limit of the battery's power: that one the firmware holds (battery_power.c). */
double motor_torque_limit_nm(const motor_config *config, motor_rotor rotor, battery_source source,
                             double winding_degc);

/* What the motor gives on `source` when asked for `demand_nm`. Never brakes: a demand of zero or
 * less switches the bridge off. */
motor_drive motor_drive_at(const motor_config *config, double demand_nm, motor_rotor rotor,
                           battery_source source, double winding_degc);

void motor_heat_reset(const motor_config *config, motor_heat *heat);

/* Temperatures after `dt_s`: copper warms the winding, friction and iron the housing; its share of
 * the resistance and `switching_w` the bridge (two nodes of thesis_checks 6, and one for the
 * controller). */
void motor_heat_step(const motor_config *config, motor_heat *heat, double copper_w,
                     double friction_w, double switching_w, double dt_s);

#endif
