/* The motor with its inverter: what torque it can give, what that costs, how warm it gets.
 *
 * Thesis eq. 4.8 and 4.9 with the constants of thesis_checks I-5. The demand is torque at the shaft
 * (T_f of eq. 4.9): the inverter's inner loop makes up for the motor's own friction. */
#ifndef SPINDLE_MOTOR_H
#define SPINDLE_MOTOR_H

typedef struct {
    double torque_constant_nm_per_a;
    double resistance_ohm; /* winding, bridge and lead */
    double friction_nm_s;  /* torque per rad/s */
    double inertia_kg_m2;
    double torque_nm_max;
    double speed_rpm_max;
    double bus_current_a_max;
    double bus_power_w_max;
    double heat_capacity_j_per_k;
    double heat_resistance_k_per_w;
    double ambient_degc;
} motor_config;

typedef struct {
    double electromagnetic_torque_nm;
    double friction_torque_nm;
    double shaft_torque_nm; /* electromagnetic less friction; negative while it spins down */
    double current_a;
    double copper_loss_w;
} motor_drive;

/* What the motor gives at `speed_rad_s` from a battery at `voltage_v` when asked for `demand_nm`.
 * Never brakes: a demand of zero or less switches the bridge off. */
motor_drive motor_drive_at(const motor_config *config, double demand_nm, double speed_rad_s,
                           double voltage_v);

/* Winding temperature after `dt_s` at `heat_w`: one thermal mass to ambient. */
double motor_temperature_after(const motor_config *config, double temperature_degc, double heat_w,
                               double dt_s);

#endif
