/* A cassette, and a rider who shifts it to his cadence. The unit knows nothing of it, as on a bike.
 *
 * The rider shifts to the next cog when the chainring turns faster or slower than he likes by the
 * hysteresis, and the next cog is nearer to it. He eases his push for shift_s, and the chain moves
 * in the middle of it. He shifts while he coasts or stands as well, as one does before a light. */
#ifndef SPINDLE_GEARS_H
#define SPINDLE_GEARS_H

#define GEARS_COGS_MAX 14

typedef struct {
    double cog_teeth[GEARS_COGS_MAX]; /* smallest first, 0 behind the last; all 0: no cassette */
    double cadence_rpm;               /* as the rider likes it */
    double hysteresis_rpm;
    double shift_s;
    double shift_torque_share; /* of his push in the middle of it */
} gears_config;

typedef struct {
    int cog;       /* index into the cassette */
    int wanted;    /* the one that a shift under way leads to */
    double left_s; /* of that shift; 0: none */
} gears_state;

/* Teeth of the cog the chain is on; 0 without a cassette. */
double gears_cog_teeth(const gears_config *config, const gears_state *state);

/* The cog that suits the rider best while one with `teeth` would turn the chainring at `rpm`; the
 * biggest of a bike that stands. */
void gears_reset(const gears_config *config, gears_state *state, double rpm, double teeth);

/* The rider at the lever for `dt_s`, the chainring turning at `chainring_rpm`. */
void gears_step(const gears_config *config, gears_state *state, double chainring_rpm, double dt_s);

/* Share of his push that is left: straight down to the middle of a shift and up again. */
double gears_push_share(const gears_config *config, const gears_state *state);

#endif
