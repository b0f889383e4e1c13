#include "report.h"

#include "ebl_registry.h" // EBL_LOG_EVENT_FAULT_SET

void report_faults_set(app *unit, uint32_t set, uint64_t now_us)
{
    event_faults_set(&unit->events, &unit->link, now_us, set);
    ride_log_event_add(&unit->ride_log, EBL_LOG_EVENT_FAULT_SET, set, now_us);
}

void report_faults_cleared(app *unit, uint32_t cleared, uint64_t now_us)
{
    event_faults_cleared(&unit->events, &unit->link, now_us, cleared);
    ride_log_event_add(&unit->ride_log, EBL_LOG_EVENT_FAULT_CLEARED, cleared, now_us);
}
