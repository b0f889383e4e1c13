#include "flash.h"

#include <string.h>

#include "clock.h" // clock_now_us

/* Geometry as on the host's board: a data flash in the chip, a serial flash beside it. */
#define CONFIG_BLOCK_BYTES 1024u
#define CONFIG_BYTES 8192u
#define LOG_BLOCK_BYTES 4096u
#define LOG_BYTES 4194304u

/* A serial flash takes its time; nothing waits for it. */
#define LOG_ERASE_US 40000u
#define LOG_PROGRAM_US 1000u

/* Where QEMU's -machine memory-backend file begins. */
#define MEMORY ((uint8_t *)0x21000000u)
#define CONFIG (MEMORY + 4096u)
#define LOG (MEMORY + 1048576u)

static uint64_t log_busy_until_us;

static int config_read(void *context, size_t address, uint8_t *bytes, size_t length)
{
    (void)context;
    if (address > CONFIG_BYTES || length > CONFIG_BYTES - address) return -1;
    memcpy(bytes, CONFIG + address, length);
    return 0;
}

static int config_erase(void *context, size_t address)
{
    (void)context;
    if (address >= CONFIG_BYTES || address % CONFIG_BLOCK_BYTES != 0) return -1;
    memset(CONFIG + address, 0xFF, CONFIG_BLOCK_BYTES);
    return 0;
}

static int config_program(void *context, size_t address, const uint8_t *bytes, size_t length)
{
    (void)context;
    if (address > CONFIG_BYTES || length > CONFIG_BYTES - address) return -1;
    for (size_t i = 0; i < length; i++) CONFIG[address + i] &= bytes[i];
    return 0;
}

static int log_busy(void *context)
{
    (void)context;
    return clock_now_us() < log_busy_until_us;
}

static int log_read(void *context, size_t address, uint8_t *bytes, size_t length)
{
    if (log_busy(context) || address > LOG_BYTES || length > LOG_BYTES - address) return -1;
    memcpy(bytes, LOG + address, length);
    return 0;
}

static int log_erase(void *context, size_t address)
{
    if (log_busy(context) || address >= LOG_BYTES || address % LOG_BLOCK_BYTES != 0) return -1;
    memset(LOG + address, 0xFF, LOG_BLOCK_BYTES);
    log_busy_until_us = clock_now_us() + LOG_ERASE_US;
    return 0;
}

static int log_program(void *context, size_t address, const uint8_t *bytes, size_t length)
{
    if (log_busy(context) || address > LOG_BYTES || length > LOG_BYTES - address) return -1;
    for (size_t i = 0; i < length; i++) LOG[address + i] &= bytes[i];
    log_busy_until_us = clock_now_us() + LOG_PROGRAM_US;
    return 0;
}

static flash_identity *identity_boot(void)
{
    flash_identity *identity = (flash_identity *)(void *)MEMORY;

    if (identity->magic != FLASH_MAGIC) {
        memset(identity, 0, sizeof *identity);
        identity->magic = FLASH_MAGIC;
        memcpy(identity->uid, "mps2-an386-1", sizeof identity->uid);
    }
    if (identity->boots == 0) {
        memset(CONFIG, 0xFF, CONFIG_BYTES);
        memset(LOG, 0xFF, LOG_BYTES);
    }
    identity->boots++;
    return identity;
}

const flash_identity *flash_connect(hal *board)
{
    flash_identity *identity = identity_boot();

    board->flash_block_size = CONFIG_BLOCK_BYTES;
    board->flash_size = CONFIG_BYTES;
    board->flash_read = config_read;
    board->flash_erase = config_erase;
    board->flash_program = config_program;
    board->log_block_size = LOG_BLOCK_BYTES;
    board->log_size = LOG_BYTES;
    board->log_busy = log_busy;
    board->log_read = log_read;
    board->log_erase = log_erase;
    board->log_program = log_program;
    board->uid = identity->uid;
    board->boot_id = identity->boots;
    return identity;
}
