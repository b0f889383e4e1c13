/* Ed25519 of RFC 8032: does the message come from who holds the key? */
#ifndef SPINDLE_SIGNATURE_H
#define SPINDLE_SIGNATURE_H

#include <stddef.h>
#include <stdint.h>

#define SIGNATURE_LENGTH 64
#define SIGNATURE_KEY_LENGTH 32

/* 1 if `signature` is the key's over the message, else 0. Nothing in it is secret. */
int signature_is_valid(const uint8_t *signature, const uint8_t *public_key, const uint8_t *message,
                       size_t length);

#endif
