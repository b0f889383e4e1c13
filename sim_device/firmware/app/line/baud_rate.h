/* The rate of the line: asked for, switched to, proven, given back.
 *
 * STEADY --SET_BAUD--> ANSWERING --answer has left, 10 ms--> PROVING --a request--> STEADY
 * PROVING --200 ms without one--> STEADY at the rate before
 * STEADY --5 s without one, not at the first rate--> STEADY at the first rate
 *
 * Two ends that disagree hear noise, and neither can tell the other: so each goes back by itself,
 * and a host that knows nothing finds the unit at the rate it started with. */
#ifndef SPINDLE_LINE_RATE_H
#define SPINDLE_LINE_RATE_H

#include <stdint.h>

#include "hal.h"  // hal
#include "link.h" // unit_link

#define LINE_RATE_SWITCH_MS 10
#define LINE_RATE_PROVE_MS 200

typedef enum { LINE_RATE_STEADY = 0, LINE_RATE_ANSWERING, LINE_RATE_PROVING } line_rate_state;

typedef struct {
    uint8_t state;  /* a line_rate_state */
    uint32_t first; /* at boot */
    uint32_t before;
    uint32_t next;
    uint64_t due_us;   /* when to switch, or to be back */
    uint64_t end_us;   /* when an answer that does not leave is given up */
    uint64_t heard_us; /* the latest request */
} line_rate;

void line_rate_init(line_rate *line, const hal *board);

/* The rates the board has, as bits of ebl_baud_rates. */
uint16_t line_rate_offered(const hal *board);

/* Whether the line can go there now: an ebl_status. */
uint8_t line_rate_check(const line_rate *line, const hal *board, uint32_t baud, uint16_t *detail);

/* Begins to switch to a rate that was checked. */
void line_rate_begin(line_rate *line, const hal *board, uint32_t baud);

/* The rate that streams are admitted for: while a switch is under way, the lower of both. 0: no
 * line limits them. */
uint32_t line_rate_for_streams(const line_rate *line, const hal *board);

/* A request came whole: this rate is right. */
void line_rate_heard(line_rate *line, uint64_t now_us);

typedef enum {
    LINE_RATE_KEPT = 0,
    LINE_RATE_SWITCHED,
    LINE_RATE_GIVEN_BACK, /* nobody proved it */
    LINE_RATE_FORGOTTEN   /* nobody is there any more */
} line_rate_change;

/* Lets time pass, and the link speak of nothing but answers while a switch is under way. */
line_rate_change line_rate_poll(line_rate *line, unit_link *link, const hal *board,
                                uint64_t now_us);

#endif
