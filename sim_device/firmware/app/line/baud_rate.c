#include "baud_rate.h"

#include <string.h>

#include "ebl_registry.h" // EBL_BAUD_RATES_BAUD_115200, EBL_STATUS_OK

#define US_PER_MS 1000u
#define RATES 6

/* An answer behind a full UART and the frame before it takes 70 ms at the lowest rate. */
#define ANSWER_US_MAX 1000000u

/* A host in touch asks twice a second, one that only listens renews its stream every two. */
#define FORGOTTEN_US 5000000u

static const struct {
    uint32_t baud;
    uint16_t bit;
} rates[RATES] = {
    {115200, EBL_BAUD_RATES_BAUD_115200},   {230400, EBL_BAUD_RATES_BAUD_230400},
    {460800, EBL_BAUD_RATES_BAUD_460800},   {921600, EBL_BAUD_RATES_BAUD_921600},
    {1000000, EBL_BAUD_RATES_BAUD_1000000}, {2000000, EBL_BAUD_RATES_BAUD_2000000},
};

void baud_rate_init(baud_rate *line, const hal *board)
{
    memset(line, 0, sizeof *line);
    line->first = board->serial_baud;
}

uint16_t baud_rate_offered(const hal *board)
{
    return board->serial_baud_set == NULL ? 0 : board->serial_bauds;
}

static int is_offered(const hal *board, uint32_t baud)
{
    for (size_t i = 0; i < RATES; i++) {
        if (rates[i].baud == baud) return (baud_rate_offered(board) & rates[i].bit) != 0;
    }
    return 0;
}

uint8_t baud_rate_check(const baud_rate *line, const hal *board, uint32_t baud, uint16_t *detail)
{
    *detail = 0;
    if (line->state != BAUD_RATE_STEADY) return EBL_STATUS_BUSY;
    if (!is_offered(board, baud)) {
        *detail = baud_rate_offered(board);
        return EBL_STATUS_UNSUPPORTED;
    }
    return EBL_STATUS_OK;
}

void baud_rate_begin(baud_rate *line, const hal *board, uint32_t baud)
{
    uint64_t now_us = board->now_us(board->context);

    line->state = BAUD_RATE_ANSWERING;
    line->before = board->serial_baud;
    line->next = baud;
    line->end_us = now_us + ANSWER_US_MAX;
    line->due_us = now_us + BAUD_RATE_SWITCH_MS * US_PER_MS;
}

uint32_t baud_rate_for_streams(const baud_rate *line, const hal *board)
{
    uint32_t baud = board->serial_baud;

    return line->state != BAUD_RATE_STEADY && line->next < baud ? line->next : baud;
}

void baud_rate_heard(baud_rate *line, uint64_t now_us)
{
    line->heard_us = now_us;
    if (line->state == BAUD_RATE_PROVING) line->state = BAUD_RATE_STEADY;
}

static baud_rate_change give_back(baud_rate *line, const hal *board)
{
    (void)board->serial_baud_set(board->context, line->before);
    line->state = BAUD_RATE_STEADY;
    return BAUD_RATE_GIVEN_BACK;
}

static baud_rate_change answering(baud_rate *line, const unit_link *link, const hal *board,
                                  uint64_t now_us)
{
    if (!link_has_answered(link) || !board->serial_drained(board->context)) {
        line->due_us = now_us + BAUD_RATE_SWITCH_MS * US_PER_MS;
        if (now_us < line->end_us) return BAUD_RATE_KEPT;
        line->state = BAUD_RATE_STEADY;
        return BAUD_RATE_GIVEN_BACK;
    }
    if (now_us < line->due_us) return BAUD_RATE_KEPT;
    if (board->serial_baud_set(board->context, line->next) < 0) return give_back(line, board);
    line->state = BAUD_RATE_PROVING;
    line->due_us = now_us + BAUD_RATE_PROVE_MS * US_PER_MS;
    return BAUD_RATE_SWITCHED;
}

baud_rate_change baud_rate_poll(baud_rate *line, unit_link *link, const hal *board, uint64_t now_us)
{
    baud_rate_change change = BAUD_RATE_KEPT;

    if (line->state == BAUD_RATE_ANSWERING) {
        change = answering(line, link, board, now_us);
    } else if (line->state == BAUD_RATE_PROVING && now_us >= line->due_us) {
        change = give_back(line, board);
    } else if (line->state == BAUD_RATE_STEADY && board->serial_baud_set != NULL &&
               board->serial_baud != line->first && now_us - line->heard_us >= FORGOTTEN_US) {
        (void)board->serial_baud_set(board->context, line->first);
        change = BAUD_RATE_FORGOTTEN;
    }
    link->answers_only = line->state != BAUD_RATE_STEADY;
    return change;
}
