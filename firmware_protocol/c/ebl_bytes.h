/* Numbers to and from little-endian bytes, so that neither alignment nor the host's byte order
 * matters. Inline, because a processor with unaligned access needs one instruction: less than a
 * call. */
#ifndef SPINDLE_EBL_BYTES_H
#define SPINDLE_EBL_BYTES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "ebl_result.h" // EBL_OK

static inline uint8_t ebl_get_u8(const uint8_t *bytes) { return bytes[0]; }

static inline uint16_t ebl_get_u16(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] | (bytes[1] << 8));
}

static inline uint32_t ebl_get_u32(const uint8_t *bytes)
{
    return (uint32_t)ebl_get_u16(bytes) | ((uint32_t)ebl_get_u16(bytes + 2) << 16);
}

static inline uint64_t ebl_get_u64(const uint8_t *bytes)
{
    return (uint64_t)ebl_get_u32(bytes) | ((uint64_t)ebl_get_u32(bytes + 4) << 32);
}

static inline int16_t ebl_get_i16(const uint8_t *bytes)
{
    uint16_t bits = ebl_get_u16(bytes);
    int16_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline int32_t ebl_get_i32(const uint8_t *bytes)
{
    uint32_t bits = ebl_get_u32(bytes);
    int32_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline float ebl_get_f32(const uint8_t *bytes)
{
    uint32_t bits = ebl_get_u32(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline void ebl_put_u8(uint8_t *bytes, uint8_t value) { bytes[0] = value; }

static inline void ebl_put_u16(uint8_t *bytes, uint16_t value)
{
    bytes[0] = (uint8_t)(value & 0xffu);
    bytes[1] = (uint8_t)(value >> 8);
}

static inline void ebl_put_u32(uint8_t *bytes, uint32_t value)
{
    ebl_put_u16(bytes, (uint16_t)(value & 0xffffu));
    ebl_put_u16(bytes + 2, (uint16_t)(value >> 16));
}

static inline void ebl_put_u64(uint8_t *bytes, uint64_t value)
{
    ebl_put_u32(bytes, (uint32_t)(value & 0xffffffffu));
    ebl_put_u32(bytes + 4, (uint32_t)(value >> 32));
}

static inline void ebl_put_i16(uint8_t *bytes, int16_t value)
{
    uint16_t bits;
    memcpy(&bits, &value, sizeof bits);
    ebl_put_u16(bytes, bits);
}

static inline void ebl_put_i32(uint8_t *bytes, int32_t value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    ebl_put_u32(bytes, bits);
}

static inline void ebl_put_f32(uint8_t *bytes, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    ebl_put_u32(bytes, bits);
}

/* Numbers of `size` bytes each, `length` bytes in all, to or from their little-endian bytes: the
 * same either way. */
static inline void ebl_copy_numbers(uint8_t *to, const uint8_t *from, size_t size, size_t length)
{
    const uint16_t one = 1;
    uint8_t first;

    memcpy(&first, &one, sizeof first);
    const size_t flip = first == 1 ? 0 : size - 1; /* a processor that is big-endian */
    for (size_t at = 0; at < length; at++) {
        to[at] = from[at ^ flip];
    }
}

#endif
