#include "transaction.h"

#include <string.h>

#include "faults/inputs.h"        // inputs_take
#include "storage/config_image.h" // config_image_is_valid
#include "storage/flash_verify.h" // STORAGE_OK
#include "wear.h"                 // config_wear_wait_s, config_wear_spend
#include "ebl_frame.h"            // ebl_crc32
#include "parameters.h"           // parameters_set

#define US_PER_MS 1000u
#define US_PER_S 1000000u
#define MS_PER_S 1000u

/* Below this the supply may fail in the middle of an erase. */
#define FLASH_BATTERY_VOLTAGE_V_MIN 24.0f

static void lease_renew(config_transaction *transaction, uint64_t now_us)
{
    transaction->lease_end_us = now_us + (uint64_t)TRANSACTION_LEASE_MS * US_PER_MS;
}

/* OK for the open transaction, which its host has just shown to be alive. */
static uint8_t transaction_enter(config_transaction *transaction, uint16_t id, uint64_t now_us,
                                 uint16_t *detail)
{
    *detail = 0;
    if (transaction->state == EBL_CONFIG_STATE_IDLE || id != transaction->id) {
        int late = transaction->expired && id == transaction->id;

        return late ? EBL_STATUS_EXPIRED : EBL_STATUS_STATE;
    }
    lease_renew(transaction, now_us);
    return EBL_STATUS_OK;
}

uint8_t transaction_begin(config_transaction *transaction, const config_store *store,
                          const ebl_cfg_begin_request *request, uint64_t now_us, uint16_t *detail)
{
    *detail = 0;
    if (transaction->state != EBL_CONFIG_STATE_IDLE) {
        uint64_t end_us = transaction->lease_end_us;

        if (end_us > now_us) *detail = (uint16_t)((end_us - now_us + US_PER_S - 1) / US_PER_S);
        return EBL_STATUS_BUSY;
    }
    if (request->base_generation != store->generation || request->base_crc32 != store->crc32) {
        *detail = (uint16_t)store->generation;
        return EBL_STATUS_STALE_BASE;
    }
    transaction->state = EBL_CONFIG_STATE_STAGING;
    transaction->expired = 0;
    transaction->id++;
    if (transaction->id == 0) transaction->id = 1;
    memcpy(transaction->image, store->image, EBL_IMAGE_LENGTH);
    lease_renew(transaction, now_us);
    return EBL_STATUS_OK;
}

uint8_t transaction_set(config_transaction *transaction, const ebl_cfg_set_request *request,
                        uint8_t access, uint64_t now_us, uint16_t *detail)
{
    uint8_t status = transaction_enter(transaction, request->transaction, now_us, detail);

    if (status != EBL_STATUS_OK) return status;
    status =
        parameters_set(transaction->image, request->items, request->items_length, access, detail);
    if (status != EBL_STATUS_OK) return status;
    transaction->state = EBL_CONFIG_STATE_STAGING;
    return EBL_STATUS_OK;
}

uint8_t transaction_validate(config_transaction *transaction, uint16_t id, uint64_t now_us,
                             ebl_refusal *found, size_t capacity, uint16_t *detail)
{
    uint8_t status = transaction_enter(transaction, id, now_us, detail);

    if (status != EBL_STATUS_OK) return status;
    *detail = (uint16_t)ebl_image_violations(transaction->image, found, capacity);
    if (*detail > 0 || !config_image_is_valid(transaction->image)) {
        transaction->state = EBL_CONFIG_STATE_STAGING;
        return EBL_STATUS_INVALID_CONFIG;
    }
    transaction->state = EBL_CONFIG_STATE_VALID;
    return EBL_STATUS_OK;
}

uint8_t transaction_staged_crc(config_transaction *transaction, uint16_t id, uint64_t now_us,
                               uint32_t *crc32, uint16_t *detail)
{
    uint8_t status = transaction_enter(transaction, id, now_us, detail);

    if (status != EBL_STATUS_OK) return status;
    *crc32 = ebl_crc32(0, transaction->image, EBL_IMAGE_LENGTH);
    return EBL_STATUS_OK;
}

static int magnitude_is_below(float value, float limit) { return value > -limit && value < limit; }

/* Erasing stalls the processor: nobody may be riding. A wheel pushed by hand rests, and so does a
 * motor turned by its cogging. A speed that is not known is not a standstill; an unknown voltage
 * the second slot covers. */
uint8_t transaction_flash_status(const hal *board, float speed_kmh)
{
    hal_inputs inputs;

    inputs_take(board, &inputs);
    if (inputs.speed_age_ms == HAL_SPEED_NOT_MEASURED ||
        !magnitude_is_below(speed_kmh, EBL_RESTING_KMH) ||
        !magnitude_is_below(inputs.motor_speed_rpm, EBL_RESTING_MOTOR_RPM)) {
        return EBL_STATUS_NOT_STOPPED;
    }
    if (inputs.battery_voltage_v < FLASH_BATTERY_VOLTAGE_V_MIN) return EBL_STATUS_UNDERVOLTAGE;
    return EBL_STATUS_OK;
}

static uint8_t commit_check(config_transaction *transaction, const hal *board, float speed_kmh,
                            const ebl_cfg_commit_request *request, uint64_t now_us,
                            uint16_t *detail)
{
    uint8_t status = transaction_enter(transaction, request->transaction, now_us, detail);
    uint32_t crc32;

    if (status != EBL_STATUS_OK) return status;
    if ((request->flags & ~EBL_COMMIT_PROVISIONAL) != 0) return EBL_STATUS_UNSUPPORTED;
    /* A trial without an end, and an end without a trial, are both mistakes. */
    if ((request->flags != 0) != (request->confirm_s != 0)) return EBL_STATUS_RANGE;
    if (transaction->state != EBL_CONFIG_STATE_VALID) return EBL_STATUS_STATE;
    crc32 = ebl_crc32(0, transaction->image, EBL_IMAGE_LENGTH);
    if (crc32 != request->staged_crc32) {
        *detail = (uint16_t)crc32;
        return EBL_STATUS_CRC_MISMATCH;
    }
    return transaction_flash_status(board, speed_kmh);
}

static uint8_t store_status(int result)
{
    switch (result) {
    case STORAGE_OK: return EBL_STATUS_OK;
    case STORAGE_NO_SPACE: return EBL_STATUS_NO_SPACE;
    case STORAGE_VERIFY_FAIL: return EBL_STATUS_VERIFY_FAIL;
    default: return EBL_STATUS_FLASH_FAIL;
    }
}

uint8_t transaction_commit(config_transaction *transaction, config_store *store, const hal *board,
                           float speed_kmh, const ebl_cfg_commit_request *request, uint64_t now_us,
                           uint32_t operating_s, uint16_t *detail)
{
    uint8_t status = commit_check(transaction, board, speed_kmh, request, now_us, detail);

    if (status != EBL_STATUS_OK) return status;
    if (store->lost != 0 || memcmp(transaction->image, store->image, EBL_IMAGE_LENGTH) != 0) {
        *detail = transaction_commit_wait_ms(transaction, store, now_us, operating_s);
        if (*detail > 0) return EBL_STATUS_RATE_LIMIT;
        store->worn_until_s = config_wear_spend(store->worn_until_s, operating_s);
        transaction->commit_free_us = now_us + (uint64_t)TRANSACTION_COMMIT_PERIOD_MS * US_PER_MS;
        status =
            store_status(config_store_write(store, board, transaction->image, request->flags != 0));
    }
    if (status != EBL_STATUS_OK) return status;
    transaction->state = EBL_CONFIG_STATE_IDLE;
    return EBL_STATUS_OK;
}

uint8_t transaction_abort(config_transaction *transaction, uint16_t id, uint64_t now_us,
                          uint16_t *detail)
{
    uint8_t status = transaction_enter(transaction, id, now_us, detail);

    if (status == EBL_STATUS_OK) transaction_drop(transaction);
    return status;
}

uint16_t transaction_commit_wait_ms(const config_transaction *transaction,
                                    const config_store *store, uint64_t now_us,
                                    uint32_t operating_s)
{
    uint64_t wait_ms = (uint64_t)config_wear_wait_s(store->worn_until_s, operating_s) * MS_PER_S;
    uint64_t free_us = transaction->commit_free_us;

    if (free_us > now_us && (free_us - now_us + US_PER_MS - 1) / US_PER_MS > wait_ms) {
        wait_ms = (free_us - now_us + US_PER_MS - 1) / US_PER_MS;
    }
    return wait_ms < UINT16_MAX ? (uint16_t)wait_ms : UINT16_MAX;
}

void transaction_poll(config_transaction *transaction, uint64_t now_us)
{
    if (transaction->state == EBL_CONFIG_STATE_IDLE || now_us < transaction->lease_end_us) return;
    transaction->state = EBL_CONFIG_STATE_IDLE;
    transaction->expired = 1;
}

void transaction_drop(config_transaction *transaction)
{
    transaction->state = EBL_CONFIG_STATE_IDLE;
    transaction->expired = 0;
}
