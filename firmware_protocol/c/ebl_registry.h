/* Generated from registry.toml by `make gen`; change the registry, not this file. */
#ifndef SPINDLE_EBL_REGISTRY_H
#define SPINDLE_EBL_REGISTRY_H

#include <stddef.h>
#include <stdint.h>

#define EBL_MAJOR 1
#define EBL_MINOR 0
#define EBL_MTU_BEFORE_HELLO 128
#define EBL_MTU 544
#define EBL_MAX_OUTSTANDING 4
#define EBL_CONTROL_PERIOD_US 10000
#define EBL_IMAGE_LENGTH 299
#define EBL_MESSAGE_COUNT 20
#define EBL_EVENT_COUNT 7
#define EBL_EVENT_HEAD_LENGTH 5
#define EBL_PARAMETER_COUNT 34
#define EBL_ORDER_COUNT 1
#define EBL_CHANNEL_COUNT 20
#define EBL_SCHEMA_HASH_LENGTH 8
#define EBL_SCHEMA_LENGTH 2955

enum { EBL_MISSING = -32768 }; /* the telemetry count that stands for no value */

/* First byte of every response. Anything but OK carries a u16 detail after it. */
typedef enum {
    EBL_STATUS_OK = 0,
    EBL_STATUS_PENDING = 1,
    EBL_STATUS_UNKNOWN_MSG = 2,
    EBL_STATUS_LENGTH = 3,
    EBL_STATUS_VERSION = 4,
    EBL_STATUS_BUSY = 5,
    EBL_STATUS_STATE = 6,
    EBL_STATUS_RANGE = 7,
    EBL_STATUS_TYPE = 8,
    EBL_STATUS_UNKNOWN_ID = 9,
    EBL_STATUS_ACCESS = 10,
    EBL_STATUS_STALE_BASE = 11,
    EBL_STATUS_CRC_MISMATCH = 12,
    EBL_STATUS_INVALID_CONFIG = 13,
    EBL_STATUS_NOT_STOPPED = 14,
    EBL_STATUS_FLASH_FAIL = 15,
    EBL_STATUS_VERIFY_FAIL = 16,
    EBL_STATUS_NO_SPACE = 17,
    EBL_STATUS_BANDWIDTH = 18,
    EBL_STATUS_NOT_FOUND = 19,
    EBL_STATUS_EXPIRED = 20,
    EBL_STATUS_AUTH_BAD = 21,
    EBL_STATUS_AUTH_DELAY = 22,
    EBL_STATUS_RATE_LIMIT = 23,
    EBL_STATUS_UNSUPPORTED = 24,
    EBL_STATUS_SESSION = 25,
    EBL_STATUS_ABORTED = 26,
    EBL_STATUS_UNDERVOLTAGE = 27,
    EBL_STATUS_INTERNAL = 255,
} ebl_status;

/* What kind of unit answers HELLO. Bit 7 marks a simulated one. */
typedef enum {
    EBL_DEVICE_CLASS_MID_DRIVE = 1,
    EBL_DEVICE_CLASS_MID_DRIVE_SIMULATED = 129,
} ebl_device_class;

/* Who may change a parameter. */
typedef enum {
    EBL_ACCESS_RIDER = 0,
    EBL_ACCESS_DEALER = 1,
    EBL_ACCESS_FACTORY = 2,
} ebl_access;

/* Which copy of the configuration is meant. */
typedef enum {
    EBL_BANK_ACTIVE = 0,
    EBL_BANK_STAGED = 1,
    EBL_BANK_PREVIOUS = 2,
    EBL_BANK_DEFAULT = 3,
} ebl_bank;

/* Where the configuration transaction stands. */
typedef enum {
    EBL_CONFIG_STATE_IDLE = 0,
    EBL_CONFIG_STATE_STAGING = 1,
    EBL_CONFIG_STATE_VALID = 2,
    EBL_CONFIG_STATE_PROVISIONAL = 3,
} ebl_config_state;

/* Why a parameter's value is refused. */
typedef enum {
    EBL_VIOLATION_NOT_FINITE = 1,
    EBL_VIOLATION_BELOW_MIN = 2,
    EBL_VIOLATION_ABOVE_MAX = 3,
    EBL_VIOLATION_NOT_INCREASING = 4,
    EBL_VIOLATION_NOT_A_CHOICE = 5,
    EBL_VIOLATION_NOT_TEXT = 6,
    EBL_VIOLATION_TAPER_ORDER = 7,
} ebl_violation;

/* Which assist law a mode slot runs. */
typedef enum {
    EBL_LAW_OFF = 0,
    EBL_LAW_FIXED = 1,
    EBL_LAW_FUZZY = 2,
} ebl_law;

/* How the fuzzy rules are combined. */
typedef enum {
    EBL_INFERENCE_MAMDANI_CENTROID = 0,
    EBL_INFERENCE_WEIGHTED_AVERAGE = 1,
} ebl_inference;

/* The five sets of every fuzzy variable, from least to most. */
typedef enum {
    EBL_LABEL_NB = 0,
    EBL_LABEL_NS = 1,
    EBL_LABEL_ZO = 2,
    EBL_LABEL_PS = 3,
    EBL_LABEL_PB = 4,
} ebl_label;

/* What the fuzzy law does while the rider's torque falls (thesis_checks I-16). */
typedef enum {
    EBL_FALLING_TORQUE_HOLD_ZERO_RATE = 0,
    EBL_FALLING_TORQUE_NO_GAIN = 1,
} ebl_falling_torque;

/* What an EVENT frame tells. */
typedef enum {
    EBL_EVENT_BOOT = 1,
    EBL_EVENT_FAULT_SET = 2,
    EBL_EVENT_FAULT_CLEARED = 3,
    EBL_EVENT_CONFIG_COMMITTED = 4,
    EBL_EVENT_CONFIG_ROLLED_BACK = 5,
    EBL_EVENT_CONFIG_DEFAULTED = 6,
    EBL_EVENT_STREAM_STATS = 7,
} ebl_event;

/* Which steps of the assist pipeline held the motor back in this control step. */
enum {
    EBL_LIMIT_TAPER = 1,
    EBL_LIMIT_SPEED_CUTOFF = 2,
    EBL_LIMIT_PEDAL_STOP = 4,
    EBL_LIMIT_BRAKE = 8,
    EBL_LIMIT_RAMP_UP = 16,
    EBL_LIMIT_RAMP_DOWN = 32,
    EBL_LIMIT_MOTOR_TORQUE = 64,
    EBL_LIMIT_BATTERY_CURRENT = 128,
    EBL_LIMIT_MOTOR_SPEED = 256,
    EBL_LIMIT_BATTERY_VOLTAGE = 512,
    EBL_LIMIT_INPUT_REFUSED = 1024,
    EBL_LIMIT_MODE_OFF = 2048,
};

/* What is wrong with the unit now. */
enum {
    EBL_FAULT_TORQUE_SENSOR = 1,
    EBL_FAULT_SPEED_SENSOR = 2,
    EBL_FAULT_BATTERY_LOW = 4,
    EBL_FAULT_CONFIG_DEFAULTED = 8,
};

enum {
    EBL_MSG_HELLO = 0x0001,
    EBL_MSG_PING = 0x0002,
    EBL_MSG_SCHEMA_READ = 0x0003,
    EBL_MSG_STATS = 0x0005,
    EBL_MSG_BYE = 0x0007,
    EBL_MSG_CFG_INFO = 0x0100,
    EBL_MSG_CFG_READ = 0x0101,
    EBL_MSG_CFG_BEGIN = 0x0120,
    EBL_MSG_CFG_SET = 0x0121,
    EBL_MSG_CFG_VALIDATE = 0x0122,
    EBL_MSG_CFG_STAGED_CRC = 0x0123,
    EBL_MSG_CFG_COMMIT = 0x0125,
    EBL_MSG_CFG_ABORT = 0x0128,
    EBL_MSG_STR_SUBSCRIBE = 0x0201,
    EBL_MSG_STR_UNSUBSCRIBE = 0x0202,
    EBL_MSG_STR_RENEW = 0x0203,
    EBL_MSG_STR_SNAPSHOT = 0x0205,
    EBL_MSG_EVT_FAULT_LIST = 0x0302,
    EBL_MSG_SIM_GET = 0x7001,
    EBL_MSG_SIM_SET = 0x7002,
};

enum {
    EBL_PARAMETER_SENSOR_OFFSET_COUNTS = 0x0100,
    EBL_PARAMETER_SENSOR_GAIN_NM_PER_COUNT = 0x0101,
    EBL_PARAMETER_TORQUE_FILTER_S = 0x0102,
    EBL_PARAMETER_TORQUE_RATE_INTERVAL_MS = 0x0103,
    EBL_PARAMETER_TORQUE_RATE_FLOOR_NM = 0x0104,
    EBL_PARAMETER_ASSIST_MODE_AT_START = 0x0200,
    EBL_PARAMETER_MODE_NAMES = 0x0201,
    EBL_PARAMETER_MODE_LAWS = 0x0202,
    EBL_PARAMETER_MODE_RATIOS = 0x0203,
    EBL_PARAMETER_FIXED_TAPER_START_KMH = 0x0204,
    EBL_PARAMETER_FIXED_TAPER_END_KMH = 0x0205,
    EBL_PARAMETER_ASSIST_RAMP_UP_NM_PER_S = 0x0206,
    EBL_PARAMETER_ASSIST_RAMP_DOWN_NM_PER_S = 0x0207,
    EBL_PARAMETER_PEDAL_TORQUE_NM_MIN = 0x0208,
    EBL_PARAMETER_FUZZY_TABLE_NAME = 0x0300,
    EBL_PARAMETER_FUZZY_INFERENCE = 0x0301,
    EBL_PARAMETER_FUZZY_SPEED_POINTS_KMH = 0x0302,
    EBL_PARAMETER_FUZZY_TORQUE_RATE_POINTS = 0x0303,
    EBL_PARAMETER_FUZZY_GAIN_POINTS = 0x0304,
    EBL_PARAMETER_FUZZY_RULES = 0x0305,
    EBL_PARAMETER_FUZZY_FALLING_TORQUE = 0x0306,
    EBL_PARAMETER_ASSIST_CUTOFF_KMH = 0x0400,
    EBL_PARAMETER_ASSIST_CUTOFF_BAND_KMH = 0x0401,
    EBL_PARAMETER_MOTOR_TORQUE_NM_MAX = 0x0402,
    EBL_PARAMETER_BATTERY_CURRENT_A_MAX = 0x0403,
    EBL_PARAMETER_BATTERY_VOLTAGE_V_MIN = 0x0404,
    EBL_PARAMETER_MOTOR_SPEED_RPM_MAX = 0x0405,
    EBL_PARAMETER_PEDAL_STOP_MS = 0x0406,
    EBL_PARAMETER_GEAR_RATIO = 0x0500,
    EBL_PARAMETER_CHAINRING_TEETH = 0x0501,
    EBL_PARAMETER_COG_TEETH = 0x0502,
    EBL_PARAMETER_WHEEL_RADIUS_M = 0x0503,
    EBL_PARAMETER_MOTOR_TORQUE_CONSTANT_NM_PER_A = 0x0510,
    EBL_PARAMETER_MOTOR_RESISTANCE_OHM = 0x0511,
};

enum {
    EBL_CHANNEL_SPEED_KMH = 1,
    EBL_CHANNEL_CADENCE_RPM = 2,
    EBL_CHANNEL_CRANK_ANGLE_DEG = 3,
    EBL_CHANNEL_RIDER_TORQUE_NM = 4,
    EBL_CHANNEL_RIDER_TORQUE_RAW = 5,
    EBL_CHANNEL_RIDER_TORQUE_FILTERED_NM = 6,
    EBL_CHANNEL_TORQUE_RATE = 7,
    EBL_CHANNEL_MOTOR_TORQUE_NM = 8,
    EBL_CHANNEL_MOTOR_CURRENT_A = 9,
    EBL_CHANNEL_MOTOR_SPEED_RPM = 10,
    EBL_CHANNEL_BATTERY_CURRENT_A = 11,
    EBL_CHANNEL_BATTERY_VOLTAGE_V = 12,
    EBL_CHANNEL_BATTERY_SOC_PCT = 13,
    EBL_CHANNEL_ASSIST_RATIO = 14,
    EBL_CHANNEL_FUZZY_GAIN = 15,
    EBL_CHANNEL_ASSIST_MODE = 16,
    EBL_CHANNEL_LIMIT_FLAGS = 17,
    EBL_CHANNEL_MOTOR_TEMPERATURE_DEGC = 18,
    EBL_CHANNEL_SENSOR_TEMPERATURE_DEGC = 19,
    EBL_CHANNEL_FAULT_FLAGS = 20,
};

typedef struct {
    uint16_t id;
    uint16_t request_length;  /* of the fixed fields: the shortest payload that is accepted */
    uint16_t response_length; /* the same, after the status byte */
} ebl_message;

/* An event's payload starts with its code u8 and t_us u32; `length` is what must follow. */
typedef struct {
    uint8_t code; /* ebl_event */
    uint16_t length;
} ebl_event_row;

typedef enum { EBL_TYPE_U8 = 0, EBL_TYPE_U16 = 1, EBL_TYPE_F32 = 2, EBL_TYPE_TEXT = 3 } ebl_type;

enum {
    EBL_PARAMETER_INCREASING = 1, /* each element is greater than the one before */
    EBL_PARAMETER_CHOICE = 2      /* an enumeration: 0 to max */
};

typedef struct {
    uint16_t id;
    uint16_t image_offset; /* bytes from the start of the image */
    uint8_t type;          /* ebl_type */
    uint8_t count;         /* elements */
    uint8_t length;        /* bytes of one element */
    uint8_t access;        /* ebl_access */
    uint8_t flags;
    float min;             /* no meaning for texts */
    float max;
} ebl_parameter;

/* The value of `low` must be less than that of `high`; both are single floats. */
typedef struct {
    uint16_t low_offset;
    uint16_t high_offset;
    uint16_t high_id;
    uint8_t violation; /* ebl_violation */
} ebl_order;

typedef struct {
    uint8_t id;
    float scale; /* value = count * scale */
} ebl_channel;

typedef struct {
    float sensor_offset_counts;
    float sensor_gain_nm_per_count;
    float torque_filter_s;
    uint16_t torque_rate_interval_ms;
    float torque_rate_floor_nm;
    uint8_t assist_mode_at_start;
    char mode_names[5][16];
    uint8_t mode_laws[5];
    float mode_ratios[5];
    float fixed_taper_start_kmh;
    float fixed_taper_end_kmh;
    float assist_ramp_up_nm_per_s;
    float assist_ramp_down_nm_per_s;
    float pedal_torque_nm_min;
    char fuzzy_table_name[24];
    uint8_t fuzzy_inference;
    float fuzzy_speed_points_kmh[5];
    float fuzzy_torque_rate_points[5];
    float fuzzy_gain_points[5];
    uint8_t fuzzy_rules[5][5];
    uint8_t fuzzy_falling_torque;
    float assist_cutoff_kmh;
    float assist_cutoff_band_kmh;
    float motor_torque_nm_max;
    float battery_current_a_max;
    float battery_voltage_v_min;
    float motor_speed_rpm_max;
    uint16_t pedal_stop_ms;
    float gear_ratio;
    uint8_t chainring_teeth;
    uint8_t cog_teeth;
    float wheel_radius_m;
    float motor_torque_constant_nm_per_a;
    float motor_resistance_ohm;
} ebl_config;

extern const ebl_message ebl_messages[EBL_MESSAGE_COUNT];
extern const ebl_event_row ebl_event_rows[EBL_EVENT_COUNT];
extern const ebl_parameter ebl_parameters[EBL_PARAMETER_COUNT]; /* in the order of their ids */
extern const ebl_order ebl_orders[EBL_ORDER_COUNT];
extern const ebl_channel ebl_channels[EBL_CHANNEL_COUNT];       /* in the order of their ids */

extern const uint8_t ebl_schema_hash[EBL_SCHEMA_HASH_LENGTH];
extern const uint8_t ebl_schema[EBL_SCHEMA_LENGTH]; /* zlib */

/* NULL where the id is unknown. */
const ebl_message *ebl_message_find(uint16_t id);
const ebl_event_row *ebl_event_find(uint8_t code);
const ebl_parameter *ebl_parameter_find(uint16_t id);
const ebl_channel *ebl_channel_find(uint8_t id);

/* The typed configuration and its image of EBL_IMAGE_LENGTH bytes. Neither checks values. */
void ebl_config_default(ebl_config *config);
void ebl_config_pack(const ebl_config *config, uint8_t *image);
void ebl_config_unpack(ebl_config *config, const uint8_t *image);

/* Messages. get: EBL_OK, or EBL_ERROR_LENGTH if a field is missing; a tail points into
 * `bytes`. put: EBL_OK and the length, or EBL_ERROR_SPACE. A response's bytes start
 * after the status; an event's after code and time. */
#define EBL_HELLO_REQUEST_LENGTH 14
typedef struct {
    uint8_t major_min;
    uint8_t major_max;
    uint16_t host_flags;
    uint16_t host_mtu;
    uint8_t host_nonce[8];
} ebl_hello_request;
int ebl_hello_request_get(ebl_hello_request *message, const uint8_t *bytes, size_t length);
int ebl_hello_request_put(const ebl_hello_request *message, uint8_t *bytes, size_t capacity,
                         size_t *length);

#define EBL_HELLO_RESPONSE_LENGTH 75
typedef struct {
    uint8_t major;
    uint8_t minor;
    uint8_t device_class;
    uint16_t hardware_revision;
    uint16_t firmware_version[3];
    uint8_t git[8];
    uint8_t uid[12];
    uint32_t boot_id;
    uint32_t session_id;
    uint8_t schema_hash[8];
    uint32_t config_generation;
    uint32_t config_crc32;
    uint16_t rx_mtu;
    uint16_t tx_mtu;
    uint8_t max_outstanding;
    uint8_t access;
    uint16_t baud_bitmap;
    uint32_t features;
    uint64_t uptime_us;
} ebl_hello_response;
int ebl_hello_response_get(ebl_hello_response *message, const uint8_t *bytes, size_t length);
int ebl_hello_response_put(const ebl_hello_response *message, uint8_t *bytes, size_t capacity,
                          size_t *length);

#define EBL_SCHEMA_READ_REQUEST_LENGTH 6
typedef struct {
    uint32_t offset;
    uint16_t length;
} ebl_schema_read_request;
int ebl_schema_read_request_get(ebl_schema_read_request *message, const uint8_t *bytes, size_t length);
int ebl_schema_read_request_put(const ebl_schema_read_request *message, uint8_t *bytes, size_t capacity,
                               size_t *length);

#define EBL_SCHEMA_READ_RESPONSE_LENGTH 4
typedef struct {
    uint32_t total_length;
    const uint8_t *data;
    size_t data_length;
} ebl_schema_read_response;
int ebl_schema_read_response_get(ebl_schema_read_response *message, const uint8_t *bytes, size_t length);
int ebl_schema_read_response_put(const ebl_schema_read_response *message, uint8_t *bytes, size_t capacity,
                                size_t *length);

#define EBL_STATS_RESPONSE_LENGTH 20
typedef struct {
    uint32_t frames_ok;
    uint32_t crc_errors;
    uint32_t cobs_errors;
    uint32_t overflows;
    uint32_t dropped_tx;
} ebl_stats_response;
int ebl_stats_response_get(ebl_stats_response *message, const uint8_t *bytes, size_t length);
int ebl_stats_response_put(const ebl_stats_response *message, uint8_t *bytes, size_t capacity,
                          size_t *length);

#define EBL_CFG_INFO_RESPONSE_LENGTH 11
typedef struct {
    uint32_t generation;
    uint32_t crc32;
    uint16_t image_length;
    uint8_t state;
} ebl_cfg_info_response;
int ebl_cfg_info_response_get(ebl_cfg_info_response *message, const uint8_t *bytes, size_t length);
int ebl_cfg_info_response_put(const ebl_cfg_info_response *message, uint8_t *bytes, size_t capacity,
                             size_t *length);

#define EBL_CFG_READ_REQUEST_LENGTH 5
typedef struct {
    uint8_t bank;
    uint16_t offset;
    uint16_t length;
} ebl_cfg_read_request;
int ebl_cfg_read_request_get(ebl_cfg_read_request *message, const uint8_t *bytes, size_t length);
int ebl_cfg_read_request_put(const ebl_cfg_read_request *message, uint8_t *bytes, size_t capacity,
                            size_t *length);

#define EBL_CFG_READ_RESPONSE_LENGTH 6
typedef struct {
    uint32_t generation;
    uint16_t total_length;
    const uint8_t *data;
    size_t data_length;
} ebl_cfg_read_response;
int ebl_cfg_read_response_get(ebl_cfg_read_response *message, const uint8_t *bytes, size_t length);
int ebl_cfg_read_response_put(const ebl_cfg_read_response *message, uint8_t *bytes, size_t capacity,
                             size_t *length);

#define EBL_CFG_BEGIN_REQUEST_LENGTH 8
typedef struct {
    uint32_t base_generation;
    uint32_t base_crc32;
} ebl_cfg_begin_request;
int ebl_cfg_begin_request_get(ebl_cfg_begin_request *message, const uint8_t *bytes, size_t length);
int ebl_cfg_begin_request_put(const ebl_cfg_begin_request *message, uint8_t *bytes, size_t capacity,
                             size_t *length);

#define EBL_CFG_BEGIN_RESPONSE_LENGTH 4
typedef struct {
    uint16_t transaction;
    uint16_t lease_ms;
} ebl_cfg_begin_response;
int ebl_cfg_begin_response_get(ebl_cfg_begin_response *message, const uint8_t *bytes, size_t length);
int ebl_cfg_begin_response_put(const ebl_cfg_begin_response *message, uint8_t *bytes, size_t capacity,
                              size_t *length);

#define EBL_CFG_SET_REQUEST_LENGTH 2
typedef struct {
    uint16_t transaction;
    const uint8_t *items;
    size_t items_length;
} ebl_cfg_set_request;
int ebl_cfg_set_request_get(ebl_cfg_set_request *message, const uint8_t *bytes, size_t length);
int ebl_cfg_set_request_put(const ebl_cfg_set_request *message, uint8_t *bytes, size_t capacity,
                           size_t *length);

#define EBL_CFG_VALIDATE_REQUEST_LENGTH 2
typedef struct {
    uint16_t transaction;
} ebl_cfg_validate_request;
int ebl_cfg_validate_request_get(ebl_cfg_validate_request *message, const uint8_t *bytes, size_t length);
int ebl_cfg_validate_request_put(const ebl_cfg_validate_request *message, uint8_t *bytes, size_t capacity,
                                size_t *length);

#define EBL_CFG_STAGED_CRC_REQUEST_LENGTH 2
typedef struct {
    uint16_t transaction;
} ebl_cfg_staged_crc_request;
int ebl_cfg_staged_crc_request_get(ebl_cfg_staged_crc_request *message, const uint8_t *bytes, size_t length);
int ebl_cfg_staged_crc_request_put(const ebl_cfg_staged_crc_request *message, uint8_t *bytes, size_t capacity,
                                  size_t *length);

#define EBL_CFG_STAGED_CRC_RESPONSE_LENGTH 4
typedef struct {
    uint32_t crc32;
} ebl_cfg_staged_crc_response;
int ebl_cfg_staged_crc_response_get(ebl_cfg_staged_crc_response *message, const uint8_t *bytes, size_t length);
int ebl_cfg_staged_crc_response_put(const ebl_cfg_staged_crc_response *message, uint8_t *bytes, size_t capacity,
                                   size_t *length);

#define EBL_CFG_COMMIT_REQUEST_LENGTH 8
typedef struct {
    uint16_t transaction;
    uint32_t staged_crc32;
    uint8_t flags;
    uint8_t confirm_s;
} ebl_cfg_commit_request;
int ebl_cfg_commit_request_get(ebl_cfg_commit_request *message, const uint8_t *bytes, size_t length);
int ebl_cfg_commit_request_put(const ebl_cfg_commit_request *message, uint8_t *bytes, size_t capacity,
                              size_t *length);

#define EBL_CFG_COMMIT_RESPONSE_LENGTH 9
typedef struct {
    uint32_t generation;
    uint32_t crc32;
    uint8_t state;
} ebl_cfg_commit_response;
int ebl_cfg_commit_response_get(ebl_cfg_commit_response *message, const uint8_t *bytes, size_t length);
int ebl_cfg_commit_response_put(const ebl_cfg_commit_response *message, uint8_t *bytes, size_t capacity,
                               size_t *length);

#define EBL_CFG_ABORT_REQUEST_LENGTH 2
typedef struct {
    uint16_t transaction;
} ebl_cfg_abort_request;
int ebl_cfg_abort_request_get(ebl_cfg_abort_request *message, const uint8_t *bytes, size_t length);
int ebl_cfg_abort_request_put(const ebl_cfg_abort_request *message, uint8_t *bytes, size_t capacity,
                             size_t *length);

#define EBL_STR_SUBSCRIBE_REQUEST_LENGTH 6
typedef struct {
    uint8_t stream_id;
    uint16_t divider;
    uint8_t batch;
    uint8_t encoding;
    uint8_t lease_s;
    const uint8_t *channel_ids;
    size_t channel_ids_length;
} ebl_str_subscribe_request;
int ebl_str_subscribe_request_get(ebl_str_subscribe_request *message, const uint8_t *bytes, size_t length);
int ebl_str_subscribe_request_put(const ebl_str_subscribe_request *message, uint8_t *bytes, size_t capacity,
                                 size_t *length);

#define EBL_STR_SUBSCRIBE_RESPONSE_LENGTH 12
typedef struct {
    uint32_t period_us;
    uint8_t batch;
    uint8_t epoch;
    uint16_t start_seq;
    uint32_t bytes_per_s;
} ebl_str_subscribe_response;
int ebl_str_subscribe_response_get(ebl_str_subscribe_response *message, const uint8_t *bytes, size_t length);
int ebl_str_subscribe_response_put(const ebl_str_subscribe_response *message, uint8_t *bytes, size_t capacity,
                                  size_t *length);

#define EBL_STR_UNSUBSCRIBE_REQUEST_LENGTH 1
typedef struct {
    uint8_t stream_id;
} ebl_str_unsubscribe_request;
int ebl_str_unsubscribe_request_get(ebl_str_unsubscribe_request *message, const uint8_t *bytes, size_t length);
int ebl_str_unsubscribe_request_put(const ebl_str_unsubscribe_request *message, uint8_t *bytes, size_t capacity,
                                   size_t *length);

#define EBL_STR_RENEW_REQUEST_LENGTH 2
typedef struct {
    uint8_t stream_id;
    uint8_t lease_s;
} ebl_str_renew_request;
int ebl_str_renew_request_get(ebl_str_renew_request *message, const uint8_t *bytes, size_t length);
int ebl_str_renew_request_put(const ebl_str_renew_request *message, uint8_t *bytes, size_t capacity,
                             size_t *length);

#define EBL_STR_SNAPSHOT_REQUEST_LENGTH 0
typedef struct {
    const uint8_t *channel_ids;
    size_t channel_ids_length;
} ebl_str_snapshot_request;
int ebl_str_snapshot_request_get(ebl_str_snapshot_request *message, const uint8_t *bytes, size_t length);
int ebl_str_snapshot_request_put(const ebl_str_snapshot_request *message, uint8_t *bytes, size_t capacity,
                                size_t *length);

#define EBL_STR_SNAPSHOT_RESPONSE_LENGTH 8
typedef struct {
    uint64_t t_us;
    const uint8_t *values;
    size_t values_length;
} ebl_str_snapshot_response;
int ebl_str_snapshot_response_get(ebl_str_snapshot_response *message, const uint8_t *bytes, size_t length);
int ebl_str_snapshot_response_put(const ebl_str_snapshot_response *message, uint8_t *bytes, size_t capacity,
                                 size_t *length);

#define EBL_EVT_FAULT_LIST_RESPONSE_LENGTH 2
typedef struct {
    uint16_t fault_flags;
} ebl_evt_fault_list_response;
int ebl_evt_fault_list_response_get(ebl_evt_fault_list_response *message, const uint8_t *bytes, size_t length);
int ebl_evt_fault_list_response_put(const ebl_evt_fault_list_response *message, uint8_t *bytes, size_t capacity,
                                   size_t *length);

#define EBL_SIM_GET_RESPONSE_LENGTH 0
typedef struct {
    const uint8_t *text;
    size_t text_length;
} ebl_sim_get_response;
int ebl_sim_get_response_get(ebl_sim_get_response *message, const uint8_t *bytes, size_t length);
int ebl_sim_get_response_put(const ebl_sim_get_response *message, uint8_t *bytes, size_t capacity,
                            size_t *length);

#define EBL_SIM_SET_REQUEST_LENGTH 0
typedef struct {
    const uint8_t *text;
    size_t text_length;
} ebl_sim_set_request;
int ebl_sim_set_request_get(ebl_sim_set_request *message, const uint8_t *bytes, size_t length);
int ebl_sim_set_request_put(const ebl_sim_set_request *message, uint8_t *bytes, size_t capacity,
                           size_t *length);

#define EBL_SIM_SET_RESPONSE_LENGTH 0
typedef struct {
    const uint8_t *text;
    size_t text_length;
} ebl_sim_set_response;
int ebl_sim_set_response_get(ebl_sim_set_response *message, const uint8_t *bytes, size_t length);
int ebl_sim_set_response_put(const ebl_sim_set_response *message, uint8_t *bytes, size_t capacity,
                            size_t *length);

#define EBL_BOOT_EVENT_LENGTH 5
typedef struct {
    uint32_t boot_id;
    uint8_t reset_cause;
} ebl_boot_event;
int ebl_boot_event_get(ebl_boot_event *message, const uint8_t *bytes, size_t length);
int ebl_boot_event_put(const ebl_boot_event *message, uint8_t *bytes, size_t capacity,
                      size_t *length);

#define EBL_FAULT_SET_EVENT_LENGTH 2
typedef struct {
    uint16_t fault_flags;
} ebl_fault_set_event;
int ebl_fault_set_event_get(ebl_fault_set_event *message, const uint8_t *bytes, size_t length);
int ebl_fault_set_event_put(const ebl_fault_set_event *message, uint8_t *bytes, size_t capacity,
                           size_t *length);

#define EBL_FAULT_CLEARED_EVENT_LENGTH 2
typedef struct {
    uint16_t fault_flags;
} ebl_fault_cleared_event;
int ebl_fault_cleared_event_get(ebl_fault_cleared_event *message, const uint8_t *bytes, size_t length);
int ebl_fault_cleared_event_put(const ebl_fault_cleared_event *message, uint8_t *bytes, size_t capacity,
                               size_t *length);

#define EBL_CONFIG_COMMITTED_EVENT_LENGTH 8
typedef struct {
    uint32_t generation;
    uint32_t crc32;
} ebl_config_committed_event;
int ebl_config_committed_event_get(ebl_config_committed_event *message, const uint8_t *bytes, size_t length);
int ebl_config_committed_event_put(const ebl_config_committed_event *message, uint8_t *bytes, size_t capacity,
                                  size_t *length);

#define EBL_CONFIG_ROLLED_BACK_EVENT_LENGTH 8
typedef struct {
    uint32_t generation;
    uint32_t crc32;
} ebl_config_rolled_back_event;
int ebl_config_rolled_back_event_get(ebl_config_rolled_back_event *message, const uint8_t *bytes, size_t length);
int ebl_config_rolled_back_event_put(const ebl_config_rolled_back_event *message, uint8_t *bytes, size_t capacity,
                                    size_t *length);

#define EBL_CONFIG_DEFAULTED_EVENT_LENGTH 8
typedef struct {
    uint32_t generation;
    uint32_t crc32;
} ebl_config_defaulted_event;
int ebl_config_defaulted_event_get(ebl_config_defaulted_event *message, const uint8_t *bytes, size_t length);
int ebl_config_defaulted_event_put(const ebl_config_defaulted_event *message, uint8_t *bytes, size_t capacity,
                                  size_t *length);

#define EBL_STREAM_STATS_EVENT_LENGTH 9
typedef struct {
    uint8_t stream_id;
    uint32_t built;
    uint32_t dropped_tx;
} ebl_stream_stats_event;
int ebl_stream_stats_event_get(ebl_stream_stats_event *message, const uint8_t *bytes, size_t length);
int ebl_stream_stats_event_put(const ebl_stream_stats_event *message, uint8_t *bytes, size_t capacity,
                              size_t *length);

#endif
