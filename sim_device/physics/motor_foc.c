#include "motor_foc.h"

#include <math.h>

#define PI 3.14159265358979323846
#define SQRT_3 1.73205080756887729353
#define LOOP_S 50e-6

rotor_values motor_foc_to_rotor(phase_values phases, double electric_angle_rad)
{
    const double alpha = (2.0 * phases.a - phases.b - phases.c) / 3.0;
    const double beta = (phases.b - phases.c) / SQRT_3;
    const double cosine = cos(electric_angle_rad);
    const double sine = sin(electric_angle_rad);
    const rotor_values rotor = {alpha * cosine + beta * sine, beta * cosine - alpha * sine};
    return rotor;
}

phase_values motor_foc_to_phases(rotor_values rotor, double electric_angle_rad)
{
    const double cosine = cos(electric_angle_rad);
    const double sine = sin(electric_angle_rad);
    const double alpha = rotor.d * cosine - rotor.q * sine;
    const double beta = rotor.d * sine + rotor.q * cosine;
    const phase_values phases = {alpha, 0.5 * (SQRT_3 * beta - alpha),
                                 -0.5 * (SQRT_3 * beta + alpha)};
    return phases;
}

/* The machine's constants as a sinusoidal inverter sees them. */
typedef struct {
    double torque_nm_per_a; /* of q current */
    double flux_v_s;        /* per mechanical rad/s */
    double resistance_ohm;
    double inductance_h;
    double voltage_v_max;
    double electric_rad_s;
} machine;

static machine machine_of(const motor_config *config, double speed_rad_s, double voltage_v,
                          double winding_degc)
{
    const machine seen = {
        .torque_nm_per_a = 0.5 * SQRT_3 * config->torque_constant_nm_per_a,
        .flux_v_s = config->torque_constant_nm_per_a / SQRT_3,
        .resistance_ohm = 0.5 * motor_resistance_ohm(config, winding_degc),
        .inductance_h = config->inductance_h,
        .voltage_v_max = voltage_v / SQRT_3,
        .electric_rad_s = config->pole_pairs * speed_rad_s,
    };
    return seen;
}

/* PI with the cross-coupling and the back-EMF fed forward; an integral that waits while the
 * inverter is at its circle. Zero of the PI on the pole of the winding. */
static rotor_values controlled_v(const motor_config *config, motor_foc_state *state,
                                 const machine *seen, double speed_rad_s, rotor_values measured_a,
                                 double wanted_q_a)
{
    const double bandwidth = 2.0 * PI * config->current_bandwidth_hz;
    const double p = bandwidth * seen->inductance_h;
    const double i = bandwidth * seen->resistance_ohm;
    const double coupling_ohm = seen->electric_rad_s * seen->inductance_h;
    const rotor_values error = {-measured_a.d, wanted_q_a - measured_a.q};
    rotor_values v = {
        p * error.d + state->integral_v.d - coupling_ohm * measured_a.q,
        p * error.q + state->integral_v.q + coupling_ohm * measured_a.d +
            seen->flux_v_s * speed_rad_s,
    };
    const double length_v = hypot(v.d, v.q);
    if (length_v > seen->voltage_v_max) {
        v.d *= seen->voltage_v_max / length_v;
        v.q *= seen->voltage_v_max / length_v;
    } else {
        state->integral_v.d += i * error.d * LOOP_S;
        state->integral_v.q += i * error.q * LOOP_S;
    }
    return v;
}

/* One period: the currents move by the trapezoidal rule, so that the energy of resistance, rotation
 * and field adds up to what the inverter gave. */
static void winding_step(motor_foc_state *state, const machine *seen, double speed_rad_s,
                         rotor_values v, rotor_values *mean_a)
{
    const double stiffness = 2.0 * seen->inductance_h / LOOP_S;
    const double diagonal = stiffness + seen->resistance_ohm;
    const double coupling_ohm = seen->electric_rad_s * seen->inductance_h;
    /* (2L/dt)(m - i0) + R m -+ wL m = v - e, solved for the mean current m. */
    const double right_d = v.d + stiffness * state->current_a.d;
    const double right_q = v.q - seen->flux_v_s * speed_rad_s + stiffness * state->current_a.q;
    const double determinant = diagonal * diagonal + coupling_ohm * coupling_ohm;
    mean_a->d = (diagonal * right_d + coupling_ohm * right_q) / determinant;
    mean_a->q = (diagonal * right_q - coupling_ohm * right_d) / determinant;
    state->current_a.d = 2.0 * mean_a->d - state->current_a.d;
    state->current_a.q = 2.0 * mean_a->q - state->current_a.q;
}

/* One period of an open bridge: the diodes hold the whole circle against the currents until they
 * have gone out, and let none begin the other way. */
static void winding_let_go(motor_foc_state *state, const machine *seen, double speed_rad_s,
                           rotor_values *mean_a)
{
    const rotor_values before_a = state->current_a;
    const double length_a = hypot(before_a.d, before_a.q);
    const rotor_values nothing = {0.0, 0.0};
    *mean_a = nothing;
    state->integral_v = nothing;
    if (length_a == 0.0) {
        return;
    }
    const double share = -seen->voltage_v_max / length_a;
    const rotor_values v = {share * before_a.d, share * before_a.q};
    winding_step(state, seen, speed_rad_s, v, mean_a);
    if (state->current_a.d * before_a.d + state->current_a.q * before_a.q <= 0.0) {
        state->current_a = nothing;
        mean_a->d = 0.5 * before_a.d;
        mean_a->q = 0.5 * before_a.q;
    }
}

static double field_j(const machine *seen, rotor_values current_a)
{
    const double squared = current_a.d * current_a.d + current_a.q * current_a.q;
    return 0.75 * seen->inductance_h * squared;
}

motor_drive motor_foc_drive(const motor_config *config, motor_foc_state *state, double demand_nm,
                            motor_rotor rotor, battery_source source, double winding_degc,
                            double dt_s)
{
    const motor_drive average = motor_drive_at(config, demand_nm, rotor, source, winding_degc);
    const double speed_rad_s = rotor.speed_rad_s;
    const double taken_w = average.electromagnetic_torque_nm * speed_rad_s + average.copper_loss_w;
    const battery_load load = {taken_w, average.beside_a};
    const double voltage_v = battery_voltage_v(source, load);
    const machine seen = machine_of(config, speed_rad_s, voltage_v, winding_degc);
    const double wanted_q_a = average.electromagnetic_torque_nm / seen.torque_nm_per_a;
    const int open = wanted_q_a <= 0.0;
    const int periods = (int)lround(dt_s / LOOP_S);
    const double field_before_j = field_j(&seen, state->current_a);
    double q_sum_a = 0.0;
    double copper_w = 0.0;
    for (int k = 0; k < periods; k++) {
        rotor_values mean_a;
        if (open) {
            winding_let_go(state, &seen, speed_rad_s, &mean_a);
        } else {
            const rotor_values measured_a =
                motor_foc_to_rotor(state->phase_current_a, state->electric_angle_rad);
            const rotor_values v =
                controlled_v(config, state, &seen, speed_rad_s, measured_a, wanted_q_a);
            winding_step(state, &seen, speed_rad_s, v, &mean_a);
        }
        state->electric_angle_rad =
            fmod(state->electric_angle_rad + seen.electric_rad_s * LOOP_S, 2.0 * PI);
        state->phase_current_a = motor_foc_to_phases(state->current_a, state->electric_angle_rad);
        q_sum_a += mean_a.q;
        copper_w += 1.5 * seen.resistance_ohm * (mean_a.d * mean_a.d + mean_a.q * mean_a.q);
    }
    motor_drive drive = average;
    drive.electromagnetic_torque_nm = seen.torque_nm_per_a * q_sum_a / periods;
    drive.shaft_torque_nm = drive.electromagnetic_torque_nm - drive.friction_torque_nm;
    drive.current_a = drive.electromagnetic_torque_nm / config->torque_constant_nm_per_a;
    drive.copper_loss_w = copper_w / periods;
    drive.beside_a += config->switching_share * (drive.current_a - average.current_a);
    drive.magnetic_w = (field_j(&seen, state->current_a) - field_before_j) / dt_s;
    return drive;
}
