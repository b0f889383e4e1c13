/* Values of the configuration by the ids of their parameters, as flash keeps them: so that a
 * firmware with other parameters finds what it knows.
 *
 * Item: id u16, count u8, bytes of an element u8, then the elements as in the image. */
#ifndef SPINDLE_CONFIG_ITEMS_H
#define SPINDLE_CONFIG_ITEMS_H

#include <stddef.h>
#include <stdint.h>

#include "ebl_registry.h" // EBL_PARAMETER_COUNT, ebl_config
#include "hal.h"          // hal

#define CONFIG_ITEM_HEAD_LENGTH 4

/* What became of an image that another firmware wrote. Parameters, but for `clamped`: values. */
typedef struct {
    uint8_t added;   /* not in it: they have their defaults */
    uint8_t dropped; /* of a parameter that this firmware does not have */
    uint8_t clamped; /* out of range here, or against a rule: the nearest that is allowed, or the
                        default */
    uint8_t market_unknown; /* it names a market that this firmware does not have */
    uint8_t found[(EBL_PARAMETER_COUNT + 7) / 8]; /* bit by bit, in the order of ebl_parameters */
} config_tally;

/* Reads the items in so many bytes of flash into the image; what they do not name stays as it is.
 * Negative where the flash cannot be read, or an item goes beyond the end. */
int config_items_read(const hal *board, size_t address, size_t length, uint8_t *image,
                      config_tally *tally);

/* How the readings of a sensor as drawn move with its temperature: what its maker knows of every
 * one before it is calibrated. */
void config_sensor_as_drawn(ebl_config *config);

/* Counts the parameters of these records (a bit each) that nothing was found of. What a factory
 * measured before there was a parameter for it is what the unit has had since. */
void config_items_account(uint8_t *image, config_tally *tally, uint8_t records);

/* Makes an image valid whose values are each in range but break a rule between them: those
 * get their defaults. False where that is not enough. */
int config_items_settle(uint8_t *image, config_tally *tally);

/* The parameters of these records get their defaults; a value around one that the factory measured
 * gets that, if it is not lost too. */
void config_items_default(uint8_t *image, uint8_t records);

#endif
