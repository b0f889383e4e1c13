/* Throws seeded noise at the unit's codec, every buffer exactly as long as it claims to be. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ebl_bytes.h"    // EBL_OK
#include "ebl_frame.h"    // ebl_decoder_feed, ebl_frame_check
#include "ebl_registry.h" // EBL_MTU
#include "ebl_values.h"   // ebl_image_violations

#define ROUNDS 20000
#define NOISE_LENGTH_MAX 700

static uint32_t state = 2463534242u;

static uint32_t draw(uint32_t below)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state % below;
}

static uint8_t *noise(size_t length, uint32_t below)
{
    uint8_t *bytes = malloc(length > 0 ? length : 1);
    if (bytes == NULL) {
        exit(2);
    }
    for (size_t at = 0; at < length; at++) {
        bytes[at] = (uint8_t)draw(below);
    }
    return bytes;
}

/* A frame of noise, sent and received; its first byte is often that of a real one. */
static int frame_crosses(ebl_decoder *decoder)
{
    ebl_header header;
    const uint8_t *heard = NULL;
    size_t heard_length = 0, wire_length = 0, at = 0;
    size_t length = draw(EBL_MTU - EBL_CHECK_LENGTH + 1);
    size_t capacity = ebl_wire_length_max(length);
    uint8_t *frame = noise(length, draw(2) ? 256 : 3);
    uint8_t *wire = noise(capacity, 1);
    int wrong = 0;

    if (length > 0) {
        frame[0] = (uint8_t)(0x20u | (frame[0] & 0x1bu));
    }
    (void)ebl_frame_check(&header, frame, length);
    wrong |= ebl_frame_encode(frame, length, wire, capacity, &wire_length) != EBL_OK;
    while (at < wire_length) {
        const uint8_t *found;
        size_t found_length;
        at += ebl_decoder_feed(decoder, wire + at, wire_length - at, &found, &found_length);
        if (found != NULL) {
            heard = found;
            heard_length = found_length;
        }
    }
    if (length >= EBL_HEADER_LENGTH) {
        wrong |= heard == NULL || heard_length != length || memcmp(heard, frame, length) != 0;
    }
    free(wire);
    free(frame);
    return wrong;
}

static void noise_is_survived(ebl_decoder *decoder)
{
    ebl_refusal found[4];
    const uint8_t *frame;
    size_t frame_length, at = 0, length = draw(NOISE_LENGTH_MAX);
    uint8_t *bytes = noise(length, draw(2) ? 256 : 6);
    uint8_t *image = noise(EBL_IMAGE_LENGTH, 256);

    while (at < length) {
        at += ebl_decoder_feed(decoder, bytes + at, length - at, &frame, &frame_length);
    }
    (void)ebl_image_violations(image, found, 4);
    free(image);
    free(bytes);
}

int main(void)
{
    uint8_t *buffer = noise(EBL_MTU, 1);
    ebl_decoder decoder;
    int wrong = 0;

    ebl_decoder_init(&decoder, buffer, EBL_MTU);
    for (int round = 0; round < ROUNDS; round++) {
        noise_is_survived(&decoder);
        wrong += frame_crosses(&decoder);
    }
    free(buffer);
    printf("%d of %d frames lost\n", wrong, ROUNDS);
    return wrong != 0;
}
