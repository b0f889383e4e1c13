"""ebl_registry.h: everything the firmware and the simulator include, in plain declarations."""

from firmware_protocol.generate.c_names import (
    FIRST_LINE,
    config_member,
    enum_prefix,
    float_literal,
    layouts,
    member,
)
from firmware_protocol.generate.registry import Registry

TYPES = """\
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

typedef enum {
    EBL_TYPE_U8 = 0,
    EBL_TYPE_U16 = 1,
    EBL_TYPE_F32 = 2,
    EBL_TYPE_TEXT = 3,
    EBL_TYPE_U32 = 4
} ebl_type;

enum {
    EBL_PARAMETER_INCREASING = 1, /* each element is greater than the one before */
    EBL_PARAMETER_CHOICE = 2,     /* an enumeration: 0 to max */
    EBL_PARAMETER_RATCHET = 4,    /* going down is free, going up needs a token */
    EBL_PARAMETER_NONE = 8        /* it may have no value: EBL_NONE_BITS */
};

/* The one float that says none: a quiet NaN without a payload. */
#define EBL_NONE_BITS 0x7fc00000u
#define EBL_NONE __builtin_nanf("")

typedef struct {
    uint16_t id;
    uint16_t image_offset; /* bytes from the start of the image */
    uint8_t type;          /* ebl_type */
    uint8_t count;         /* elements */
    uint8_t length;        /* bytes of one element */
    uint8_t access;        /* ebl_access */
    uint8_t record;        /* ebl_record */
    uint8_t flags;
    uint16_t config_offset; /* bytes from the start of ebl_config */
    float min;             /* no meaning for texts */
    float max;
    float least_step;      /* between neighbours that increase */
} ebl_parameter;

/* The value of `low` must be less than that of `high`; both are single floats. */
typedef struct {
    uint16_t low_offset;
    uint16_t high_offset;
    uint16_t high_id;
    uint8_t violation; /* ebl_violation */
} ebl_order;

/* What a dealer may set around what the factory measured. The values are single floats, each told
 * by its bytes from the start of the image. `share` is of the value around; 0: `within` holds, of
 * the distance times the value at `scale_offset`. See ebl_band_holds. */
typedef struct {
    uint16_t id;
    uint16_t around_id;
    uint16_t offset;
    uint16_t around_offset;
    uint16_t scale_offset; /* EBL_BAND_NO_SCALE: the distance itself */
    float share;
    float within;
} ebl_band;
#define EBL_BAND_NO_SCALE 0xffff

typedef struct {
    uint8_t id;
    float scale; /* value = count * scale */
} ebl_channel;
"""

CALLS = """\
extern const ebl_message ebl_messages[EBL_MESSAGE_COUNT];
extern const ebl_event_row ebl_event_rows[EBL_EVENT_COUNT];
extern const ebl_parameter ebl_parameters[EBL_PARAMETER_COUNT]; /* in the order of their ids */
extern const ebl_order ebl_orders[EBL_ORDER_COUNT];
extern const ebl_band ebl_bands[EBL_BAND_COUNT];
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
"""


def header(registry: Registry, schema_length: int) -> str:
    """The text of ebl_registry.h."""
    lines = [
        FIRST_LINE,
        "#ifndef SPINDLE_EBL_REGISTRY_H",
        "#define SPINDLE_EBL_REGISTRY_H",
        "",
        "#include <stddef.h>",
        "#include <stdint.h>",
        "",
        *_numbers(registry, schema_length),
        "",
        "enum { EBL_MISSING = -32768 }; /* the telemetry count that stands for no value */",
        "",
        *_enums(registry),
        TYPES,
        *_config(registry),
        CALLS,
        *_structs(registry),
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def _numbers(registry: Registry, schema_length: int) -> list[str]:
    numbers = {
        "MAJOR": registry.protocol["major"],
        "MINOR": registry.protocol["minor"],
        "MTU_BEFORE_HELLO": registry.protocol["mtu_before_hello"],
        "MTU": registry.protocol["mtu"],
        "MAX_OUTSTANDING": registry.protocol["max_outstanding"],
        "CONTROL_PERIOD_US": registry.protocol["control_period_us"],
        "IMAGE_LENGTH": registry.image_length,
        "MESSAGE_COUNT": len(registry.messages),
        "EVENT_COUNT": len(registry.events),
        "EVENT_HEAD_LENGTH": 5,
        "PARAMETER_COUNT": len(registry.parameters),
        "ORDER_COUNT": len(registry.orders),
        "BAND_COUNT": len(registry.bands),
        "CHANNEL_COUNT": len(registry.channels),
        "FAULT_BITS": max(fault.bit for fault in registry.faults) + 1,
        "FAULTS_ASSIST_OFF": _fault_mask(registry, "ASSIST_OFF"),
        "FAULTS_LATCHED": _fault_mask(registry, "LATCHED"),
        "SCHEMA_HASH_LENGTH": 8,
        "SCHEMA_LENGTH": schema_length,
    }
    return [
        *(f"#define EBL_{name} {value}" for name, value in numbers.items()),
        *_riding(registry),
    ]


def _riding(registry: Registry) -> list[str]:
    values = {
        name: f"{value}u" if isinstance(value, int) else float_literal(value)
        for name, value in registry.riding.items()
    }
    return [f"#define EBL_{name.upper()} {value}" for name, value in values.items()]


def _fault_mask(registry: Registry, least: str) -> int:
    """The bits of the faults that are at least as severe."""
    severity = registry.enum("severity").members[least]
    return sum(1 << fault.bit for fault in registry.faults if fault.severity >= severity)


def _enums(registry: Registry) -> list[str]:
    lines = []
    for table in registry.enums:
        lines += [f"/* {table.doc} */", "typedef enum {"]
        prefix = enum_prefix(table)
        lines += [f"    {prefix}_{name} = {value}," for name, value in table.members.items()]
        lines += [f"}} ebl_{table.name};", ""]
    for table in registry.flags:
        lines += [f"/* {table.doc} */", "enum {"]
        prefix = enum_prefix(table)
        lines += [f"    {prefix}_{name} = {1 << bit}," for name, bit in table.members.items()]
        lines += ["};", ""]
    lines += ["enum {"]
    lines += [f"    EBL_MSG_{row.name} = 0x{row.id:04x}," for row in registry.messages]
    lines += ["};", "", "enum {"]
    lines += [
        f"    EBL_PARAMETER_{row.name.upper()} = 0x{row.id:04x}," for row in registry.parameters
    ]
    lines += ["};", "", "enum {"]
    lines += [f"    EBL_CHANNEL_{row.name.upper()} = {row.id}," for row in registry.channels]
    return [*lines, "};", ""]


def _config(registry: Registry) -> list[str]:
    members = [f"    {config_member(parameter)}" for parameter in registry.parameters]
    return ["typedef struct {", *members, "} ebl_config;", ""]


def _structs(registry: Registry) -> list[str]:
    lines = [
        "/* Messages and their layouts, see ebl_layout.h. A response's bytes start after the",
        " * status, an event's after code and time. */",
    ]
    for name, layout in layouts(registry):
        lines += [f"#define {name.upper()}_LENGTH {layout.length}"]
        lines += ["typedef struct {"]
        for field in layout.members:
            lines += [f"    {text}" for text in member(field, layout.is_halved(field))]
        lines += [f"}} {name};", f"extern const uint8_t {name}_layout[];", ""]
    return lines
