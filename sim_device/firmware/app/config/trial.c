#include "trial.h"

#include "storage/flash_verify.h" // STORAGE_OK

#define US_PER_MS 1000u
#define US_PER_S 1000000u

void trial_boot(config_trial *trial, const config_store *store)
{
    trial->ends_us = 0;
    trial->returned_generation = store->returned_generation;
    trial->cause =
        store->returned_generation != 0 ? EBL_ROLLBACK_CAUSE_RESTART : EBL_ROLLBACK_CAUSE_NONE;
}

void trial_begin(config_trial *trial, uint8_t confirm_s, uint64_t now_us)
{
    trial->ends_us = now_us + (uint64_t)confirm_s * US_PER_S;
}

uint32_t trial_left_ms(const config_trial *trial, const config_store *store, uint64_t now_us)
{
    if (!store->on_trial || trial->ends_us <= now_us) return 0;
    return (uint32_t)((trial->ends_us - now_us + US_PER_MS - 1) / US_PER_MS);
}

int trial_is_over(const config_trial *trial, const config_store *store, uint64_t now_us)
{
    return store->on_trial && now_us >= trial->ends_us;
}

uint8_t trial_confirm(config_store *store, const hal *board, const ebl_cfg_confirm_request *request,
                      uint16_t *detail)
{
    *detail = (uint16_t)store->generation;
    if (request->generation != store->generation) return EBL_STATUS_STALE_BASE;
    *detail = (uint16_t)store->crc32;
    if (request->crc32 != store->crc32) return EBL_STATUS_CRC_MISMATCH;
    *detail = 0;
    if (!store->on_trial) return EBL_STATUS_OK;
    switch (config_store_confirm(store, board)) {
    case STORAGE_OK: return EBL_STATUS_OK;
    case STORAGE_VERIFY_FAIL: return EBL_STATUS_VERIFY_FAIL;
    default: return EBL_STATUS_FLASH_FAIL;
    }
}

void trial_return(config_trial *trial, config_store *store, const hal *board, uint8_t cause)
{
    trial->cause = cause;
    trial->returned_generation = store->generation;
    config_store_return(store, board);
}
