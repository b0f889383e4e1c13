#include "config_image.h"

#include "config_law.h" // config_law_from
#include "ebl_bytes.h"  // ebl_get_f32, ebl_put_f32
#include "ebl_values.h" // ebl_image_violations

#define SPREAD_POINTS_MAX 32 /* more than all lists of points together */

void config_image_default(uint8_t *image)
{
    ebl_config config;

    ebl_config_default(&config);
    ebl_config_pack(&config, image);
}

static size_t row_spread(const ebl_parameter *row, uint8_t *bytes)
{
    size_t moved = 0;

    for (size_t i = 1; i < row->count; i++) {
        float least = ebl_get_f32(bytes + (i - 1) * row->length) + row->least_step;

        if (ebl_get_f32(bytes + i * row->length) >= least) continue;
        ebl_put_f32(bytes + i * row->length, least);
        moved++;
    }
    for (size_t i = row->count; i-- > 0;) {
        float most = row->max - row->least_step * (float)(row->count - 1 - i);

        if (ebl_get_f32(bytes + i * row->length) <= most) break;
        ebl_put_f32(bytes + i * row->length, most);
        moved++;
    }
    return moved;
}

size_t config_image_points_spread(uint8_t *image)
{
    ebl_refusal found[SPREAD_POINTS_MAX];
    size_t count = ebl_image_violations(image, found, SPREAD_POINTS_MAX);
    size_t moved = 0;

    if (count > SPREAD_POINTS_MAX) return 0;
    for (size_t i = 0; i < count; i++) {
        if (found[i].code != EBL_VIOLATION_NOT_INCREASING) return 0;
    }
    for (size_t i = 0; i < count; i++) {
        const ebl_parameter *row = ebl_parameter_find(found[i].id);

        if (i > 0 && found[i].id == found[i - 1].id) continue;
        moved += row_spread(row, image + row->image_offset);
    }
    return moved;
}

int config_image_is_valid(const uint8_t *image)
{
    ebl_config config;
    assist_config assist;

    if (ebl_image_violations(image, NULL, 0) > 0) return 0;
    ebl_config_unpack(&config, image);
    config_law_from(&config, &assist);
    return assist_config_check(&assist) == ASSIST_OK;
}
