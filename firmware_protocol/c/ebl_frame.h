/* Frames on the wire: 00 | COBS(header, payload, CRC-32) | 00. Caller's buffers, no heap.
 *
 * A frame here is header and payload without the check value; lengths are decoded bytes. */
#ifndef SPINDLE_EBL_FRAME_H
#define SPINDLE_EBL_FRAME_H

#include <stddef.h>
#include <stdint.h>

#define EBL_HEADER_LENGTH 4
#define EBL_CHECK_LENGTH 4
#define EBL_FRAME_LENGTH_MIN 8 /* header and check value */
#define EBL_BULK_HEAD_LENGTH 8 /* offset u32, length u16, 0 u16 */
#define EBL_BULK_SESSION_MAX 15

enum { EBL_KIND_REQUEST = 0, EBL_KIND_RESPONSE = 1, EBL_KIND_STREAM = 2, EBL_KIND_ASYNC = 3 };
enum { EBL_FLAG_MORE = 1, EBL_FLAG_RETRANSMIT = 2 };

/* A frame taken apart; payload points into the frame. */
typedef struct {
    uint8_t kind;  /* EBL_KIND_ */
    uint8_t flags; /* EBL_FLAG_ bits */
    uint8_t tag;   /* request and response: tid; stream: stream id; async: channel */
    uint16_t word; /* request and response: message id; else: sequence number */
    const uint8_t *payload;
    size_t payload_length;
} ebl_header;

/* Four bytes into `frame`; the payload is the caller's to fill in behind them. */
void ebl_header_put(uint8_t *frame, uint8_t kind, uint8_t flags, uint8_t tag, uint16_t word);

/* EBL_OK, EBL_ERROR_LENGTH (under four bytes), EBL_ERROR_RESERVED or EBL_ERROR_VERSION. On
 * EBL_ERROR_VERSION the header is filled, so that a request can be answered. */
int ebl_header_get(ebl_header *header, const uint8_t *frame, size_t length);

/* Like ebl_header_get, then the payload: known message, all fields there, rows that fill a stream
 * frame. EBL_OK or the first EBL_ERROR_ found; past the header checks the header is filled. */
int ebl_frame_check(ebl_header *header, const uint8_t *frame, size_t length);

/* zlib's CRC-32: start with 0, feed the result back in to go on. */
uint32_t ebl_crc32(uint32_t crc, const uint8_t *bytes, size_t length);

/* Longest wire form of a frame of `length` bytes, delimiters included. */
size_t ebl_wire_length_max(size_t length);

/* Both delimiters, check value, byte stuffing. EBL_OK and the length, or EBL_ERROR_SPACE. */
int ebl_frame_encode(const uint8_t *frame, size_t length, uint8_t *wire, size_t capacity,
                     size_t *wire_length);

/* What a receiver has seen. Every non-empty stretch between two zeros is counted once. */
typedef struct {
    uint32_t frames_ok;
    uint32_t crc_errors;
    uint32_t cobs_errors; /* stuffing cut short, or no room for header and check value */
    uint32_t overflows;   /* longer than the MTU */
} ebl_counts;

typedef struct {
    uint8_t *buffer; /* the caller's, `mtu` bytes: header, payload and check value */
    size_t mtu;
    size_t length;
    uint8_t remaining; /* bytes left of the current run */
    uint8_t zero_due;  /* the run before stands for a zero after it */
    uint8_t started;
    uint8_t overflowed;
    ebl_counts counts;
} ebl_decoder;

void ebl_decoder_init(ebl_decoder *decoder, uint8_t *buffer, size_t mtu);

/* Takes bytes in any split and stops after a good frame. Returns the bytes taken; `frame` is NULL
 * when they held no whole frame, else it points into the buffer until the next call. Call again
 * with the rest. Damage is counted and skipped, the next delimiter starts afresh. */
size_t ebl_decoder_feed(ebl_decoder *decoder, const uint8_t *bytes, size_t length,
                        const uint8_t **frame, size_t *frame_length);

#endif
