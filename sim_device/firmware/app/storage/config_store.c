#include "config_store.h"

#include <string.h>

#include "ebl_frame.h"    // ebl_crc32
#include "config_image.h" // config_image_default, config_image_is_valid
#include "flash_verify.h" // STORAGE_OK

#define DEALERS_RECORDS ((1u << EBL_RECORD_CALIBRATION) | (1u << EBL_RECORD_TUNABLE))

size_t config_store_flash_bytes(const hal *board)
{
    return CONFIG_SLOTS * config_slot_stride(board);
}

static uint8_t other_slot(uint8_t slot_index) { return slot_index == 0 ? 1 : 0; }

/* True where no slot has ever counted; a write that was cut short has not. */
static int is_untouched(const config_slot *slots)
{
    for (size_t i = 0; i < CONFIG_SLOTS; i++) {
        int was_first = slots[i].generation <= 1;
        int never = slots[i].state == EBL_SLOT_STATE_EMPTY ||
                    (slots[i].state == EBL_SLOT_STATE_VOID && was_first) ||
                    (slots[i].state == EBL_SLOT_STATE_DAMAGED && !slots[i].is_lost);

        if (!never) return 0;
    }
    return 1;
}

/* The image of this slot; what could not be read, or means nothing here, has its default. Returns
 * the records that are lost. */
static uint8_t image_load(const hal *board, const config_slot *slots, uint8_t index, uint8_t *image,
                          config_tally *tally)
{
    uint8_t lost;

    memset(tally, 0, sizeof *tally);
    config_image_default(image);
    lost = config_slot_read(board, index, &slots[index], &slots[other_slot(index)], image, tally);
    if (lost != 0) config_items_default(image, lost);
    config_items_account(image, tally, CONFIG_RECORDS_ALL & ~lost);
    if (tally->market_unknown) lost |= 1u << EBL_RECORD_MARKET;
    if (config_items_settle(image, tally)) return lost;
    config_items_default(image, DEALERS_RECORDS);
    if (config_image_is_valid(image)) return (uint8_t)(lost | DEALERS_RECORDS);
    config_image_default(image);
    return CONFIG_RECORDS_ALL;
}

/* The confirmed slot of the highest generation, or the defaults. */
static void slot_choose(config_store *store, const hal *board)
{
    config_slot slots[CONFIG_SLOTS];

    store->generation = 0;
    store->slot = CONFIG_STORE_NO_SLOT;
    store->on_trial = 0;
    for (uint8_t i = 0; i < CONFIG_SLOTS; i++) {
        config_slot_look(board, i, &slots[i]);
        if (slots[i].worn_until_s > store->worn_until_s) {
            store->worn_until_s = slots[i].worn_until_s;
        }
        if (slots[i].state != EBL_SLOT_STATE_CONFIRMED) continue;
        if (store->slot != CONFIG_STORE_NO_SLOT && slots[i].generation <= store->generation) {
            continue;
        }
        store->generation = slots[i].generation;
        store->slot = i;
    }
    store->is_provisioned = is_untouched(slots) ? 0 : 1;
    if (store->slot == CONFIG_STORE_NO_SLOT) {
        memset(&store->tally, 0, sizeof store->tally);
        config_image_default(store->image);
        store->lost = CONFIG_RECORDS_ALL;
    } else {
        store->lost = image_load(board, slots, store->slot, store->image, &store->tally);
        /* The other one counted, and may have been newer. */
        if (slots[other_slot(store->slot)].is_lost) store->lost = CONFIG_RECORDS_ALL;
    }
    store->crc32 = ebl_crc32(0, store->image, EBL_IMAGE_LENGTH);
}

void config_store_boot(config_store *store, const hal *board)
{
    store->returned_generation = 0;
    store->worn_until_s = 0;
    for (uint8_t i = 0; i < CONFIG_SLOTS; i++) {
        config_slot seen;

        config_slot_look(board, i, &seen);
        if (seen.state != EBL_SLOT_STATE_PROVISIONAL) continue;
        store->returned_generation = seen.generation;
        (void)config_slot_void(board, i);
    }
    slot_choose(store, board);
}

/* How often the slot was erased so far; a damaged one cannot tell and is taken for its twin. */
static uint32_t erases_so_far(const hal *board, uint8_t slot_index)
{
    config_slot seen;

    config_slot_look(board, slot_index, &seen);
    if (seen.state == EBL_SLOT_STATE_DAMAGED && seen.erases == 0) {
        config_slot_look(board, other_slot(slot_index), &seen);
    }
    return seen.erases;
}

/* What is active is confirmed: nothing is lost any more, and a slot that was can be forgotten. */
static void active_confirmed(config_store *store, const hal *board)
{
    uint8_t other = other_slot(store->slot);
    config_slot seen;

    config_slot_look(board, other, &seen);
    if (seen.is_lost) (void)config_slot_void(board, other);
    store->lost = 0;
    store->is_provisioned = 1;
    memset(&store->tally, 0, sizeof store->tally);
}

int config_store_write(config_store *store, const hal *board, const uint8_t *image, int on_trial)
{
    uint8_t target = other_slot(store->slot);
    config_slot slot = {0};
    int result;

    if (config_slot_stride(board) == 0) return STORAGE_NO_SPACE;
    slot.state = on_trial ? EBL_SLOT_STATE_PROVISIONAL : EBL_SLOT_STATE_CONFIRMED;
    slot.generation = store->generation + 1;
    slot.erases = erases_so_far(board, target) + 1;
    slot.worn_until_s = store->worn_until_s;
    result = config_slot_write(board, target, &slot, image);
    if (result != STORAGE_OK) return result;

    memcpy(store->image, image, EBL_IMAGE_LENGTH);
    store->crc32 = ebl_crc32(0, image, EBL_IMAGE_LENGTH);
    store->generation++;
    store->slot = target;
    store->on_trial = on_trial ? 1 : 0;
    if (!on_trial) active_confirmed(store, board);
    return STORAGE_OK;
}

int config_store_confirm(config_store *store, const hal *board)
{
    int result = config_slot_confirm(board, store->slot);

    if (result != STORAGE_OK) return result;
    store->on_trial = 0;
    active_confirmed(store, board);
    return STORAGE_OK;
}

void config_store_return(config_store *store, const hal *board)
{
    (void)config_slot_void(board, store->slot);
    slot_choose(store, board);
}

int config_store_provision(const hal *board, const uint8_t *image)
{
    config_slot slots[CONFIG_SLOTS];
    config_slot first = {0};

    if (config_slot_stride(board) == 0) return STORAGE_NO_SPACE;
    for (uint8_t i = 0; i < CONFIG_SLOTS; i++) config_slot_look(board, i, &slots[i]);
    if (!is_untouched(slots)) return STORAGE_OK;
    first.state = EBL_SLOT_STATE_CONFIRMED;
    first.generation = 1;
    first.erases = 1;
    return config_slot_write(board, 0, &first, image);
}

int config_store_previous(const config_store *store, const hal *board, uint8_t *image,
                          uint32_t *generation)
{
    uint8_t other = other_slot(store->slot);
    config_slot slots[CONFIG_SLOTS];
    config_tally tally;

    if (store->slot == CONFIG_STORE_NO_SLOT) return 0;
    for (uint8_t i = 0; i < CONFIG_SLOTS; i++) config_slot_look(board, i, &slots[i]);
    if (slots[other].state != EBL_SLOT_STATE_CONFIRMED) return 0;
    *generation = slots[other].generation;
    if (*generation >= store->generation) return 0;
    return image_load(board, slots, other, image, &tally) == 0;
}
