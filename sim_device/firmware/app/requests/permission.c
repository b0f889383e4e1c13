#include "permission.h"

#include "ebl_registry.h" // EBL_ACCESS_FACTORY, EBL_STATUS_OK

uint8_t permission_to_stage(const app *unit)
{
    return unit->config.unlock.store.has_key ? EBL_ACCESS_FACTORY : EBL_ACCESS_DEALER;
}

uint8_t permission_to_activate(const app *unit, const uint8_t *image, uint16_t *detail)
{
    const config_store *store = &unit->config.store;
    uint8_t needed = unlock_level_needed(store->image, image);

    /* What the maker chose is lost: whatever is written instead, the maker has to agree. */
    if ((store->lost & CONFIG_STORE_MAKERS_RECORDS) != 0) needed = EBL_ACCESS_FACTORY;

    if (needed == EBL_ACCESS_RIDER) return EBL_STATUS_OK;
    if (unlock_permits(&unit->config.unlock, needed, image, unit_now_us(unit)))
        return EBL_STATUS_OK;
    *detail = needed;
    return EBL_STATUS_ACCESS;
}

uint8_t permission_to_write_flash(const app *unit)
{
    return transaction_flash_status(
        unit->board, road_speed_kmh(&unit->speed, &unit->config.in_force, unit_now_us(unit)));
}

void permission_end(app *unit)
{
    if (unlock_drop(&unit->config.unlock)) permission_tell(unit);
}

void permission_tell(app *unit)
{
    uint32_t failures = unit->config.unlock.store.failures;

    event_auth_changed(&unit->events, &unit->link, unit_now_us(unit),
                       unit->config.unlock.granted_level,
                       failures < UINT16_MAX ? (uint16_t)failures : UINT16_MAX);
}
