#include "log_flash.h"

#include <stdlib.h>
#include <string.h>

#define ERASE_US 40000u
#define PROGRAM_US 1000u
#define NEVER UINT32_MAX

static int holds(const log_flash *flash, size_t address, size_t length)
{
    return address <= flash->size && length <= flash->size - address;
}

static int busy(void *context)
{
    const log_flash *flash = context;

    return *flash->clock_us < flash->busy_until_us;
}

/* One byte of wear. False once the power is gone. */
static int step(log_flash *flash)
{
    if (flash->steps_left == 0) return 0;
    if (flash->steps_left != NEVER) flash->steps_left--;
    flash->steps++;
    return 1;
}

static int read_bytes(void *context, size_t address, uint8_t *bytes, size_t length)
{
    const log_flash *flash = context;

    if (busy(context) || !holds(flash, address, length)) return -1;
    memcpy(bytes, flash->bytes + address, length);
    return 0;
}

static void note_change(log_flash *flash, size_t address, size_t length)
{
    flash->changes++;
    if (flash->changed_to == 0 || address < flash->changed_from) flash->changed_from = address;
    if (address + length > flash->changed_to) flash->changed_to = address + length;
}

static int erase(void *context, size_t address)
{
    log_flash *flash = context;

    if (busy(context) || address % flash->block_size != 0) return -1;
    if (!holds(flash, address, flash->block_size)) return -1;
    if (address == flash->worn_address) return -1;
    note_change(flash, address, flash->block_size);
    for (size_t i = 0; i < flash->block_size; i++) {
        if (!step(flash)) return -1;
        flash->bytes[address + i] = 0xFF;
    }
    flash->busy_until_us = *flash->clock_us + ERASE_US;
    return 0;
}

static int program(void *context, size_t address, const uint8_t *bytes, size_t length)
{
    log_flash *flash = context;

    if (busy(context) || !holds(flash, address, length)) return -1;
    note_change(flash, address, length);
    for (size_t i = 0; i < length; i++) {
        if (!step(flash)) return -1;
        flash->bytes[address + i] &= bytes[i];
    }
    flash->busy_until_us = *flash->clock_us + PROGRAM_US;
    return 0;
}

int log_flash_open(log_flash *flash, size_t block_size, size_t size, const uint8_t *image)
{
    memset(flash, 0, sizeof *flash);
    flash->bytes = malloc(size > 0 ? size : 1);
    if (flash->bytes == NULL) return -1;
    if (image != NULL) {
        memcpy(flash->bytes, image, size);
    } else {
        memset(flash->bytes, 0xFF, size);
    }
    flash->block_size = block_size;
    flash->size = size;
    flash->worn_address = SIZE_MAX;
    log_flash_power_on(flash);
    return 0;
}

void log_flash_close(log_flash *flash)
{
    free(flash->bytes);
    flash->bytes = NULL;
}

void log_flash_connect(log_flash *flash, hal *board, const uint64_t *clock_us)
{
    flash->clock_us = clock_us;
    board->log_context = flash;
    board->log_block_size = flash->block_size;
    board->log_size = flash->size;
    board->log_busy = busy;
    board->log_read = read_bytes;
    board->log_erase = erase;
    board->log_program = program;
}

void log_flash_power_on(log_flash *flash)
{
    flash->busy_until_us = 0;
    flash->steps = 0;
    flash->steps_left = NEVER;
}

size_t log_flash_changed(log_flash *flash, size_t *address)
{
    size_t length = flash->changed_to - flash->changed_from;

    *address = flash->changed_from;
    flash->changed_from = 0;
    flash->changed_to = 0;
    return length;
}
