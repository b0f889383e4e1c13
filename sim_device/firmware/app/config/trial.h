/* A configuration that has to prove itself: it is active, and given up by itself unless somebody
 * who has read it back says in time that it stays. */
#ifndef SPINDLE_CONFIG_TRIAL_H
#define SPINDLE_CONFIG_TRIAL_H

#include <stdint.h>

#include "storage/config_store.h" // config_store
#include "ebl_registry.h"         // ebl_status
#include "hal.h"                  // hal

typedef struct {
    uint64_t ends_us;             /* while the store is on trial */
    uint8_t cause;                /* ebl_rollback_cause of the latest return */
    uint32_t returned_generation; /* what was given up then */
} config_trial;

/* Notes what the boot found and took back. */
void trial_boot(config_trial *trial, const config_store *store);

void trial_begin(config_trial *trial, uint8_t confirm_s, uint64_t now_us);

/* Milliseconds until the configuration on trial is given up; 0 while none is. */
uint32_t trial_left_ms(const config_trial *trial, const config_store *store, uint64_t now_us);

/* True where the time to confirm is over. */
int trial_is_over(const config_trial *trial, const config_store *store, uint64_t now_us);

/* Returns an ebl_status. OK too for a configuration that is confirmed already: the answer to the
 * first asking may have been lost. */
uint8_t trial_confirm(config_store *store, const hal *board, const ebl_cfg_confirm_request *request,
                      uint16_t *detail);

/* Gives up what is on trial. `cause`: ebl_rollback_cause. */
void trial_return(config_trial *trial, config_store *store, const hal *board, uint8_t cause);

#endif
