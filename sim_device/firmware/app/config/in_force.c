#include "in_force.h"

#include "float32.h"            // float32_min
#include "market.h"             // MARKET_COUNT
#include "storage/config_law.h" // config_law_from

#define WALKING_PACE_KMH 6.0f /* where walk assist ends (EN 15194 4.2.12) */

/* What is lost of the configuration has a default in its place, which nobody chose: a limit that
 * was lowered is up again, a sensor's zero is off. At a walking pace none of it is a hazard.
 * Without its market a unit does not know what is lawful, and does nothing. */
static void hold_back(assist_config *assist, uint8_t lost)
{
    if (lost == 0) return;
    assist->assist_cutoff_kmh = float32_min(assist->assist_cutoff_kmh, WALKING_PACE_KMH);
    assist->assist_cutoff_extra_kmh = 0.0f;
    if ((lost >> EBL_RECORD_MARKET & 1u) != 0) assist->market = MARKET_COUNT;
}

void config_apply(unit_config *config)
{
    ebl_config_unpack(&config->in_force, live_image(&config->live, &config->store));
    config_law_from(&config->in_force, &config->law);
    hold_back(&config->law, config->store.lost);
}

static void changed(unit_config *config, event_log *events, unit_link *link, const hal *board,
                    uint8_t event_code)
{
    config->live.active = 0;
    config_apply(config);
    event_config(events, link, board->now_us(board->context), event_code, config->store.generation,
                 config->store.crc32);
}

void config_committed(unit_config *config, event_log *events, unit_link *link, const hal *board)
{
    changed(config, events, link, board, EBL_EVENT_CONFIG_COMMITTED);
}

void config_rolled_back(unit_config *config, event_log *events, unit_link *link, const hal *board)
{
    changed(config, events, link, board, EBL_EVENT_CONFIG_ROLLED_BACK);
}

void config_well(fault_list *faults, event_log *events, unit_link *link, const hal *board)
{
    uint32_t over = EBL_FAULT_CONFIG_DEFAULTED | EBL_FAULT_NOT_PROVISIONED;
    uint32_t cleared = faults_clear(faults, over);

    if (cleared == 0) return;
    event_faults_cleared(events, link, board->now_us(board->context), cleared);
}
