/* Who may raise a limit: whoever brings the maker's signature over exactly what is to be written.
 *
 * A nonce is good for one attempt. Each attempt is written to flash as failed before it is looked
 * at, so that cutting the power buys nothing; the delay it earns starts anew with every boot. A
 * unit without a key cannot be unlocked at all. */
#ifndef SPINDLE_UNLOCK_H
#define SPINDLE_UNLOCK_H

#include <stddef.h>
#include <stdint.h>

#include "ebl_registry.h"         // ebl_auth_challenge_response
#include "hal.h"                  // hal
#include "sha512.h"               // SHA512_LENGTH
#include "storage/unlock_store.h" // unlock_store

#define UNLOCK_TTL_S 60
#define UNLOCK_DELAY_S_MAX 60

/* Each attempt is a record in flash, 85 in a block of 1 KB. One a minute would spend the 10,000
 * erases of both blocks in 3.2 years: who failed so often waits longer, and they last for 12. */
#define UNLOCK_FAILURES_MANY 100000u
#define UNLOCK_DELAY_S_MANY 240

#define UNLOCK_NONCE_LENGTH 16

typedef struct {
    unlock_store store;
    uint64_t closed_until_us;
    uint32_t challenges;     /* since boot */
    uint8_t challenge_level; /* ebl_access; RIDER: no nonce is out */
    uint8_t nonce[UNLOCK_NONCE_LENGTH];
    uint64_t nonce_end_us;
    uint8_t granted_level; /* ebl_access; RIDER: nothing is granted */
    uint8_t granted_digest[SHA512_LENGTH];
    uint64_t grant_end_us;
} unlock;

/* `reserved`: bytes at the start of the flash that are not for unlocking. */
void unlock_boot(unlock *self, const hal *board, size_t reserved);

/* Both return an ebl_status and fill `detail` where it is not OK. */
uint8_t unlock_challenge(unlock *self, const hal *board, uint8_t level,
                         ebl_auth_challenge_response *response, uint16_t *detail);
uint8_t unlock_respond(unlock *self, const hal *board, const ebl_auth_response_request *request,
                       const uint8_t *staged_image, uint16_t *detail);

/* True while a token allows this image at this level. */
int unlock_permits(const unlock *self, uint8_t level, const uint8_t *image, uint64_t now_us);

/* Takes back grant and nonce. True if something was granted. */
int unlock_drop(unlock *self);

/* The level a change needs beyond a dealer's tools: FACTORY for a factory's parameter and for a
 * value that leaves its band, DEALER for a ratchet that goes up, RIDER for none. */
uint8_t unlock_level_needed(const uint8_t *active_image, const uint8_t *staged_image);

#endif
