/* What the firmware's sensors see of the physics. */
#ifndef SPINDLE_UNIT_SENSES_H
#define SPINDLE_UNIT_SENSES_H

#include "hal.h"            // hal_inputs
#include "physics.h"        // physics_state
#include "rotor_receiver.h" // rotor_receiver

/* Gives the receiver the exchange of the physics step that has just ended, if there was one. */
void senses_rotor_exchange(const physics_state *state, rotor_receiver *receiver);

/* The amplifiers of voltage and currents: converted many times in a control step, read once, as
 * the mean. */
typedef struct {
    double battery_voltage_v;
    double battery_current_a;
    double motor_current_a;
} electric_values;

typedef struct {
    electric_values mean; /* of the last whole control step */
    electric_values sum;
    uint32_t conversions;
} electric_meter;

/* A meter that has been reading what there is now. */
void senses_meter_reset(electric_meter *meter, const physics_state *state);
void senses_meter_convert(electric_meter *meter, const physics_state *state);
void senses_meter_end_step(electric_meter *meter);

/* Everything but buttons: those are the rider's. */
void senses_read(const physics_state *state, const physics_command *command,
                 const rotor_receiver *receiver, const electric_meter *meter, uint64_t now_us,
                 hal_inputs *inputs);

#endif
