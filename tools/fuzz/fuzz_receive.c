/* libFuzzer on the receive path: any bytes in any split, and every frame that comes of it.
 *
 * The first byte is the split. What is decoded is checked, encoded again and must come back. */
#include <stdlib.h>
#include <string.h>

#include "ebl_bytes.h"    // EBL_OK
#include "ebl_frame.h"    // ebl_decoder_feed, ebl_frame_check
#include "ebl_registry.h" // EBL_MTU

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(int holds)
{
    if (!holds) abort();
}

static void comes_back(const uint8_t *frame, size_t length)
{
    uint8_t wire[2 * EBL_MTU];
    uint8_t buffer[EBL_MTU];
    ebl_decoder decoder;
    const uint8_t *again = NULL;
    size_t wire_length = 0, again_length = 0;

    require(ebl_frame_encode(frame, length, wire, sizeof wire, &wire_length) == EBL_OK);
    ebl_decoder_init(&decoder, buffer, sizeof buffer);
    /* The delimiter in front ends an empty stretch and is no frame. */
    (void)ebl_decoder_feed(&decoder, wire, wire_length, &again, &again_length);
    require(again != NULL && again_length == length && memcmp(again, frame, length) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *buffer;
    ebl_decoder decoder;
    size_t at = 1, step;
    uint32_t frames = 0;

    if (size < 2) return 0;
    step = data[0] == 0 ? size : data[0];
    buffer = malloc(EBL_MTU); /* on the heap, so that one byte too many is seen */
    require(buffer != NULL);
    ebl_decoder_init(&decoder, buffer, EBL_MTU);
    while (at < size) {
        size_t end = size - at < step ? size : at + step;

        while (at < end) {
            const uint8_t *frame = NULL;
            size_t length = 0;
            ebl_header header;

            at += ebl_decoder_feed(&decoder, data + at, end - at, &frame, &length);
            if (frame == NULL) continue;
            frames++;
            (void)ebl_frame_check(&header, frame, length);
            comes_back(frame, length);
        }
    }
    require(decoder.counts.frames_ok == frames);
    free(buffer);
    return 0;
}
