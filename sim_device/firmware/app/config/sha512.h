/* SHA-512 of FIPS 180-4, for what a maker signs. */
#ifndef SPINDLE_SHA512_H
#define SPINDLE_SHA512_H

#include <stddef.h>
#include <stdint.h>

#define SHA512_LENGTH 64
#define SHA512_BLOCK_LENGTH 128

typedef struct {
    uint64_t state[8];
    uint64_t length; /* bytes taken so far */
    uint8_t block[SHA512_BLOCK_LENGTH];
} sha512;

/* Of what lies in several places. */
typedef struct {
    const uint8_t *bytes;
    size_t length;
} sha512_part;

void sha512_of(const sha512_part *parts, size_t count, uint8_t *digest);

void sha512_init(sha512 *hash);
void sha512_update(sha512 *hash, const uint8_t *bytes, size_t length);
void sha512_final(sha512 *hash, uint8_t *digest);

#endif
