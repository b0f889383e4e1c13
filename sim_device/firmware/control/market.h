/* What the law of the land allows. These numbers are in code flash: no request reaches them.
 *
 * A market lowers what is configured and never raises it. Sources: EN 15194 scope and 4.2.12 to 13
 * (25 km/h after a progressive reduction, 250 W continuous, start-up assist to 6 km/h); SI 2015/24
 * reg. 2 (15.5 mph, 250 W); 36 CFR 1.4 and California Vehicle Code 312.5 with SB 1271 (classes of
 * 20, 20 and 28 mph, 750 W, walk mode to 3.7 mph); Japan's Road Traffic Act Enforcement Regulation
 * 1-3 (ratio by speed, zero at 24 km/h, no motor without pedalling); GB 17761-2018 (25 km/h, 400 W
 * continuous). US class 2 may have a throttle; this drive unit has none, so class 2 is class 1
 * here. Not legal advice. */
#ifndef SPINDLE_MARKET_H
#define SPINDLE_MARKET_H

#include "assist_types.h" // assist_config

#include <stdint.h>

typedef enum {
    MARKET_EU_EPAC = 0,
    MARKET_UK = 1,
    MARKET_US_CLASS_1 = 2,
    MARKET_US_CLASS_2 = 3,
    MARKET_US_CLASS_3 = 4,
    MARKET_JAPAN = 5,
    MARKET_CHINA = 6,
    MARKET_COUNT = 7
} market;

typedef struct {
    float cutoff_kmh;    /* no assist at and above it */
    float band_kmh;      /* assist falls over no less than this below the cut-off */
    float walk_kmh;      /* no walk assist at and above it; 0: none at all */
    float continuous_w;  /* shaft power the motor may give for ever; 0: not limited */
    float peak_w;        /* shaft power it may give at any moment; 0: not limited */
    float pedal_stop_s;  /* longest time assist may outlive pedalling */
    uint8_t ratio_falls; /* 1: assist per rider torque is under market_japan_ratio */
} market_profile;

/* The profile of a market; the strictest of them all for a number that is no market. */
const market_profile *market_profile_of(uint8_t market_number);

/* The cut-off speed that holds: what is configured, or the market's own where that is lower. */
float market_cutoff_kmh(const assist_config *config);

/* Width of the ramp below it: what is configured, or the market's least where that is wider. */
float market_cutoff_band_kmh(const assist_config *config);

/* Assist per rider torque that Japan allows since December 2008 (2 below 10 km/h, then down in a
 * straight line to 0 at 24 km/h), and what it allowed before (1 below 15 km/h, 0 at 24 km/h). */
float market_japan_ratio(float speed_kmh);
float market_japan_ratio_before_2008(float speed_kmh);

#endif
