/* An image of the configuration: the values of all parameters, in the order of their ids. */
#ifndef SPINDLE_CONFIG_IMAGE_H
#define SPINDLE_CONFIG_IMAGE_H

#include <stddef.h>
#include <stdint.h>

/* The factory default as an image. */
void config_image_default(uint8_t *image);

/* An image whose only fault is that points are nearer than their least step, as firmware without
 * that rule took them: moves each just far enough from the one before it, and back from the end of
 * the range. Any other image stays as it is. Returns how many points were moved. */
size_t config_image_points_spread(uint8_t *image);

/* True if every value is within its range and the law accepts the whole. */
int config_image_is_valid(const uint8_t *image);

#endif
