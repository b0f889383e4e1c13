#include "live.h"

#include <string.h>

#include "parameters.h"           // parameters_set
#include "storage/config_image.h" // config_image_is_valid
#include "unlock.h"               // unlock_level_needed

#define US_PER_MS 1000u
#define US_PER_S 1000000u

const uint8_t *live_image(const config_live *live, const config_store *store)
{
    return live->active ? live->image : store->image;
}

uint8_t live_set(config_live *live, const config_store *store, const ebl_live_set_request *request,
                 uint8_t access, uint64_t now_us, ebl_refusal *found, size_t capacity,
                 uint16_t *detail)
{
    uint8_t image[EBL_IMAGE_LENGTH];
    uint8_t status;

    *detail = 0;
    if (request->ttl_s == 0) {
        live->active = 0;
        return EBL_STATUS_OK;
    }
    memcpy(image, live_image(live, store), sizeof image);
    status = parameters_set(image, request->items, request->items_length, access, detail);
    if (status != EBL_STATUS_OK) return status;
    *detail = (uint16_t)ebl_image_violations(image, found, capacity);
    if (*detail > 0 || !config_image_is_valid(image)) return EBL_STATUS_INVALID_CONFIG;
    *detail = unlock_level_needed(store->image, image);
    if (*detail != EBL_ACCESS_RIDER) return EBL_STATUS_ACCESS;
    memcpy(live->image, image, sizeof image);
    live->active = 1;
    live->ends_us = now_us + (uint64_t)request->ttl_s * US_PER_S;
    return EBL_STATUS_OK;
}

int live_expire(config_live *live, uint64_t now_us)
{
    if (!live->active || now_us < live->ends_us) return 0;
    live->active = 0;
    return 1;
}

uint32_t live_left_ms(const config_live *live, uint64_t now_us)
{
    if (!live->active || live->ends_us <= now_us) return 0;
    return (uint32_t)((live->ends_us - now_us + US_PER_MS - 1) / US_PER_MS);
}
