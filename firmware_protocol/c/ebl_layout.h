/* Between a message's struct and its bytes. A layout says what a message is made of, and two calls
 * follow it. Every message's layout is in ebl_messages.c.
 *
 * A layout is a row of bytes: the length of the shortest payload that is accepted, the length that
 * is sent without a tail, runs, and EBL_END. A run is a kind with a number in its lower five bits.
 * There are no offsets: members lie in the order of the wire, each aligned at its own size. There
 * are no signs and no floats: a copy does not depend on them.
 *
 *     {14, 14, EBL_U8 | 2, EBL_U16 | 2, EBL_U8 | 8, EBL_END} */
#ifndef SPINDLE_EBL_LAYOUT_H
#define SPINDLE_EBL_LAYOUT_H

#include <stddef.h>
#include <stdint.h>

enum { EBL_SHORTEST, EBL_WHOLE, EBL_RUNS }; /* what stands where in a layout */

enum {
    EBL_END = 0,
    EBL_U8 = 0x20, /* | how many numbers of this size */
    EBL_U16 = 0x40,
    EBL_U32 = 0x60,
    EBL_U64 = 0x80,
    EBL_LOW = 0xa0,  /* | place: a u16, the lower half of the uint32_t at 4 * place in the struct */
    EBL_HIGH = 0xc0, /* | place: its upper half; 0 where an older peer's payload ends before it */
    EBL_TAIL = 0xe0  /* the rest of the payload: a pointer and a size_t */
};

/* A message after the layout of its type, as the calls below take the two. A pointer to another
 * type does not compile. */
#define EBL_MESSAGE(type, message) type##_layout, (1 ? (message) : (type *)NULL)

/* EBL_OK, or EBL_ERROR_LENGTH if a field is missing, and then nothing is written. A tail points
 * into `bytes`. */
int ebl_layout_get(const uint8_t *layout, void *message, const uint8_t *bytes, size_t length);

/* EBL_OK and the length, or EBL_ERROR_SPACE. */
int ebl_layout_put(const uint8_t *layout, const void *message, uint8_t *bytes, size_t capacity,
                   size_t *length);

#endif
