/* The typed configuration and its image: one table says where each parameter lies in both. */
#include "ebl_bytes.h"    // ebl_get_u16, ebl_put_u16
#include "ebl_registry.h" // ebl_parameters

static void element_put(const ebl_parameter *row, uint8_t *image, const uint8_t *member)
{
    uint16_t half;
    uint32_t word;

    switch (row->type) {
    case EBL_TYPE_U16:
        memcpy(&half, member, sizeof half);
        ebl_put_u16(image, half);
        break;
    case EBL_TYPE_F32:
        memcpy(&word, member, sizeof word);
        ebl_put_u32(image, word);
        break;
    default: memcpy(image, member, row->length);
    }
}

static void element_get(const ebl_parameter *row, uint8_t *member, const uint8_t *image)
{
    uint16_t half;
    uint32_t word;

    switch (row->type) {
    case EBL_TYPE_U16:
        half = ebl_get_u16(image);
        memcpy(member, &half, sizeof half);
        break;
    case EBL_TYPE_F32:
        word = ebl_get_u32(image);
        memcpy(member, &word, sizeof word);
        break;
    default: memcpy(member, image, row->length);
    }
}

void ebl_config_pack(const ebl_config *config, uint8_t *image)
{
    for (size_t at = 0; at < EBL_PARAMETER_COUNT; at++) {
        const ebl_parameter *row = &ebl_parameters[at];
        const uint8_t *member = (const uint8_t *)config + row->config_offset;

        for (size_t i = 0; i < (size_t)row->count * row->length; i += row->length) {
            element_put(row, image + row->image_offset + i, member + i);
        }
    }
}

void ebl_config_unpack(ebl_config *config, const uint8_t *image)
{
    for (size_t at = 0; at < EBL_PARAMETER_COUNT; at++) {
        const ebl_parameter *row = &ebl_parameters[at];
        uint8_t *member = (uint8_t *)config + row->config_offset;

        for (size_t i = 0; i < (size_t)row->count * row->length; i += row->length) {
            element_get(row, member + i, image + row->image_offset + i);
        }
    }
}
