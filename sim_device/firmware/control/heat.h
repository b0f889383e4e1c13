/* Temperatures between which the assist is lowered; at the hot end it is zero and a fault. */
#ifndef SPINDLE_HEAT_H
#define SPINDLE_HEAT_H

/* Winding: thesis_checks 6 (110 to 130 degC; class B insulation). Controller: the chip's 105 degC
 * with a margin for where the sensor sits; the gearbox's POM softens at 90. */
#define HEAT_MOTOR_WARM_DEGC 110.0f
#define HEAT_MOTOR_HOT_DEGC 130.0f
#define HEAT_CONTROLLER_WARM_DEGC 85.0f
#define HEAT_CONTROLLER_HOT_DEGC 100.0f

#endif
