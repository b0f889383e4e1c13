/* The rider's mean torque over the last half turn of the crank: one stroke of one leg, at whatever
 * cadence. A mean over time holds a changing share of a stroke and swings with it. */
#include "assist_steps.h" // half_turn_note
#include "float32.h"      // float32_clamp

#define RING_MASK (HALF_TURN_PARTS - 1u) /* the length is a power of two */

/* A minute within a sixteenth of half a turn is standing still. */
#define PART_STEPS_MAX 6000u

/* Of the crank, in one second at 1 r/min. */
static const float HALF_TURNS_PER_S_PER_RPM = 1.0f / 30.0f;

static void begin(half_turn *turn)
{
    turn->known = 0;
    turn->part_turned = 0.0f;
    turn->part_sum_nm = 0.0f;
    turn->part_steps = 0;
}

static void part_ends(half_turn *turn)
{
    float part_nm = turn->part_sum_nm / (float)turn->part_steps;
    unsigned ended = (unsigned)float32_min(turn->part_turned, (float)HALF_TURN_PARTS);

    turn->part_turned -= (float)ended;
    for (; ended > 0; ended--) {
        turn->part_nm[turn->next & RING_MASK] = part_nm;
        turn->next = (uint8_t)((turn->next + 1u) & RING_MASK);
        if (turn->known < HALF_TURN_PARTS) turn->known = (uint8_t)(turn->known + 1u);
    }
    turn->part_sum_nm = 0.0f;
    turn->part_steps = 0;
}

/* Of the parts that are known: since the crank began to turn these are the newest. */
static float mean_of_parts_nm(const half_turn *turn)
{
    float sum_nm = 0.0f;
    unsigned i;

    for (i = 1; i <= turn->known; i++) {
        sum_nm += turn->part_nm[(turn->next - i) & RING_MASK];
    }
    return sum_nm / (float)turn->known;
}

void half_turn_note(half_turn *turn, float step_s, float cadence_rpm, float torque_nm)
{
    float turned = cadence_rpm * (step_s * HALF_TURNS_PER_S_PER_RPM);

    if (turned <= 0.0f || turn->part_steps == PART_STEPS_MAX) begin(turn);
    turn->part_sum_nm += torque_nm;
    turn->part_steps = (uint16_t)(turn->part_steps + 1u);
    turn->part_turned += float32_clamp(turned, 0.0f, 1.0f) * (float)HALF_TURN_PARTS;
    if (turn->part_turned >= 1.0f) {
        part_ends(turn);
        turn->mean_nm = mean_of_parts_nm(turn);
    }
    if (turn->known == 0) turn->mean_nm = turn->part_sum_nm / (float)turn->part_steps;
}
