/* What the firmware's sensors see of the physics. */
#ifndef SPINDLE_UNIT_SENSES_H
#define SPINDLE_UNIT_SENSES_H

#include "hal.h"            // hal_inputs
#include "physics.h"        // physics_state
#include "rotor_receiver.h" // rotor_receiver

/* The coefficients that a sensor as drawn has; what a specimen has differs. */
rotor_calibration senses_rotor_calibration(void);

/* Gives the receiver the exchange of the physics step that has just ended, if there was one. */
void senses_rotor_exchange(const physics_state *state, rotor_receiver *receiver);

/* Everything but buttons: those are the rider's. */
void senses_read(const physics_state *state, const physics_command *command,
                 const rotor_receiver *receiver, uint64_t now_us, hal_inputs *inputs);

#endif
