/* The configuration in force: what flash has, what is being changed, tried and allowed, and what
 * the law runs on. */
#ifndef SPINDLE_IN_FORCE_H
#define SPINDLE_IN_FORCE_H

#include "assist.h"               // assist_config
#include "ebl_registry.h"         // ebl_config
#include "faults/faults.h"        // fault_list
#include "line/events.h"          // event_log
#include "line/link.h"            // unit_link
#include "live.h"                 // config_live
#include "storage/config_store.h" // config_store
#include "transaction.h"          // config_transaction
#include "trial.h"                // config_trial
#include "unlock.h"               // unlock

typedef struct {
    config_store store;
    config_transaction transaction;
    config_trial trial;
    config_live live;
    unlock unlock;
    ebl_config in_force;
    assist_config law; /* the same, as the law wants it */
} unit_config;

/* The image in force becomes the law's. */
void config_apply(unit_config *config);

/* Another configuration is active, because it was written or one on trial was given up: live
 * values end, the law gets it, the host is told. */
void config_committed(unit_config *config, event_log *events, unit_link *link, const hal *board);
void config_rolled_back(unit_config *config, event_log *events, unit_link *link, const hal *board);

/* Nothing of the active configuration is lost any more: the faults that told so end. */
void config_well(fault_list *faults, event_log *events, unit_link *link, const hal *board);

#endif
