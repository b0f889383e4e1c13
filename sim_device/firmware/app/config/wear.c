#include "wear.h"

#define AHEAD_S_MAX (CONFIG_WEAR_FREE_WRITES * CONFIG_WEAR_WRITE_S)

/* Never more than all of it: a unit whose counters were lost has only just begun to operate. */
static uint32_t ahead_s(uint32_t worn_until_s, uint32_t operating_s)
{
    uint32_t ahead = worn_until_s > operating_s ? worn_until_s - operating_s : 0;

    return ahead < AHEAD_S_MAX ? ahead : AHEAD_S_MAX;
}

uint32_t config_wear_wait_s(uint32_t worn_until_s, uint32_t operating_s)
{
    uint32_t after = ahead_s(worn_until_s, operating_s) + CONFIG_WEAR_WRITE_S;

    return after > AHEAD_S_MAX ? after - AHEAD_S_MAX : 0;
}

uint16_t config_wear_writes_free(uint32_t worn_until_s, uint32_t operating_s)
{
    uint32_t left_s = AHEAD_S_MAX - ahead_s(worn_until_s, operating_s);

    return (uint16_t)(left_s / CONFIG_WEAR_WRITE_S);
}

uint32_t config_wear_spend(uint32_t worn_until_s, uint32_t operating_s)
{
    return operating_s + ahead_s(worn_until_s, operating_s) + CONFIG_WEAR_WRITE_S;
}
