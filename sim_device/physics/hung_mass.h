/* A mass hung on a pedal of a bike on a workbench: wheel held, cranks at an angle.
 *
 * Torque: thesis eq. 3.22, m g l cos(angle). A mass that was just hung swings as a pendulum below
 * the pedal; its pull then turns and changes, and the torque with it, until it hangs still. */
#ifndef SPINDLE_HUNG_MASS_H
#define SPINDLE_HUNG_MASS_H

typedef enum { PEDAL_LEFT = 0, PEDAL_RIGHT = 1 } pedal_side;

typedef struct {
    int side;               /* pedal_side */
    double mass_kg;         /* in truth, hook included; 0: the pedal is free */
    double arm_m;           /* in truth */
    double crank_angle_rad; /* of this pedal: 0 level and forward, positive on its way down */
    double swing_rad;       /* amplitude in the plane of the crank when it was let go */
    double swing_phase_rad;
} hung_mass;

typedef struct {
    double torque_nm;  /* forwards at the spindle */
    double bending_nm; /* of the spindle, by the pedal's lever outside its bearing */
} hung_load;

/* Its angle in the physics, whose 0 has the left crank up. */
double hung_mass_crank_rad(const hung_mass *hung);

/* What it does `age_s` after it was hung. lever_m: from the bearing out to the pedal's middle. */
hung_load hung_mass_load(const hung_mass *hung, double gravity_m_s2, double lever_m, double age_s);

#endif
