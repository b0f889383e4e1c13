/* The rate of the line: asked for, switched to, proven, given back.
 *
 * STEADY --SET_BAUD--> ANSWERING --answer has left, 10 ms--> PROVING --a request--> STEADY
 * PROVING --200 ms without one--> STEADY at the rate before
 * STEADY --5 s without one, not at the first rate--> STEADY at the first rate
 *
 * Two ends that disagree hear noise, and neither can tell the other: so each goes back by itself,
 * and a host that knows nothing finds the unit at the rate it started with. */
#ifndef SPINDLE_BAUD_RATE_H
#define SPINDLE_BAUD_RATE_H

#include <stdint.h>

#include "hal.h"  // hal
#include "link.h" // unit_link

#define BAUD_RATE_SWITCH_MS 10
#define BAUD_RATE_PROVE_MS 200

typedef enum { BAUD_RATE_STEADY = 0, BAUD_RATE_ANSWERING, BAUD_RATE_PROVING } baud_rate_state;

typedef struct {
    uint8_t state;  /* a baud_rate_state */
    uint32_t first; /* at boot */
    uint32_t before;
    uint32_t next;
    uint64_t due_us;   /* when to switch, or to be back */
    uint64_t end_us;   /* when an answer that does not leave is given up */
    uint64_t heard_us; /* the latest request */
} baud_rate;

void baud_rate_init(baud_rate *line, const hal *board);

/* The rates the board has, as bits of ebl_baud_rates. */
uint16_t baud_rate_offered(const hal *board);

/* Whether the line can go there now: an ebl_status. */
uint8_t baud_rate_check(const baud_rate *line, const hal *board, uint32_t baud, uint16_t *detail);

/* Begins to switch to a rate that was checked. */
void baud_rate_begin(baud_rate *line, const hal *board, uint32_t baud);

/* The rate that streams are admitted for: while a switch is under way, the lower of both. 0: no
 * line limits them. */
uint32_t baud_rate_for_streams(const baud_rate *line, const hal *board);

/* A request came whole: this rate is right. */
void baud_rate_heard(baud_rate *line, uint64_t now_us);

typedef enum {
    BAUD_RATE_KEPT = 0,
    BAUD_RATE_SWITCHED,
    BAUD_RATE_GIVEN_BACK, /* nobody proved it */
    BAUD_RATE_FORGOTTEN   /* nobody is there any more */
} baud_rate_change;

/* Lets time pass, and the link speak of nothing but answers while a switch is under way. */
baud_rate_change baud_rate_poll(baud_rate *line, unit_link *link, const hal *board,
                                uint64_t now_us);

#endif
