#include "market.h"

#include "float32.h" // float32_max, float32_min

#define KMH_PER_MPH 1.609344f
#define COMMON_CUTOFF_KMH 25.0f

/* EN 15194, scope, and GB 17761 ask for a progressive reduction and name no width. Who rides at the
 * limit on a hard cut has the motor switched three to four times a second; over 1 km/h not once. */
#define PROGRESSIVE_KMH 1.0f

/* EN 15194 4.2.13: 2 m after pedalling stops, at 25 km/h. */
#define TWO_METRES_S 0.288f
#define ONE_SECOND_S 1.0f

static const market_profile PROFILES[MARKET_COUNT] = {
    {25.0f, PROGRESSIVE_KMH, 6.0f, 250.0f, 0.0f, TWO_METRES_S, 0},
    {15.5f * KMH_PER_MPH, PROGRESSIVE_KMH, 6.0f, 250.0f, 0.0f, TWO_METRES_S, 0},
    {20.0f * KMH_PER_MPH, 0.0f, 3.7f * KMH_PER_MPH, 0.0f, 750.0f, ONE_SECOND_S, 0},
    {20.0f * KMH_PER_MPH, 0.0f, 3.7f * KMH_PER_MPH, 0.0f, 750.0f, ONE_SECOND_S, 0},
    {28.0f * KMH_PER_MPH, 0.0f, 3.7f * KMH_PER_MPH, 0.0f, 750.0f, ONE_SECOND_S, 0},
    {24.0f, 0.0f, 0.0f, 0.0f, 0.0f, ONE_SECOND_S, 1},
    {25.0f, PROGRESSIVE_KMH, 6.0f, 400.0f, 0.0f, TWO_METRES_S, 0},
};

static const market_profile NOWHERE = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1};

const market_profile *market_profile_of(uint8_t market_number)
{
    return market_number < MARKET_COUNT ? &PROFILES[market_number] : &NOWHERE;
}

/* Both fall to zero at 24 km/h: counted down from there no rounding leaves more than the law's. */
float market_japan_ratio(float speed_kmh)
{
    if (speed_kmh >= 24.0f) return 0.0f;
    return speed_kmh < 10.0f ? 2.0f : (24.0f - speed_kmh) / 7.0f;
}

float market_japan_ratio_before_2008(float speed_kmh)
{
    if (speed_kmh >= 24.0f) return 0.0f;
    return speed_kmh < 15.0f ? 1.0f : (24.0f - speed_kmh) / 9.0f;
}

float market_cutoff_kmh(const assist_config *config)
{
    const market_profile *profile = market_profile_of(config->market);
    float wanted_kmh = config->assist_cutoff_kmh;

    if (profile->cutoff_kmh > COMMON_CUTOFF_KMH) wanted_kmh += config->assist_cutoff_extra_kmh;
    return float32_min(wanted_kmh, profile->cutoff_kmh);
}

float market_cutoff_band_kmh(const assist_config *config)
{
    return float32_max(config->assist_cutoff_band_kmh, market_profile_of(config->market)->band_kmh);
}
