/* How a host changes the configuration: begin on what it believes is active, set, validate,
 * commit. Until the commit only a shadow in RAM changes, and it is lost when the lease ends. */
#ifndef SPINDLE_CONFIG_TRANSACTION_H
#define SPINDLE_CONFIG_TRANSACTION_H

#include <stddef.h>
#include <stdint.h>

#include "storage/config_store.h" // config_store
#include "ebl_registry.h"         // ebl_status
#include "ebl_values.h"           // ebl_refusal
#include "hal.h"                  // hal

#define TRANSACTION_LEASE_MS 30000

/* An erased block takes its time. What a script gone wrong may wear out, wear.h bounds. */
#define TRANSACTION_COMMIT_PERIOD_MS 2000

typedef struct {
    uint8_t state;   /* ebl_config_state */
    uint16_t id;     /* of the open transaction; the latest one while idle */
    uint8_t expired; /* the latest one ended by its lease */
    uint64_t lease_end_us;
    uint64_t commit_free_us; /* not before this is the flash written again */
    uint8_t image[EBL_IMAGE_LENGTH];
} config_transaction;

/* All but `poll` and `drop` return an ebl_status and, where it is not OK, fill `detail`. Whatever
 * names the open transaction renews its lease. */
uint8_t transaction_begin(config_transaction *transaction, const config_store *store,
                          const ebl_cfg_begin_request *request, uint64_t now_us, uint16_t *detail);
uint8_t transaction_set(config_transaction *transaction, const ebl_cfg_set_request *request,
                        uint8_t access, uint64_t now_us, uint16_t *detail);

/* INVALID_CONFIG: the first `capacity` refusals in `found`, the number of all in `detail`. */
uint8_t transaction_validate(config_transaction *transaction, uint16_t id, uint64_t now_us,
                             ebl_refusal *found, size_t capacity, uint16_t *detail);
uint8_t transaction_staged_crc(config_transaction *transaction, uint16_t id, uint64_t now_us,
                               uint32_t *crc32, uint16_t *detail);

/* `operating_s`: of the unit's life. OK: the store holds the new image, on trial where the
 * request's flags say so, and the transaction
 * is over. Else both are as they were. */
uint8_t transaction_commit(config_transaction *transaction, config_store *store, const hal *board,
                           float speed_kmh, const ebl_cfg_commit_request *request, uint64_t now_us,
                           uint32_t operating_s, uint16_t *detail);
uint8_t transaction_abort(config_transaction *transaction, uint16_t id, uint64_t now_us,
                          uint16_t *detail);

/* Milliseconds until a commit may write the flash again; 65535: that long or longer. */
uint16_t transaction_commit_wait_ms(const config_transaction *transaction,
                                    const config_store *store, uint64_t now_us,
                                    uint32_t operating_s);

/* OK where the flash may be written now: standing still, with enough battery. */
uint8_t transaction_flash_status(const hal *board, float speed_kmh);

/* Ends the transaction when its lease is over. */
void transaction_poll(config_transaction *transaction, uint64_t now_us);

/* The host left. */
void transaction_drop(config_transaction *transaction);

#endif
