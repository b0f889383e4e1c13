#include "unlock.h"

#include <string.h>

#include "ebl_bytes.h"  // ebl_put_u32, ebl_put_u64
#include "ebl_values.h" // ebl_band_holds, ebl_element_number
#include "monocypher.h" // crypto_verify64
#include "signature.h"  // SIGNATURE_KEY_LENGTH, signature_is_valid

#define US_PER_S 1000000u
#define UID_LENGTH 12

/* What is signed: "EBL1", uid, nonce, level, expiry, SHA-512 of the staged image. */
enum {
    UID_AT = 4,
    NONCE_AT = UID_AT + UID_LENGTH,
    LEVEL_AT = NONCE_AT + UNLOCK_NONCE_LENGTH,
    EXPIRES_AT = LEVEL_AT + 1,
    DIGEST_AT = EXPIRES_AT + 8,
    MESSAGE_LENGTH = DIGEST_AT + SHA512_LENGTH
};

/* What is kept is what a signature is checked with. */
typedef char a_key_is_a_key[UNLOCK_KEY_LENGTH == SIGNATURE_KEY_LENGTH ? 1 : -1];

/* 1, 2, 4 .. 60 s after 1, 2, 3 .. failures; longer for who does not stop. */
static uint64_t delay_us(uint32_t failures)
{
    uint32_t delay_s = 1;

    if (failures == 0) return 0;
    if (failures > UNLOCK_FAILURES_MANY) return (uint64_t)UNLOCK_DELAY_S_MANY * US_PER_S;
    for (uint32_t i = 1; i < failures && delay_s < UNLOCK_DELAY_S_MAX; i++) delay_s *= 2;
    if (delay_s > UNLOCK_DELAY_S_MAX) delay_s = UNLOCK_DELAY_S_MAX;
    return (uint64_t)delay_s * US_PER_S;
}

static uint64_t now(const hal *board) { return board->now_us(board->context); }

void unlock_boot(unlock *self, const hal *board, size_t reserved)
{
    memset(self, 0, sizeof *self);
    unlock_store_boot(&self->store, board, reserved);
    self->closed_until_us = now(board) + delay_us(self->store.failures);
}

/* OK for a unit that has a key and no delay to sit out. */
static uint8_t lock_is_open_to_attempts(const unlock *self, uint64_t now_us, uint16_t *detail)
{
    *detail = 0;
    if (!self->store.has_key) return EBL_STATUS_NOT_FOUND;
    if (now_us >= self->closed_until_us) return EBL_STATUS_OK;
    *detail = (uint16_t)((self->closed_until_us - now_us + US_PER_S - 1) / US_PER_S);
    return EBL_STATUS_AUTH_DELAY;
}

/* Never the same twice for one that was spent: an attempt moves the sequence, which outlives boots.
 * Chance is not needed, because a token is made for its nonce and cannot be made before it. */
static void nonce_make(unlock *self, uint32_t boot_id, uint64_t now_us)
{
    self->challenges++;
    ebl_put_u32(self->nonce, self->store.sequence);
    ebl_put_u32(self->nonce + 4, boot_id);
    ebl_put_u32(self->nonce + 8, self->challenges);
    ebl_put_u32(self->nonce + 12, (uint32_t)now_us);
}

uint8_t unlock_challenge(unlock *self, const hal *board, uint8_t level,
                         ebl_auth_challenge_response *response, uint16_t *detail)
{
    uint64_t now_us = now(board);
    uint8_t status = lock_is_open_to_attempts(self, now_us, detail);

    if (status != EBL_STATUS_OK) return status;
    if (level != EBL_ACCESS_DEALER && level != EBL_ACCESS_FACTORY) {
        *detail = EBL_ACCESS_FACTORY;
        return EBL_STATUS_RANGE;
    }
    nonce_make(self, board->boot_id, now_us);
    self->challenge_level = level;
    self->nonce_end_us = now_us + (uint64_t)UNLOCK_TTL_S * US_PER_S;
    memcpy(response->nonce, self->nonce, sizeof response->nonce);
    memcpy(response->uid, board->uid, sizeof response->uid);
    response->boot_id = board->boot_id;
    response->level = level;
    response->ttl_s = UNLOCK_TTL_S;
    response->expires_us = self->nonce_end_us;
    return EBL_STATUS_OK;
}

static void image_digest(const uint8_t *image, uint8_t *digest)
{
    const sha512_part whole = {image, EBL_IMAGE_LENGTH};

    sha512_of(&whole, 1, digest);
}

static int token_is_good(const unlock *self, const hal *board, uint8_t level, uint64_t now_us,
                         const ebl_auth_response_request *token, const uint8_t *digest)
{
    uint8_t message[MESSAGE_LENGTH] = {'E', 'B', 'L', '1'};

    memcpy(message + UID_AT, board->uid, UID_LENGTH);
    memcpy(message + NONCE_AT, self->nonce, UNLOCK_NONCE_LENGTH);
    message[LEVEL_AT] = level;
    ebl_put_u64(message + EXPIRES_AT, token->expires_us);
    memcpy(message + DIGEST_AT, digest, SHA512_LENGTH);
    if (!signature_is_valid(token->signature, self->store.key, message, sizeof message)) return 0;
    return now_us < token->expires_us && token->expires_us <= self->nonce_end_us;
}

uint8_t unlock_respond(unlock *self, const hal *board, const ebl_auth_response_request *request,
                       const uint8_t *staged_image, uint16_t *detail)
{
    uint64_t now_us = now(board);
    uint8_t status = lock_is_open_to_attempts(self, now_us, detail);
    uint8_t level = self->challenge_level;
    uint32_t failures = self->store.failures + 1;
    uint8_t digest[SHA512_LENGTH];

    if (status != EBL_STATUS_OK) return status;
    if (level == EBL_ACCESS_RIDER) return EBL_STATUS_STATE;
    (void)unlock_drop(self);
    if (now_us >= self->nonce_end_us) return EBL_STATUS_EXPIRED;
    self->closed_until_us = now_us + delay_us(failures);
    if (unlock_store_failures_write(&self->store, board, failures) < 0) {
        return EBL_STATUS_FLASH_FAIL;
    }
    image_digest(staged_image, digest);
    if (!token_is_good(self, board, level, now_us, request, digest)) {
        *detail = failures < UINT16_MAX ? (uint16_t)failures : UINT16_MAX;
        return EBL_STATUS_AUTH_BAD;
    }
    if (unlock_store_failures_write(&self->store, board, 0) < 0) return EBL_STATUS_FLASH_FAIL;
    self->closed_until_us = now_us;
    self->granted_level = level;
    self->grant_end_us = request->expires_us;
    memcpy(self->granted_digest, digest, sizeof digest);
    return EBL_STATUS_OK;
}

int unlock_permits(const unlock *self, uint8_t level, const uint8_t *image, uint64_t now_us)
{
    uint8_t digest[SHA512_LENGTH];

    if (self->granted_level < level || now_us >= self->grant_end_us) return 0;
    image_digest(image, digest);
    return crypto_verify64(digest, self->granted_digest) == 0;
}

int unlock_drop(unlock *self)
{
    int was_granted = self->granted_level != EBL_ACCESS_RIDER;

    self->challenge_level = EBL_ACCESS_RIDER;
    self->granted_level = EBL_ACCESS_RIDER;
    return was_granted;
}

/* Written so that a value that is no number counts as raised. */
static int is_raised(const ebl_parameter *parameter, const uint8_t *active, const uint8_t *staged)
{
    for (size_t at = 0; at < (size_t)parameter->count * parameter->length;
         at += parameter->length) {
        if (!(ebl_element_number(parameter, staged + at) <=
              ebl_element_number(parameter, active + at))) {
            return 1;
        }
    }
    return 0;
}

uint8_t unlock_level_needed(const uint8_t *active_image, const uint8_t *staged_image)
{
    uint8_t needed = EBL_ACCESS_RIDER;

    for (size_t i = 0; i < EBL_PARAMETER_COUNT; i++) {
        const ebl_parameter *parameter = &ebl_parameters[i];
        const uint8_t *active = active_image + parameter->image_offset;
        const uint8_t *staged = staged_image + parameter->image_offset;

        if (memcmp(active, staged, (size_t)parameter->count * parameter->length) == 0) continue;
        if (parameter->access == EBL_ACCESS_FACTORY) return EBL_ACCESS_FACTORY;
        if ((parameter->flags & EBL_PARAMETER_RATCHET) == 0) continue;
        if (is_raised(parameter, active, staged)) needed = EBL_ACCESS_DEALER;
    }
    for (size_t i = 0; i < EBL_BAND_COUNT; i++) {
        size_t at = ebl_bands[i].offset;

        if (memcmp(active_image + at, staged_image + at, sizeof(float)) == 0) continue;
        if (!ebl_band_holds(&ebl_bands[i], staged_image)) return EBL_ACCESS_FACTORY;
    }
    return needed;
}
