/* Byte stuffing after Cheshire and Baker (1999), check value as in zlib (ISO-HDLC CRC-32). */
#include "ebl_frame.h"

#include "ebl_bytes.h" // ebl_put_u32, EBL_OK

#define RUN_LENGTH_MAX 254
#define CRC_RESIDUE 0x2144df1cu /* of any message followed by its own check value */

uint32_t ebl_crc32(uint32_t crc, const uint8_t *bytes, size_t length)
{
    static const uint32_t nibbles[16] = {
        0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu, 0x76dc4190u, 0x6b6b51f4u,
        0x4db26158u, 0x5005713cu, 0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu,
        0x9b64c2b0u, 0x86d3d2d4u, 0xa00ae278u, 0xbdbdf21cu,
    };
    crc = ~crc;
    for (size_t at = 0; at < length; at++) {
        crc ^= bytes[at];
        crc = (crc >> 4) ^ nibbles[crc & 15u];
        crc = (crc >> 4) ^ nibbles[crc & 15u];
    }
    return ~crc;
}

size_t ebl_wire_length_max(size_t length)
{
    size_t stuffed = length + EBL_CHECK_LENGTH;
    return 2 + stuffed + stuffed / RUN_LENGTH_MAX + 1;
}

/* Where the stuffed bytes go. A run is opened only when a byte needs it: that is why a final run
 * of 254 gets no empty run after it. */
typedef struct {
    uint8_t *wire;
    size_t at;      /* next free byte */
    size_t code_at; /* length byte of the open run, 0 when none is open */
} stuffing;

static void run_open(stuffing *out)
{
    out->code_at = out->at++;
    out->wire[out->code_at] = 1;
}

static void stuff(stuffing *out, const uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (out->code_at == 0) {
            run_open(out);
        }
        if (bytes[i] == 0) {
            run_open(out);
            continue;
        }
        out->wire[out->at++] = bytes[i];
        if (++out->wire[out->code_at] == RUN_LENGTH_MAX + 1) {
            out->code_at = 0;
        }
    }
}

int ebl_frame_encode(const uint8_t *frame, size_t length, uint8_t *wire, size_t capacity,
                     size_t *wire_length)
{
    uint8_t check[EBL_CHECK_LENGTH];
    stuffing out = {wire, 1, 0};

    if (capacity < ebl_wire_length_max(length)) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(check, ebl_crc32(0, frame, length));
    wire[0] = 0;
    stuff(&out, frame, length);
    stuff(&out, check, EBL_CHECK_LENGTH);
    wire[out.at] = 0;
    *wire_length = out.at + 1;
    return EBL_OK;
}

static void restart(ebl_decoder *decoder)
{
    decoder->length = 0;
    decoder->remaining = 0;
    decoder->zero_due = 0;
    decoder->started = 0;
    decoder->overflowed = 0;
}

void ebl_decoder_init(ebl_decoder *decoder, uint8_t *buffer, size_t mtu)
{
    static const ebl_counts none = {0, 0, 0, 0};
    decoder->buffer = buffer;
    decoder->mtu = mtu;
    decoder->counts = none;
    restart(decoder);
}

static void keep(ebl_decoder *decoder, uint8_t byte)
{
    if (decoder->length == decoder->mtu) {
        decoder->overflowed = 1;
        return;
    }
    decoder->buffer[decoder->length++] = byte;
}

static void unstuff(ebl_decoder *decoder, uint8_t byte)
{
    if (decoder->overflowed) {
        return;
    }
    if (decoder->remaining > 0) {
        decoder->remaining--;
        keep(decoder, byte);
        return;
    }
    if (decoder->zero_due) {
        keep(decoder, 0);
    }
    decoder->started = 1;
    decoder->remaining = (uint8_t)(byte - 1);
    decoder->zero_due = byte <= RUN_LENGTH_MAX;
}

/* At a delimiter: 1 if the buffer holds a good frame. */
static int finish(ebl_decoder *decoder)
{
    if (!decoder->started) {
        return 0;
    }
    if (decoder->overflowed) {
        decoder->counts.overflows++;
        return 0;
    }
    if (decoder->remaining > 0 || decoder->length < EBL_FRAME_LENGTH_MIN) {
        decoder->counts.cobs_errors++;
        return 0;
    }
    if (ebl_crc32(0, decoder->buffer, decoder->length) != CRC_RESIDUE) {
        decoder->counts.crc_errors++;
        return 0;
    }
    decoder->counts.frames_ok++;
    return 1;
}

size_t ebl_decoder_feed(ebl_decoder *decoder, const uint8_t *bytes, size_t length,
                        const uint8_t **frame, size_t *frame_length)
{
    *frame = NULL;
    *frame_length = 0;
    for (size_t at = 0; at < length; at++) {
        if (bytes[at] != 0) {
            unstuff(decoder, bytes[at]);
            continue;
        }
        int good = finish(decoder);
        size_t decoded = decoder->length;
        restart(decoder);
        if (good) {
            *frame = decoder->buffer;
            *frame_length = decoded - EBL_CHECK_LENGTH;
            return at + 1;
        }
    }
    return length;
}
