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

void line_rate_init(line_rate *line, const hal *board)
{
    memset(line, 0, sizeof *line);
    line->first = board->serial_baud;
}

uint16_t line_rate_offered(const hal *board)
{
    return board->serial_baud_set == NULL ? 0 : board->serial_bauds;
}

static int is_offered(const hal *board, uint32_t baud)
{
    for (size_t i = 0; i < RATES; i++) {
        if (rates[i].baud == baud) return (line_rate_offered(board) & rates[i].bit) != 0;
    }
    return 0;
}

uint8_t line_rate_check(const line_rate *line, const hal *board, uint32_t baud, uint16_t *detail)
{
    *detail = 0;
    if (line->state != LINE_RATE_STEADY) return EBL_STATUS_BUSY;
    if (!is_offered(board, baud)) {
        *detail = line_rate_offered(board);
        return EBL_STATUS_UNSUPPORTED;
    }
    return EBL_STATUS_OK;
}

void line_rate_begin(line_rate *line, const hal *board, uint32_t baud)
{
    uint64_t now_us = board->now_us(board->context);

    line->state = LINE_RATE_ANSWERING;
    line->before = board->serial_baud;
    line->next = baud;
    line->end_us = now_us + ANSWER_US_MAX;
    line->due_us = now_us + LINE_RATE_SWITCH_MS * US_PER_MS;
}

uint32_t line_rate_for_streams(const line_rate *line, const hal *board)
{
    uint32_t baud = board->serial_baud;

    return line->state != LINE_RATE_STEADY && line->next < baud ? line->next : baud;
}

void line_rate_heard(line_rate *line, uint64_t now_us)
{
    line->heard_us = now_us;
    if (line->state == LINE_RATE_PROVING) line->state = LINE_RATE_STEADY;
}

static line_rate_change give_back(line_rate *line, const hal *board)
{
    (void)board->serial_baud_set(board->context, line->before);
    line->state = LINE_RATE_STEADY;
    return LINE_RATE_GIVEN_BACK;
}

static line_rate_change answering(line_rate *line, const unit_link *link, const hal *board,
                                  uint64_t now_us)
{
    if (!link_has_answered(link) || !board->serial_drained(board->context)) {
        line->due_us = now_us + LINE_RATE_SWITCH_MS * US_PER_MS;
        if (now_us < line->end_us) return LINE_RATE_KEPT;
        line->state = LINE_RATE_STEADY;
        return LINE_RATE_GIVEN_BACK;
    }
    if (now_us < line->due_us) return LINE_RATE_KEPT;
    if (board->serial_baud_set(board->context, line->next) < 0) return give_back(line, board);
    line->state = LINE_RATE_PROVING;
    line->due_us = now_us + LINE_RATE_PROVE_MS * US_PER_MS;
    return LINE_RATE_SWITCHED;
}

line_rate_change line_rate_poll(line_rate *line, unit_link *link, const hal *board, uint64_t now_us)
{
    line_rate_change change = LINE_RATE_KEPT;

    if (line->state == LINE_RATE_ANSWERING) {
        change = answering(line, link, board, now_us);
    } else if (line->state == LINE_RATE_PROVING && now_us >= line->due_us) {
        change = give_back(line, board);
    } else if (line->state == LINE_RATE_STEADY && board->serial_baud_set != NULL &&
               board->serial_baud != line->first && now_us - line->heard_us >= FORGOTTEN_US) {
        (void)board->serial_baud_set(board->context, line->first);
        change = LINE_RATE_FORGOTTEN;
    }
    link->answers_only = line->state != LINE_RATE_STEADY;
    return change;
}
