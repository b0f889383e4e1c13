/* Slots of firmware that kept the configuration as one image: magic u32 "EBL2", crc32 u32 (over
 * layout to erases, and the image), layout u32, generation u32, image length u16, 0xFFFF, erases
 * u32, the state words of config_slot.h, and the image: the values of the parameters there were,
 * in the order of their ids. */
#ifndef SPINDLE_CONFIG_SLOT_EBL2_H
#define SPINDLE_CONFIG_SLOT_EBL2_H

#include <stddef.h>
#include <stdint.h>

#include "config_items.h" // config_tally
#include "hal.h"          // hal

/* True for a slot of a layout that is known here, whose check value is right. `head`: its first
 * bytes, up to the state words. */
int ebl2_is_whole(const hal *board, size_t address, const uint8_t *head);

uint32_t ebl2_generation(const uint8_t *head);
uint32_t ebl2_erases(const uint8_t *head);
uint16_t ebl2_image_length(const uint8_t *head);

/* Reads its values over the image. Negative where the flash cannot be read. */
int ebl2_image_read(const hal *board, size_t address, uint16_t image_length, uint8_t *image,
                    config_tally *tally);

#endif
