#include "ebl_layout.h"

#include "ebl_bytes.h" // ebl_copy_numbers, ebl_get_u16, ebl_put_u16, EBL_OK

#define KIND(run) ((run) & 0xe0)
#define NUMBER(run) ((size_t)(run) & 0x1f)
#define SIZE(run) ((size_t)1 << (((run) >> 5) - 1)) /* of one number of EBL_U8 to EBL_U64 */
#define LENGTH(run) (NUMBER(run) * SIZE(run))
#define HALF 2
#define HALF_BITS 16

typedef struct {
    const uint8_t *bytes;
    size_t length;
} tail;

static size_t aligned(size_t at, size_t size) { return (at + size - 1) & ~(size - 1); }

/* Does not compile where a compiler aligns otherwise. */
typedef struct {
    uint8_t before;
    uint64_t member;
} widest;
typedef char aligned_at_its_size[offsetof(widest, member) == sizeof(uint64_t) ? 1 : -1];

int ebl_layout_get(const uint8_t *layout, void *message, const uint8_t *bytes, size_t length)
{
    uint8_t *members = message;
    uint32_t *words = message;
    size_t from = 0, to = 0;
    uint8_t run;

    if (length < layout[EBL_SHORTEST]) {
        return EBL_ERROR_LENGTH;
    }
    for (layout += EBL_RUNS; (run = *layout) != EBL_END; layout++) {
        tail rest = {bytes + from, length - from};

        switch (KIND(run)) {
        case EBL_TAIL: memcpy(members + aligned(to, sizeof rest.bytes), &rest, sizeof rest); break;
        case EBL_LOW:
            words[NUMBER(run)] = ebl_get_u16(bytes + from);
            to = (NUMBER(run) + 1) * sizeof *words;
            from += HALF;
            break;
        case EBL_HIGH:
            if (length - from < HALF) {
                return EBL_OK;
            }
            words[NUMBER(run)] |= (uint32_t)ebl_get_u16(bytes + from) << HALF_BITS;
            from += HALF;
            break;
        default:
            to = aligned(to, SIZE(run));
            ebl_copy_numbers(members + to, bytes + from, SIZE(run), LENGTH(run));
            to += LENGTH(run);
            from += LENGTH(run);
        }
    }
    return EBL_OK;
}

int ebl_layout_put(const uint8_t *layout, const void *message, uint8_t *bytes, size_t capacity,
                   size_t *length)
{
    const uint8_t *members = message;
    const uint32_t *words = message;
    size_t from = 0, to = 0;
    uint8_t run;

    if (capacity < layout[EBL_WHOLE]) {
        return EBL_ERROR_SPACE;
    }
    for (layout += EBL_RUNS; (run = *layout) != EBL_END; layout++) {
        tail rest;

        switch (KIND(run)) {
        case EBL_TAIL:
            memcpy(&rest, members + aligned(from, sizeof rest.bytes), sizeof rest);
            if (capacity - to < rest.length) {
                return EBL_ERROR_SPACE;
            }
            if (rest.length > 0) {
                memcpy(bytes + to, rest.bytes, rest.length);
            }
            to += rest.length;
            break;
        case EBL_LOW:
            ebl_put_u16(bytes + to, (uint16_t)(words[NUMBER(run)] & 0xffffu));
            from = (NUMBER(run) + 1) * sizeof *words;
            to += HALF;
            break;
        case EBL_HIGH:
            ebl_put_u16(bytes + to, (uint16_t)(words[NUMBER(run)] >> HALF_BITS));
            to += HALF;
            break;
        default:
            from = aligned(from, SIZE(run));
            ebl_copy_numbers(bytes + to, members + from, SIZE(run), LENGTH(run));
            from += LENGTH(run);
            to += LENGTH(run);
        }
    }
    *length = to;
    return EBL_OK;
}
