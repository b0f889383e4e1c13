/* Values against the registry: telemetry counts, and what is wrong with a configuration. */
#ifndef SPINDLE_EBL_VALUES_H
#define SPINDLE_EBL_VALUES_H

#include <stddef.h>
#include <stdint.h>

#include "ebl_registry.h" // ebl_config

/* The count of a value: rounded to nearest, clamped to +-32767; not finite gives EBL_MISSING. */
int16_t ebl_channel_counts(float scale, float value);

/* An element's number, of any type but text. A u32 is rounded. */
float ebl_element_number(const ebl_parameter *parameter, const uint8_t *element);

/* True if an element may stand alone: a text, a number in range, or none where that is a value. */
int ebl_element_is_allowed(const ebl_parameter *parameter, const uint8_t *element);

typedef struct {
    uint16_t id;
    uint8_t index; /* element of the parameter, in the order of the image */
    uint8_t code;  /* ebl_violation */
} ebl_refusal;

/* Everything that is wrong with an image of EBL_IMAGE_LENGTH bytes: parameters in the order of
 * their ids, at most one refusal for an element, then the rules between parameters. Fills up to
 * `capacity` and returns how many there are in all. */
size_t ebl_image_violations(const uint8_t *image, ebl_refusal *found, size_t capacity);
/* True if the banded value of an image is within its band. Not so for one that is no number. */
int ebl_band_holds(const ebl_band *band, const uint8_t *image);

size_t ebl_config_violations(const ebl_config *config, ebl_refusal *found, size_t capacity);

#endif
