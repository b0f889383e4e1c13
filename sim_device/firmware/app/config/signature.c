#include "signature.h"

#include "monocypher.h" // crypto_eddsa_reduce, crypto_eddsa_check_equation
#include "sha512.h"     // sha512_of

#define POINT_LENGTH 32 /* R, the first half of a signature */

int signature_is_valid(const uint8_t *signature, const uint8_t *public_key, const uint8_t *message,
                       size_t length)
{
    const sha512_part parts[] = {
        {signature, POINT_LENGTH}, {public_key, SIGNATURE_KEY_LENGTH}, {message, length}};
    uint8_t digest[SHA512_LENGTH];
    uint8_t reduced[32];

    sha512_of(parts, sizeof parts / sizeof parts[0], digest);
    crypto_eddsa_reduce(reduced, digest);
    return crypto_eddsa_check_equation(signature, public_key, reduced) == 0;
}
