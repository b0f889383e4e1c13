/* The typed configuration and its image: one table says where each parameter lies in both. */
#include "ebl_bytes.h"    // ebl_copy_numbers
#include "ebl_registry.h" // ebl_parameters

/* One parameter, from either to the other. */
static void copy(const ebl_parameter *row, uint8_t *to, const uint8_t *from)
{
    size_t size = row->type == EBL_TYPE_TEXT ? 1 : row->length;

    ebl_copy_numbers(to, from, size, (size_t)row->count * row->length);
}

void ebl_config_pack(const ebl_config *config, uint8_t *image)
{
    for (const ebl_parameter *row = ebl_parameters; row < ebl_parameters + EBL_PARAMETER_COUNT;
         row++) {
        copy(row, image + row->image_offset, (const uint8_t *)config + row->config_offset);
    }
}

void ebl_config_unpack(ebl_config *config, const uint8_t *image)
{
    for (const ebl_parameter *row = ebl_parameters; row < ebl_parameters + EBL_PARAMETER_COUNT;
         row++) {
        copy(row, (uint8_t *)config + row->config_offset, image + row->image_offset);
    }
}
