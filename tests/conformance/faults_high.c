/* Latches, freezes, tells, clears and forgets the two faults above bit 15 that the test's registry
 * has, through the unit's own code, and prints what became of them. */
#include <stdio.h>
#include <string.h>

#include "ebl_bytes.h"      // EBL_OK
#include "ebl_layout.h"     // EBL_MESSAGE, ebl_layout_put
#include "faults/faults.h"  // faults_latch, faults_step
#include "ride_log/pages.h" // ride_log_events_put

static void show(const char *what, uint32_t value)
{
    printf("%s %lx\n", what, (unsigned long)value);
}

static void show_bytes(const char *what, const uint8_t *bytes, size_t length)
{
    printf("%s ", what);
    for (size_t i = 0; i < length; i++) printf("%02x", bytes[i]);
    printf("\n");
}

int main(void)
{
    const uint32_t both = EBL_FAULT_MADE_UP_LATCHED | EBL_FAULT_MADE_UP_WARNING;
    const ebl_fault_set_event event = {both | EBL_FAULT_SPEED_SENSOR};
    const ride_log_event logged[2] = {{1, both, EBL_LOG_EVENT_FAULT_SET},
                                      {2, 3, EBL_LOG_EVENT_FAULT_CLEARED}};
    int16_t row[EBL_CHANNEL_COUNT] = {7};
    uint8_t bytes[RIDE_LOG_PAYLOAD_BYTES];
    ride_log_header header;
    size_t length = 0;
    ebl_config config;
    hal_inputs inputs;
    fault_law law = {0.0f, 0.0f, 0.0f, 0.0f, 0, 0.0f};
    fault_list faults;
    uint32_t set, cleared;

    memset(&faults, 0, sizeof faults);
    memset(&inputs, 0, sizeof inputs);
    ebl_config_default(&config);
    inputs.battery_voltage_v = 36.0f;
    show("new", (uint32_t)faults_latch(&faults, both));
    faults_freeze(&faults, both, 5, row);
    show("active", faults.active);
    show("inhibits", (uint32_t)faults_inhibit(&faults));
    show("frozen", faults.frames[30].count);
    show("frozen_speed", (uint32_t)faults.frames[29].row[0]);
    show("too_early", faults_clear_latched(&faults, both));
    for (int step = 0; step < 100; step++) {
        faults_step(&faults, &inputs, &config, &law, &set, &cleared);
    }
    show("latched_cleared", faults_clear_latched(&faults, both));
    show("left", faults.active);
    show("warning_cleared", (uint32_t)faults_clear(&faults, EBL_FAULT_MADE_UP_WARNING));
    faults_forget(&faults, both);
    show("forgotten", faults.frames[29].count + faults.frames[30].count);

    if (ebl_layout_put(EBL_MESSAGE(ebl_fault_set_event, &event), bytes, sizeof bytes, &length) !=
        EBL_OK) {
        return 1;
    }
    show_bytes("event", bytes, length);
    ride_log_events_put(bytes, logged, 2, &header);
    show_bytes("logged", bytes, header.length);
    return 0;
}
