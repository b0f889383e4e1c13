/* The same motor in detail: three phase currents, Clarke, Park and two PI loops (thesis 4.6.2).
 *
 * Amplitude-invariant transforms. The machine is the one of motor.h seen from a sinusoidal inverter
 * that reaches bus/sqrt(3): flux linkage K/sqrt(3) per mechanical rad/s, phase resistance R/2. In a
 * steady state without saturation both models then give the same torque for the same power. */
#ifndef SPINDLE_MOTOR_FOC_H
#define SPINDLE_MOTOR_FOC_H

#include "motor.h" // motor_config

typedef struct {
    double a;
    double b;
    double c;
} phase_values;

typedef struct {
    double d;
    double q;
} rotor_values;

typedef struct {
    double electric_angle_rad;
    rotor_values current_a;
    rotor_values integral_v;
    phase_values phase_current_a; /* at the end of the last step */
} motor_foc_state;

/* Three phases to the frame that turns with the rotor, and back (Clarke and Park). */
rotor_values motor_foc_to_rotor(phase_values phases, double electric_angle_rad);
phase_values motor_foc_to_phases(rotor_values rotor, double electric_angle_rad);

/* `dt_s` of the current loop at 20 kHz around a rotor at its speed: what motor_drive_at says on
 * average, but with the currents' own inertia and the inverter's voltage circle, whose size is the
 * terminals' voltage under that average load. Where the average gives nothing the bridge is open:
 * the currents go out within 0.2 ms and none brakes. */
motor_drive motor_foc_drive(const motor_config *config, motor_foc_state *state, double demand_nm,
                            motor_rotor rotor, battery_source source, double winding_degc,
                            double dt_s);

#endif
