#include "sha512.h"

#include <string.h>

#define ROUNDS 80
#define LENGTH_AT 112 /* where the last block keeps the length, of which 64 bits are enough */

/* The first 64 bits behind the point of the cube roots of the first 80 primes. */
static const uint64_t round_constants[ROUNDS] = {
    0x428a2f98d728ae22u, 0x7137449123ef65cdu, 0xb5c0fbcfec4d3b2fu, 0xe9b5dba58189dbbcu,
    0x3956c25bf348b538u, 0x59f111f1b605d019u, 0x923f82a4af194f9bu, 0xab1c5ed5da6d8118u,
    0xd807aa98a3030242u, 0x12835b0145706fbeu, 0x243185be4ee4b28cu, 0x550c7dc3d5ffb4e2u,
    0x72be5d74f27b896fu, 0x80deb1fe3b1696b1u, 0x9bdc06a725c71235u, 0xc19bf174cf692694u,
    0xe49b69c19ef14ad2u, 0xefbe4786384f25e3u, 0x0fc19dc68b8cd5b5u, 0x240ca1cc77ac9c65u,
    0x2de92c6f592b0275u, 0x4a7484aa6ea6e483u, 0x5cb0a9dcbd41fbd4u, 0x76f988da831153b5u,
    0x983e5152ee66dfabu, 0xa831c66d2db43210u, 0xb00327c898fb213fu, 0xbf597fc7beef0ee4u,
    0xc6e00bf33da88fc2u, 0xd5a79147930aa725u, 0x06ca6351e003826fu, 0x142929670a0e6e70u,
    0x27b70a8546d22ffcu, 0x2e1b21385c26c926u, 0x4d2c6dfc5ac42aedu, 0x53380d139d95b3dfu,
    0x650a73548baf63deu, 0x766a0abb3c77b2a8u, 0x81c2c92e47edaee6u, 0x92722c851482353bu,
    0xa2bfe8a14cf10364u, 0xa81a664bbc423001u, 0xc24b8b70d0f89791u, 0xc76c51a30654be30u,
    0xd192e819d6ef5218u, 0xd69906245565a910u, 0xf40e35855771202au, 0x106aa07032bbd1b8u,
    0x19a4c116b8d2d0c8u, 0x1e376c085141ab53u, 0x2748774cdf8eeb99u, 0x34b0bcb5e19b48a8u,
    0x391c0cb3c5c95a63u, 0x4ed8aa4ae3418acbu, 0x5b9cca4f7763e373u, 0x682e6ff3d6b2b8a3u,
    0x748f82ee5defb2fcu, 0x78a5636f43172f60u, 0x84c87814a1f0ab72u, 0x8cc702081a6439ecu,
    0x90befffa23631e28u, 0xa4506cebde82bde9u, 0xbef9a3f7b2c67915u, 0xc67178f2e372532bu,
    0xca273eceea26619cu, 0xd186b8c721c0c207u, 0xeada7dd6cde0eb1eu, 0xf57d4f7fee6ed178u,
    0x06f067aa72176fbau, 0x0a637dc5a2c898a6u, 0x113f9804bef90daeu, 0x1b710b35131c471bu,
    0x28db77f523047d84u, 0x32caab7b40c72493u, 0x3c9ebe0a15c9bebcu, 0x431d67c49c100d4cu,
    0x4cc5d4becb3e42b6u, 0x597f299cfc657e2au, 0x5fcb6fab3ad6faecu, 0x6c44198c4a475817u,
};

/* The same of the square roots of the first 8. */
static const uint64_t state_at_start[8] = {
    0x6a09e667f3bcc908u, 0xbb67ae8584caa73bu, 0x3c6ef372fe94f82bu, 0xa54ff53a5f1d36f1u,
    0x510e527fade682d1u, 0x9b05688c2b3e6c1fu, 0x1f83d9abfb41bd6bu, 0x5be0cd19137e2179u,
};

static uint64_t rotated(uint64_t value, unsigned bits)
{
    return (value >> bits) | (value << (64 - bits));
}

static uint64_t big_endian_get(const uint8_t *bytes)
{
    uint64_t value = 0;

    for (size_t i = 0; i < 8; i++) value = (value << 8) | bytes[i];
    return value;
}

static void big_endian_put(uint8_t *bytes, uint64_t value)
{
    for (size_t i = 8; i-- > 0; value >>= 8) bytes[i] = (uint8_t)value;
}

/* Word t of the message schedule, kept in a ring of 16 so that the stack stays small. */
static uint64_t schedule_next(uint64_t *words, size_t t)
{
    uint64_t before_15 = words[(t + 1) % 16];
    uint64_t before_2 = words[(t + 14) % 16];

    if (t < 16) return words[t];
    words[t % 16] += (rotated(before_15, 1) ^ rotated(before_15, 8) ^ (before_15 >> 7)) +
                     words[(t + 9) % 16] +
                     (rotated(before_2, 19) ^ rotated(before_2, 61) ^ (before_2 >> 6));
    return words[t % 16];
}

static void block_take(sha512 *hash)
{
    uint64_t words[16];
    uint64_t s[8];

    for (size_t i = 0; i < 16; i++) words[i] = big_endian_get(hash->block + 8 * i);
    memcpy(s, hash->state, sizeof s);
    for (size_t t = 0; t < ROUNDS; t++) {
        uint64_t first = s[7] + (rotated(s[4], 14) ^ rotated(s[4], 18) ^ rotated(s[4], 41)) +
                         ((s[4] & s[5]) ^ (~s[4] & s[6])) + round_constants[t] +
                         schedule_next(words, t);
        uint64_t second = (rotated(s[0], 28) ^ rotated(s[0], 34) ^ rotated(s[0], 39)) +
                          ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));

        memmove(s + 1, s, 7 * sizeof s[0]);
        s[4] += first;
        s[0] = first + second;
    }
    for (size_t i = 0; i < 8; i++) hash->state[i] += s[i];
}

void sha512_init(sha512 *hash)
{
    memcpy(hash->state, state_at_start, sizeof hash->state);
    hash->length = 0;
}

void sha512_update(sha512 *hash, const uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        hash->block[hash->length % SHA512_BLOCK_LENGTH] = bytes[i];
        hash->length++;
        if (hash->length % SHA512_BLOCK_LENGTH == 0) block_take(hash);
    }
}

void sha512_final(sha512 *hash, uint8_t *digest)
{
    static const uint8_t one_bit = 0x80;
    static const uint8_t zero = 0;
    uint64_t bits = hash->length * 8;

    sha512_update(hash, &one_bit, 1);
    while (hash->length % SHA512_BLOCK_LENGTH != LENGTH_AT) sha512_update(hash, &zero, 1);
    memset(hash->block + LENGTH_AT, 0, SHA512_BLOCK_LENGTH - LENGTH_AT);
    big_endian_put(hash->block + SHA512_BLOCK_LENGTH - 8, bits);
    block_take(hash);
    for (size_t i = 0; i < 8; i++) big_endian_put(digest + 8 * i, hash->state[i]);
}

void sha512_of(const sha512_part *parts, size_t count, uint8_t *digest)
{
    sha512 hash;

    sha512_init(&hash);
    for (size_t i = 0; i < count; i++) sha512_update(&hash, parts[i].bytes, parts[i].length);
    sha512_final(&hash, digest);
}
