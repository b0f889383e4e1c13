/* Generated from registry.toml by `make gen`; change the registry, not this file. */
#include "ebl_registry.h"

#include <string.h>

#include "ebl_bytes.h" // ebl_get_u16, ebl_put_u16, EBL_OK

int ebl_hello_request_get(ebl_hello_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 14) {
        return EBL_ERROR_LENGTH;
    }
    message->major_min = ebl_get_u8(bytes + 0);
    message->major_max = ebl_get_u8(bytes + 1);
    message->host_flags = ebl_get_u16(bytes + 2);
    message->host_mtu = ebl_get_u16(bytes + 4);
    memcpy(message->host_nonce, bytes + 6, 8);
    return EBL_OK;
}

int ebl_hello_request_put(const ebl_hello_request *message, uint8_t *bytes, size_t capacity,
                         size_t *length)
{
    if (capacity < 14) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u8(bytes + 0, message->major_min);
    ebl_put_u8(bytes + 1, message->major_max);
    ebl_put_u16(bytes + 2, message->host_flags);
    ebl_put_u16(bytes + 4, message->host_mtu);
    memcpy(bytes + 6, message->host_nonce, 8);
    *length = 14;
    return EBL_OK;
}

int ebl_hello_response_get(ebl_hello_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 75) {
        return EBL_ERROR_LENGTH;
    }
    message->major = ebl_get_u8(bytes + 0);
    message->minor = ebl_get_u8(bytes + 1);
    message->device_class = ebl_get_u8(bytes + 2);
    message->hardware_revision = ebl_get_u16(bytes + 3);
    for (size_t i = 0; i < 3; i++) {
        message->firmware_version[i] = ebl_get_u16(bytes + 5 + 2 * i);
    }
    memcpy(message->git, bytes + 11, 8);
    memcpy(message->uid, bytes + 19, 12);
    message->boot_id = ebl_get_u32(bytes + 31);
    message->session_id = ebl_get_u32(bytes + 35);
    memcpy(message->schema_hash, bytes + 39, 8);
    message->config_generation = ebl_get_u32(bytes + 47);
    message->config_crc32 = ebl_get_u32(bytes + 51);
    message->rx_mtu = ebl_get_u16(bytes + 55);
    message->tx_mtu = ebl_get_u16(bytes + 57);
    message->max_outstanding = ebl_get_u8(bytes + 59);
    message->access = ebl_get_u8(bytes + 60);
    message->baud_bitmap = ebl_get_u16(bytes + 61);
    message->features = ebl_get_u32(bytes + 63);
    message->uptime_us = ebl_get_u64(bytes + 67);
    return EBL_OK;
}

int ebl_hello_response_put(const ebl_hello_response *message, uint8_t *bytes, size_t capacity,
                          size_t *length)
{
    if (capacity < 75) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u8(bytes + 0, message->major);
    ebl_put_u8(bytes + 1, message->minor);
    ebl_put_u8(bytes + 2, message->device_class);
    ebl_put_u16(bytes + 3, message->hardware_revision);
    for (size_t i = 0; i < 3; i++) {
        ebl_put_u16(bytes + 5 + 2 * i, message->firmware_version[i]);
    }
    memcpy(bytes + 11, message->git, 8);
    memcpy(bytes + 19, message->uid, 12);
    ebl_put_u32(bytes + 31, message->boot_id);
    ebl_put_u32(bytes + 35, message->session_id);
    memcpy(bytes + 39, message->schema_hash, 8);
    ebl_put_u32(bytes + 47, message->config_generation);
    ebl_put_u32(bytes + 51, message->config_crc32);
    ebl_put_u16(bytes + 55, message->rx_mtu);
    ebl_put_u16(bytes + 57, message->tx_mtu);
    ebl_put_u8(bytes + 59, message->max_outstanding);
    ebl_put_u8(bytes + 60, message->access);
    ebl_put_u16(bytes + 61, message->baud_bitmap);
    ebl_put_u32(bytes + 63, message->features);
    ebl_put_u64(bytes + 67, message->uptime_us);
    *length = 75;
    return EBL_OK;
}

int ebl_schema_read_request_get(ebl_schema_read_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 6) {
        return EBL_ERROR_LENGTH;
    }
    message->offset = ebl_get_u32(bytes + 0);
    message->length = ebl_get_u16(bytes + 4);
    return EBL_OK;
}

int ebl_schema_read_request_put(const ebl_schema_read_request *message, uint8_t *bytes, size_t capacity,
                               size_t *length)
{
    if (capacity < 6) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->offset);
    ebl_put_u16(bytes + 4, message->length);
    *length = 6;
    return EBL_OK;
}

int ebl_schema_read_response_get(ebl_schema_read_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 4) {
        return EBL_ERROR_LENGTH;
    }
    message->total_length = ebl_get_u32(bytes + 0);
    message->data = bytes + 4;
    message->data_length = length - 4;
    return EBL_OK;
}

int ebl_schema_read_response_put(const ebl_schema_read_response *message, uint8_t *bytes, size_t capacity,
                                size_t *length)
{
    if (capacity < 4 || capacity - 4 < message->data_length) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->total_length);
    if (message->data_length > 0) {
        memcpy(bytes + 4, message->data, message->data_length);
    }
    *length = 4 + message->data_length;
    return EBL_OK;
}

int ebl_stats_response_get(ebl_stats_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 20) {
        return EBL_ERROR_LENGTH;
    }
    message->frames_ok = ebl_get_u32(bytes + 0);
    message->crc_errors = ebl_get_u32(bytes + 4);
    message->cobs_errors = ebl_get_u32(bytes + 8);
    message->overflows = ebl_get_u32(bytes + 12);
    message->dropped_tx = ebl_get_u32(bytes + 16);
    return EBL_OK;
}

int ebl_stats_response_put(const ebl_stats_response *message, uint8_t *bytes, size_t capacity,
                          size_t *length)
{
    if (capacity < 20) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->frames_ok);
    ebl_put_u32(bytes + 4, message->crc_errors);
    ebl_put_u32(bytes + 8, message->cobs_errors);
    ebl_put_u32(bytes + 12, message->overflows);
    ebl_put_u32(bytes + 16, message->dropped_tx);
    *length = 20;
    return EBL_OK;
}

int ebl_cfg_info_response_get(ebl_cfg_info_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 11) {
        return EBL_ERROR_LENGTH;
    }
    message->generation = ebl_get_u32(bytes + 0);
    message->crc32 = ebl_get_u32(bytes + 4);
    message->image_length = ebl_get_u16(bytes + 8);
    message->state = ebl_get_u8(bytes + 10);
    return EBL_OK;
}

int ebl_cfg_info_response_put(const ebl_cfg_info_response *message, uint8_t *bytes, size_t capacity,
                             size_t *length)
{
    if (capacity < 11) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->generation);
    ebl_put_u32(bytes + 4, message->crc32);
    ebl_put_u16(bytes + 8, message->image_length);
    ebl_put_u8(bytes + 10, message->state);
    *length = 11;
    return EBL_OK;
}

int ebl_cfg_read_request_get(ebl_cfg_read_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 5) {
        return EBL_ERROR_LENGTH;
    }
    message->bank = ebl_get_u8(bytes + 0);
    message->offset = ebl_get_u16(bytes + 1);
    message->length = ebl_get_u16(bytes + 3);
    return EBL_OK;
}

int ebl_cfg_read_request_put(const ebl_cfg_read_request *message, uint8_t *bytes, size_t capacity,
                            size_t *length)
{
    if (capacity < 5) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u8(bytes + 0, message->bank);
    ebl_put_u16(bytes + 1, message->offset);
    ebl_put_u16(bytes + 3, message->length);
    *length = 5;
    return EBL_OK;
}

int ebl_cfg_read_response_get(ebl_cfg_read_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 6) {
        return EBL_ERROR_LENGTH;
    }
    message->generation = ebl_get_u32(bytes + 0);
    message->total_length = ebl_get_u16(bytes + 4);
    message->data = bytes + 6;
    message->data_length = length - 6;
    return EBL_OK;
}

int ebl_cfg_read_response_put(const ebl_cfg_read_response *message, uint8_t *bytes, size_t capacity,
                             size_t *length)
{
    if (capacity < 6 || capacity - 6 < message->data_length) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->generation);
    ebl_put_u16(bytes + 4, message->total_length);
    if (message->data_length > 0) {
        memcpy(bytes + 6, message->data, message->data_length);
    }
    *length = 6 + message->data_length;
    return EBL_OK;
}

int ebl_cfg_begin_request_get(ebl_cfg_begin_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 8) {
        return EBL_ERROR_LENGTH;
    }
    message->base_generation = ebl_get_u32(bytes + 0);
    message->base_crc32 = ebl_get_u32(bytes + 4);
    return EBL_OK;
}

int ebl_cfg_begin_request_put(const ebl_cfg_begin_request *message, uint8_t *bytes, size_t capacity,
                             size_t *length)
{
    if (capacity < 8) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->base_generation);
    ebl_put_u32(bytes + 4, message->base_crc32);
    *length = 8;
    return EBL_OK;
}

int ebl_cfg_begin_response_get(ebl_cfg_begin_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 4) {
        return EBL_ERROR_LENGTH;
    }
    message->transaction = ebl_get_u16(bytes + 0);
    message->lease_ms = ebl_get_u16(bytes + 2);
    return EBL_OK;
}

int ebl_cfg_begin_response_put(const ebl_cfg_begin_response *message, uint8_t *bytes, size_t capacity,
                              size_t *length)
{
    if (capacity < 4) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->transaction);
    ebl_put_u16(bytes + 2, message->lease_ms);
    *length = 4;
    return EBL_OK;
}

int ebl_cfg_set_request_get(ebl_cfg_set_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->transaction = ebl_get_u16(bytes + 0);
    message->items = bytes + 2;
    message->items_length = length - 2;
    return EBL_OK;
}

int ebl_cfg_set_request_put(const ebl_cfg_set_request *message, uint8_t *bytes, size_t capacity,
                           size_t *length)
{
    if (capacity < 2 || capacity - 2 < message->items_length) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->transaction);
    if (message->items_length > 0) {
        memcpy(bytes + 2, message->items, message->items_length);
    }
    *length = 2 + message->items_length;
    return EBL_OK;
}

int ebl_cfg_validate_request_get(ebl_cfg_validate_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->transaction = ebl_get_u16(bytes + 0);
    return EBL_OK;
}

int ebl_cfg_validate_request_put(const ebl_cfg_validate_request *message, uint8_t *bytes, size_t capacity,
                                size_t *length)
{
    if (capacity < 2) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->transaction);
    *length = 2;
    return EBL_OK;
}

int ebl_cfg_staged_crc_request_get(ebl_cfg_staged_crc_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->transaction = ebl_get_u16(bytes + 0);
    return EBL_OK;
}

int ebl_cfg_staged_crc_request_put(const ebl_cfg_staged_crc_request *message, uint8_t *bytes, size_t capacity,
                                  size_t *length)
{
    if (capacity < 2) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->transaction);
    *length = 2;
    return EBL_OK;
}

int ebl_cfg_staged_crc_response_get(ebl_cfg_staged_crc_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 4) {
        return EBL_ERROR_LENGTH;
    }
    message->crc32 = ebl_get_u32(bytes + 0);
    return EBL_OK;
}

int ebl_cfg_staged_crc_response_put(const ebl_cfg_staged_crc_response *message, uint8_t *bytes, size_t capacity,
                                   size_t *length)
{
    if (capacity < 4) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->crc32);
    *length = 4;
    return EBL_OK;
}

int ebl_cfg_commit_request_get(ebl_cfg_commit_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 8) {
        return EBL_ERROR_LENGTH;
    }
    message->transaction = ebl_get_u16(bytes + 0);
    message->staged_crc32 = ebl_get_u32(bytes + 2);
    message->flags = ebl_get_u8(bytes + 6);
    message->confirm_s = ebl_get_u8(bytes + 7);
    return EBL_OK;
}

int ebl_cfg_commit_request_put(const ebl_cfg_commit_request *message, uint8_t *bytes, size_t capacity,
                              size_t *length)
{
    if (capacity < 8) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->transaction);
    ebl_put_u32(bytes + 2, message->staged_crc32);
    ebl_put_u8(bytes + 6, message->flags);
    ebl_put_u8(bytes + 7, message->confirm_s);
    *length = 8;
    return EBL_OK;
}

int ebl_cfg_commit_response_get(ebl_cfg_commit_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 9) {
        return EBL_ERROR_LENGTH;
    }
    message->generation = ebl_get_u32(bytes + 0);
    message->crc32 = ebl_get_u32(bytes + 4);
    message->state = ebl_get_u8(bytes + 8);
    return EBL_OK;
}

int ebl_cfg_commit_response_put(const ebl_cfg_commit_response *message, uint8_t *bytes, size_t capacity,
                               size_t *length)
{
    if (capacity < 9) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->generation);
    ebl_put_u32(bytes + 4, message->crc32);
    ebl_put_u8(bytes + 8, message->state);
    *length = 9;
    return EBL_OK;
}

int ebl_cfg_abort_request_get(ebl_cfg_abort_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->transaction = ebl_get_u16(bytes + 0);
    return EBL_OK;
}

int ebl_cfg_abort_request_put(const ebl_cfg_abort_request *message, uint8_t *bytes, size_t capacity,
                             size_t *length)
{
    if (capacity < 2) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->transaction);
    *length = 2;
    return EBL_OK;
}

int ebl_str_subscribe_request_get(ebl_str_subscribe_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 6) {
        return EBL_ERROR_LENGTH;
    }
    message->stream_id = ebl_get_u8(bytes + 0);
    message->divider = ebl_get_u16(bytes + 1);
    message->batch = ebl_get_u8(bytes + 3);
    message->encoding = ebl_get_u8(bytes + 4);
    message->lease_s = ebl_get_u8(bytes + 5);
    message->channel_ids = bytes + 6;
    message->channel_ids_length = length - 6;
    return EBL_OK;
}

int ebl_str_subscribe_request_put(const ebl_str_subscribe_request *message, uint8_t *bytes, size_t capacity,
                                 size_t *length)
{
    if (capacity < 6 || capacity - 6 < message->channel_ids_length) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u8(bytes + 0, message->stream_id);
    ebl_put_u16(bytes + 1, message->divider);
    ebl_put_u8(bytes + 3, message->batch);
    ebl_put_u8(bytes + 4, message->encoding);
    ebl_put_u8(bytes + 5, message->lease_s);
    if (message->channel_ids_length > 0) {
        memcpy(bytes + 6, message->channel_ids, message->channel_ids_length);
    }
    *length = 6 + message->channel_ids_length;
    return EBL_OK;
}

int ebl_str_subscribe_response_get(ebl_str_subscribe_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 12) {
        return EBL_ERROR_LENGTH;
    }
    message->period_us = ebl_get_u32(bytes + 0);
    message->batch = ebl_get_u8(bytes + 4);
    message->epoch = ebl_get_u8(bytes + 5);
    message->start_seq = ebl_get_u16(bytes + 6);
    message->bytes_per_s = ebl_get_u32(bytes + 8);
    return EBL_OK;
}

int ebl_str_subscribe_response_put(const ebl_str_subscribe_response *message, uint8_t *bytes, size_t capacity,
                                  size_t *length)
{
    if (capacity < 12) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->period_us);
    ebl_put_u8(bytes + 4, message->batch);
    ebl_put_u8(bytes + 5, message->epoch);
    ebl_put_u16(bytes + 6, message->start_seq);
    ebl_put_u32(bytes + 8, message->bytes_per_s);
    *length = 12;
    return EBL_OK;
}

int ebl_str_unsubscribe_request_get(ebl_str_unsubscribe_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 1) {
        return EBL_ERROR_LENGTH;
    }
    message->stream_id = ebl_get_u8(bytes + 0);
    return EBL_OK;
}

int ebl_str_unsubscribe_request_put(const ebl_str_unsubscribe_request *message, uint8_t *bytes, size_t capacity,
                                   size_t *length)
{
    if (capacity < 1) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u8(bytes + 0, message->stream_id);
    *length = 1;
    return EBL_OK;
}

int ebl_str_renew_request_get(ebl_str_renew_request *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->stream_id = ebl_get_u8(bytes + 0);
    message->lease_s = ebl_get_u8(bytes + 1);
    return EBL_OK;
}

int ebl_str_renew_request_put(const ebl_str_renew_request *message, uint8_t *bytes, size_t capacity,
                             size_t *length)
{
    if (capacity < 2) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u8(bytes + 0, message->stream_id);
    ebl_put_u8(bytes + 1, message->lease_s);
    *length = 2;
    return EBL_OK;
}

int ebl_str_snapshot_request_get(ebl_str_snapshot_request *message, const uint8_t *bytes, size_t length)
{
    message->channel_ids = bytes + 0;
    message->channel_ids_length = length - 0;
    return EBL_OK;
}

int ebl_str_snapshot_request_put(const ebl_str_snapshot_request *message, uint8_t *bytes, size_t capacity,
                                size_t *length)
{
    if (capacity < message->channel_ids_length) {
        return EBL_ERROR_SPACE;
    }
    if (message->channel_ids_length > 0) {
        memcpy(bytes + 0, message->channel_ids, message->channel_ids_length);
    }
    *length = 0 + message->channel_ids_length;
    return EBL_OK;
}

int ebl_str_snapshot_response_get(ebl_str_snapshot_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 8) {
        return EBL_ERROR_LENGTH;
    }
    message->t_us = ebl_get_u64(bytes + 0);
    message->values = bytes + 8;
    message->values_length = length - 8;
    return EBL_OK;
}

int ebl_str_snapshot_response_put(const ebl_str_snapshot_response *message, uint8_t *bytes, size_t capacity,
                                 size_t *length)
{
    if (capacity < 8 || capacity - 8 < message->values_length) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u64(bytes + 0, message->t_us);
    if (message->values_length > 0) {
        memcpy(bytes + 8, message->values, message->values_length);
    }
    *length = 8 + message->values_length;
    return EBL_OK;
}

int ebl_evt_fault_list_response_get(ebl_evt_fault_list_response *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->fault_flags = ebl_get_u16(bytes + 0);
    return EBL_OK;
}

int ebl_evt_fault_list_response_put(const ebl_evt_fault_list_response *message, uint8_t *bytes, size_t capacity,
                                   size_t *length)
{
    if (capacity < 2) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->fault_flags);
    *length = 2;
    return EBL_OK;
}

int ebl_sim_get_response_get(ebl_sim_get_response *message, const uint8_t *bytes, size_t length)
{
    message->text = bytes + 0;
    message->text_length = length - 0;
    return EBL_OK;
}

int ebl_sim_get_response_put(const ebl_sim_get_response *message, uint8_t *bytes, size_t capacity,
                            size_t *length)
{
    if (capacity < message->text_length) {
        return EBL_ERROR_SPACE;
    }
    if (message->text_length > 0) {
        memcpy(bytes + 0, message->text, message->text_length);
    }
    *length = 0 + message->text_length;
    return EBL_OK;
}

int ebl_sim_set_request_get(ebl_sim_set_request *message, const uint8_t *bytes, size_t length)
{
    message->text = bytes + 0;
    message->text_length = length - 0;
    return EBL_OK;
}

int ebl_sim_set_request_put(const ebl_sim_set_request *message, uint8_t *bytes, size_t capacity,
                           size_t *length)
{
    if (capacity < message->text_length) {
        return EBL_ERROR_SPACE;
    }
    if (message->text_length > 0) {
        memcpy(bytes + 0, message->text, message->text_length);
    }
    *length = 0 + message->text_length;
    return EBL_OK;
}

int ebl_sim_set_response_get(ebl_sim_set_response *message, const uint8_t *bytes, size_t length)
{
    message->text = bytes + 0;
    message->text_length = length - 0;
    return EBL_OK;
}

int ebl_sim_set_response_put(const ebl_sim_set_response *message, uint8_t *bytes, size_t capacity,
                            size_t *length)
{
    if (capacity < message->text_length) {
        return EBL_ERROR_SPACE;
    }
    if (message->text_length > 0) {
        memcpy(bytes + 0, message->text, message->text_length);
    }
    *length = 0 + message->text_length;
    return EBL_OK;
}

int ebl_boot_event_get(ebl_boot_event *message, const uint8_t *bytes, size_t length)
{
    if (length < 5) {
        return EBL_ERROR_LENGTH;
    }
    message->boot_id = ebl_get_u32(bytes + 0);
    message->reset_cause = ebl_get_u8(bytes + 4);
    return EBL_OK;
}

int ebl_boot_event_put(const ebl_boot_event *message, uint8_t *bytes, size_t capacity,
                      size_t *length)
{
    if (capacity < 5) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->boot_id);
    ebl_put_u8(bytes + 4, message->reset_cause);
    *length = 5;
    return EBL_OK;
}

int ebl_fault_set_event_get(ebl_fault_set_event *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->fault_flags = ebl_get_u16(bytes + 0);
    return EBL_OK;
}

int ebl_fault_set_event_put(const ebl_fault_set_event *message, uint8_t *bytes, size_t capacity,
                           size_t *length)
{
    if (capacity < 2) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->fault_flags);
    *length = 2;
    return EBL_OK;
}

int ebl_fault_cleared_event_get(ebl_fault_cleared_event *message, const uint8_t *bytes, size_t length)
{
    if (length < 2) {
        return EBL_ERROR_LENGTH;
    }
    message->fault_flags = ebl_get_u16(bytes + 0);
    return EBL_OK;
}

int ebl_fault_cleared_event_put(const ebl_fault_cleared_event *message, uint8_t *bytes, size_t capacity,
                               size_t *length)
{
    if (capacity < 2) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u16(bytes + 0, message->fault_flags);
    *length = 2;
    return EBL_OK;
}

int ebl_config_committed_event_get(ebl_config_committed_event *message, const uint8_t *bytes, size_t length)
{
    if (length < 8) {
        return EBL_ERROR_LENGTH;
    }
    message->generation = ebl_get_u32(bytes + 0);
    message->crc32 = ebl_get_u32(bytes + 4);
    return EBL_OK;
}

int ebl_config_committed_event_put(const ebl_config_committed_event *message, uint8_t *bytes, size_t capacity,
                                  size_t *length)
{
    if (capacity < 8) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->generation);
    ebl_put_u32(bytes + 4, message->crc32);
    *length = 8;
    return EBL_OK;
}

int ebl_config_rolled_back_event_get(ebl_config_rolled_back_event *message, const uint8_t *bytes, size_t length)
{
    if (length < 8) {
        return EBL_ERROR_LENGTH;
    }
    message->generation = ebl_get_u32(bytes + 0);
    message->crc32 = ebl_get_u32(bytes + 4);
    return EBL_OK;
}

int ebl_config_rolled_back_event_put(const ebl_config_rolled_back_event *message, uint8_t *bytes, size_t capacity,
                                    size_t *length)
{
    if (capacity < 8) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->generation);
    ebl_put_u32(bytes + 4, message->crc32);
    *length = 8;
    return EBL_OK;
}

int ebl_config_defaulted_event_get(ebl_config_defaulted_event *message, const uint8_t *bytes, size_t length)
{
    if (length < 8) {
        return EBL_ERROR_LENGTH;
    }
    message->generation = ebl_get_u32(bytes + 0);
    message->crc32 = ebl_get_u32(bytes + 4);
    return EBL_OK;
}

int ebl_config_defaulted_event_put(const ebl_config_defaulted_event *message, uint8_t *bytes, size_t capacity,
                                  size_t *length)
{
    if (capacity < 8) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u32(bytes + 0, message->generation);
    ebl_put_u32(bytes + 4, message->crc32);
    *length = 8;
    return EBL_OK;
}

int ebl_stream_stats_event_get(ebl_stream_stats_event *message, const uint8_t *bytes, size_t length)
{
    if (length < 9) {
        return EBL_ERROR_LENGTH;
    }
    message->stream_id = ebl_get_u8(bytes + 0);
    message->built = ebl_get_u32(bytes + 1);
    message->dropped_tx = ebl_get_u32(bytes + 5);
    return EBL_OK;
}

int ebl_stream_stats_event_put(const ebl_stream_stats_event *message, uint8_t *bytes, size_t capacity,
                              size_t *length)
{
    if (capacity < 9) {
        return EBL_ERROR_SPACE;
    }
    ebl_put_u8(bytes + 0, message->stream_id);
    ebl_put_u32(bytes + 1, message->built);
    ebl_put_u32(bytes + 5, message->dropped_tx);
    *length = 9;
    return EBL_OK;
}
