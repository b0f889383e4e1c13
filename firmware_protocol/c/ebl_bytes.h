/* Numbers to and from little-endian bytes, and the results every call of this folder returns. */
#ifndef SPINDLE_EBL_BYTES_H
#define SPINDLE_EBL_BYTES_H

#include <stdint.h>

typedef enum {
    EBL_OK = 0,
    EBL_ERROR_SPACE = -1,       /* the caller's buffer is too small */
    EBL_ERROR_LENGTH = -2,      /* bytes are missing */
    EBL_ERROR_RESERVED = -3,    /* header bit 2 is set */
    EBL_ERROR_VERSION = -4,     /* another major version */
    EBL_ERROR_UNKNOWN_MSG = -5, /* no such message id */
    EBL_ERROR_SHAPE = -6        /* rows and channels do not fill the payload */
} ebl_result;

uint8_t ebl_get_u8(const uint8_t *bytes);
uint16_t ebl_get_u16(const uint8_t *bytes);
uint32_t ebl_get_u32(const uint8_t *bytes);
uint64_t ebl_get_u64(const uint8_t *bytes);
int16_t ebl_get_i16(const uint8_t *bytes);
int32_t ebl_get_i32(const uint8_t *bytes);
float ebl_get_f32(const uint8_t *bytes);

void ebl_put_u8(uint8_t *bytes, uint8_t value);
void ebl_put_u16(uint8_t *bytes, uint16_t value);
void ebl_put_u32(uint8_t *bytes, uint32_t value);
void ebl_put_u64(uint8_t *bytes, uint64_t value);
void ebl_put_i16(uint8_t *bytes, int16_t value);
void ebl_put_i32(uint8_t *bytes, int32_t value);
void ebl_put_f32(uint8_t *bytes, float value);

#endif
