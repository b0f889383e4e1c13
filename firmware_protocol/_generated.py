"""Generated from registry.toml by `make gen`; change the registry, not this file."""

from dataclasses import dataclass
from enum import IntEnum, IntFlag
from typing import ClassVar

from firmware_protocol.layout import Channel, Field, Message, Order, Parameter

MAJOR = 1
MINOR = 0
MTU_BEFORE_HELLO = 128
MTU = 544
MAX_OUTSTANDING = 4
CONTROL_PERIOD_US = 10000
IMAGE_LENGTH = 299
SCHEMA_HASH = bytes.fromhex("b13ee7b28c3f71db")


class Status(IntEnum):
    """First byte of every response. Anything but OK carries a u16 detail after it."""

    OK = 0
    PENDING = 1
    UNKNOWN_MSG = 2
    LENGTH = 3
    VERSION = 4
    BUSY = 5
    STATE = 6
    RANGE = 7
    TYPE = 8
    UNKNOWN_ID = 9
    ACCESS = 10
    STALE_BASE = 11
    CRC_MISMATCH = 12
    INVALID_CONFIG = 13
    NOT_STOPPED = 14
    FLASH_FAIL = 15
    VERIFY_FAIL = 16
    NO_SPACE = 17
    BANDWIDTH = 18
    NOT_FOUND = 19
    EXPIRED = 20
    AUTH_BAD = 21
    AUTH_DELAY = 22
    RATE_LIMIT = 23
    UNSUPPORTED = 24
    SESSION = 25
    ABORTED = 26
    UNDERVOLTAGE = 27
    INTERNAL = 255


class DeviceClass(IntEnum):
    """What kind of unit answers HELLO. Bit 7 marks a simulated one."""

    MID_DRIVE = 1
    MID_DRIVE_SIMULATED = 129


class Access(IntEnum):
    """Who may change a parameter."""

    RIDER = 0
    DEALER = 1
    FACTORY = 2


class Bank(IntEnum):
    """Which copy of the configuration is meant."""

    ACTIVE = 0
    STAGED = 1
    PREVIOUS = 2
    DEFAULT = 3


class ConfigState(IntEnum):
    """Where the configuration transaction stands."""

    IDLE = 0
    STAGING = 1
    VALID = 2
    PROVISIONAL = 3


class Violation(IntEnum):
    """Why a parameter's value is refused."""

    NOT_FINITE = 1
    BELOW_MIN = 2
    ABOVE_MAX = 3
    NOT_INCREASING = 4
    NOT_A_CHOICE = 5
    NOT_TEXT = 6
    TAPER_ORDER = 7


class Law(IntEnum):
    """Which assist law a mode slot runs."""

    OFF = 0
    FIXED = 1
    FUZZY = 2


class Inference(IntEnum):
    """How the fuzzy rules are combined."""

    MAMDANI_CENTROID = 0
    WEIGHTED_AVERAGE = 1


class Label(IntEnum):
    """The five sets of every fuzzy variable, from least to most."""

    NB = 0
    NS = 1
    ZO = 2
    PS = 3
    PB = 4


class FallingTorque(IntEnum):
    """What the fuzzy law does while the rider's torque falls (thesis_checks I-16)."""

    HOLD_ZERO_RATE = 0
    NO_GAIN = 1


class Event(IntEnum):
    """What an EVENT frame tells."""

    BOOT = 1
    FAULT_SET = 2
    FAULT_CLEARED = 3
    CONFIG_COMMITTED = 4
    CONFIG_ROLLED_BACK = 5
    CONFIG_DEFAULTED = 6
    STREAM_STATS = 7


class LimitFlags(IntFlag):
    """Which steps of the assist pipeline held the motor back in this control step."""

    TAPER = 1
    SPEED_CUTOFF = 2
    PEDAL_STOP = 4
    BRAKE = 8
    RAMP_UP = 16
    RAMP_DOWN = 32
    MOTOR_TORQUE = 64
    BATTERY_CURRENT = 128
    MOTOR_SPEED = 256
    BATTERY_VOLTAGE = 512
    INPUT_REFUSED = 1024
    MODE_OFF = 2048


class FaultFlags(IntFlag):
    """What is wrong with the unit now."""

    TORQUE_SENSOR = 1
    SPEED_SENSOR = 2
    BATTERY_LOW = 4
    CONFIG_DEFAULTED = 8


class MessageId(IntEnum):
    """Service in the high byte, operation in the low byte."""

    HELLO = 0x0001
    PING = 0x0002
    SCHEMA_READ = 0x0003
    STATS = 0x0005
    BYE = 0x0007
    CFG_INFO = 0x0100
    CFG_READ = 0x0101
    CFG_BEGIN = 0x0120
    CFG_SET = 0x0121
    CFG_VALIDATE = 0x0122
    CFG_STAGED_CRC = 0x0123
    CFG_COMMIT = 0x0125
    CFG_ABORT = 0x0128
    STR_SUBSCRIBE = 0x0201
    STR_UNSUBSCRIBE = 0x0202
    STR_RENEW = 0x0203
    STR_SNAPSHOT = 0x0205
    EVT_FAULT_LIST = 0x0302
    SIM_GET = 0x7001
    SIM_SET = 0x7002


@dataclass(frozen=True, slots=True)
class HelloRequest(Message):
    """Who are you, and which versions do we share. Frozen for ever, like SCHEMA_READ."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.HELLO
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("major_min", "u8"),
        Field("major_max", "u8"),
        Field("host_flags", "u16"),
        Field("host_mtu", "u16"),
        Field("host_nonce", "u8", 8),
    )
    LENGTH: ClassVar[int] = 14

    major_min: int
    major_max: int
    host_flags: int
    host_mtu: int
    host_nonce: bytes


@dataclass(frozen=True, slots=True)
class HelloResponse(Message):
    """Who are you, and which versions do we share. Frozen for ever, like SCHEMA_READ."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.HELLO
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("major", "u8"),
        Field("minor", "u8"),
        Field("device_class", "u8"),
        Field("hardware_revision", "u16"),
        Field("firmware_version", "u16", 3),
        Field("git", "u8", 8),
        Field("uid", "u8", 12),
        Field("boot_id", "u32"),
        Field("session_id", "u32"),
        Field("schema_hash", "u8", 8),
        Field("config_generation", "u32"),
        Field("config_crc32", "u32"),
        Field("rx_mtu", "u16"),
        Field("tx_mtu", "u16"),
        Field("max_outstanding", "u8"),
        Field("access", "u8"),
        Field("baud_bitmap", "u16"),
        Field("features", "u32"),
        Field("uptime_us", "u64"),
    )
    LENGTH: ClassVar[int] = 75

    major: int
    minor: int
    device_class: int
    hardware_revision: int
    firmware_version: tuple[int, int, int]
    git: bytes
    uid: bytes
    boot_id: int
    session_id: int
    schema_hash: bytes
    config_generation: int
    config_crc32: int
    rx_mtu: int
    tx_mtu: int
    max_outstanding: int
    access: int
    baud_bitmap: int
    features: int
    uptime_us: int


@dataclass(frozen=True, slots=True)
class PingRequest(Message):
    """Are you there."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.PING


@dataclass(frozen=True, slots=True)
class PingResponse(Message):
    """Are you there."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.PING


@dataclass(frozen=True, slots=True)
class SchemaReadRequest(Message):
    """A piece of the zlib-compressed canonical JSON of this registry, as the unit was built with it."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.SCHEMA_READ
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("offset", "u32"),
        Field("length", "u16"),
    )
    LENGTH: ClassVar[int] = 6

    offset: int
    length: int


@dataclass(frozen=True, slots=True)
class SchemaReadResponse(Message):
    """A piece of the zlib-compressed canonical JSON of this registry, as the unit was built with it."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.SCHEMA_READ
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("total_length", "u32"),
        Field("data", "bytes"),
    )
    LENGTH: ClassVar[int] = 4

    total_length: int
    data: bytes


@dataclass(frozen=True, slots=True)
class StatsRequest(Message):
    """What the unit's receiver counted since boot."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STATS


@dataclass(frozen=True, slots=True)
class StatsResponse(Message):
    """What the unit's receiver counted since boot."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STATS
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("frames_ok", "u32"),
        Field("crc_errors", "u32"),
        Field("cobs_errors", "u32"),
        Field("overflows", "u32"),
        Field("dropped_tx", "u32"),
    )
    LENGTH: ClassVar[int] = 20

    frames_ok: int
    crc_errors: int
    cobs_errors: int
    overflows: int
    dropped_tx: int


@dataclass(frozen=True, slots=True)
class ByeRequest(Message):
    """The host leaves: streams end, a staged configuration is dropped."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.BYE


@dataclass(frozen=True, slots=True)
class ByeResponse(Message):
    """The host leaves: streams end, a staged configuration is dropped."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.BYE


@dataclass(frozen=True, slots=True)
class CfgInfoRequest(Message):
    """Which configuration is active."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_INFO


@dataclass(frozen=True, slots=True)
class CfgInfoResponse(Message):
    """Which configuration is active."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_INFO
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("generation", "u32"),
        Field("crc32", "u32"),
        Field("image_length", "u16"),
        Field("state", "u8"),
    )
    LENGTH: ClassVar[int] = 11

    generation: int
    crc32: int
    image_length: int
    state: int


@dataclass(frozen=True, slots=True)
class CfgReadRequest(Message):
    """A piece of a bank's image."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_READ
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("bank", "u8"),
        Field("offset", "u16"),
        Field("length", "u16"),
    )
    LENGTH: ClassVar[int] = 5

    bank: int
    offset: int
    length: int


@dataclass(frozen=True, slots=True)
class CfgReadResponse(Message):
    """A piece of a bank's image."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_READ
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("generation", "u32"),
        Field("total_length", "u16"),
        Field("data", "bytes"),
    )
    LENGTH: ClassVar[int] = 6

    generation: int
    total_length: int
    data: bytes


@dataclass(frozen=True, slots=True)
class CfgBeginRequest(Message):
    """Opens a transaction on the configuration the host believes is active; STALE_BASE otherwise."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_BEGIN
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("base_generation", "u32"),
        Field("base_crc32", "u32"),
    )
    LENGTH: ClassVar[int] = 8

    base_generation: int
    base_crc32: int


@dataclass(frozen=True, slots=True)
class CfgBeginResponse(Message):
    """Opens a transaction on the configuration the host believes is active; STALE_BASE otherwise."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_BEGIN
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("transaction", "u16"),
        Field("lease_ms", "u16"),
    )
    LENGTH: ClassVar[int] = 4

    transaction: int
    lease_ms: int


@dataclass(frozen=True, slots=True)
class CfgSetRequest(Message):
    """Items of id u16, first index u8, count u8, then the values. All of them or none."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_SET
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("transaction", "u16"),
        Field("items", "bytes"),
    )
    LENGTH: ClassVar[int] = 2

    transaction: int
    items: bytes


@dataclass(frozen=True, slots=True)
class CfgSetResponse(Message):
    """Items of id u16, first index u8, count u8, then the values. All of them or none."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_SET


@dataclass(frozen=True, slots=True)
class CfgValidateRequest(Message):
    """Checks the staged image. INVALID_CONFIG lists every violation as id u16, index u8, code u8 after the detail (their number)."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_VALIDATE
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("transaction", "u16"),
    )
    LENGTH: ClassVar[int] = 2

    transaction: int


@dataclass(frozen=True, slots=True)
class CfgValidateResponse(Message):
    """Checks the staged image. INVALID_CONFIG lists every violation as id u16, index u8, code u8 after the detail (their number)."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_VALIDATE


@dataclass(frozen=True, slots=True)
class CfgStagedCrcRequest(Message):
    """The CRC-32 of the staged image."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_STAGED_CRC
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("transaction", "u16"),
    )
    LENGTH: ClassVar[int] = 2

    transaction: int


@dataclass(frozen=True, slots=True)
class CfgStagedCrcResponse(Message):
    """The CRC-32 of the staged image."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_STAGED_CRC
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("crc32", "u32"),
    )
    LENGTH: ClassVar[int] = 4

    crc32: int


@dataclass(frozen=True, slots=True)
class CfgCommitRequest(Message):
    """Makes the staged image active if its CRC is the one the host computed for itself."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_COMMIT
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("transaction", "u16"),
        Field("staged_crc32", "u32"),
        Field("flags", "u8"),
        Field("confirm_s", "u8"),
    )
    LENGTH: ClassVar[int] = 8

    transaction: int
    staged_crc32: int
    flags: int
    confirm_s: int


@dataclass(frozen=True, slots=True)
class CfgCommitResponse(Message):
    """Makes the staged image active if its CRC is the one the host computed for itself."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_COMMIT
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("generation", "u32"),
        Field("crc32", "u32"),
        Field("state", "u8"),
    )
    LENGTH: ClassVar[int] = 9

    generation: int
    crc32: int
    state: int


@dataclass(frozen=True, slots=True)
class CfgAbortRequest(Message):
    """Drops the staged image; the active one was never touched."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_ABORT
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("transaction", "u16"),
    )
    LENGTH: ClassVar[int] = 2

    transaction: int


@dataclass(frozen=True, slots=True)
class CfgAbortResponse(Message):
    """Drops the staged image; the active one was never touched."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.CFG_ABORT


@dataclass(frozen=True, slots=True)
class StrSubscribeRequest(Message):
    """Sends the channels every `divider` control steps, `batch` rows a frame, until the lease ends."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_SUBSCRIBE
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("stream_id", "u8"),
        Field("divider", "u16"),
        Field("batch", "u8"),
        Field("encoding", "u8"),
        Field("lease_s", "u8"),
        Field("channel_ids", "bytes"),
    )
    LENGTH: ClassVar[int] = 6

    stream_id: int
    divider: int
    batch: int
    encoding: int
    lease_s: int
    channel_ids: bytes


@dataclass(frozen=True, slots=True)
class StrSubscribeResponse(Message):
    """Sends the channels every `divider` control steps, `batch` rows a frame, until the lease ends."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_SUBSCRIBE
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("period_us", "u32"),
        Field("batch", "u8"),
        Field("epoch", "u8"),
        Field("start_seq", "u16"),
        Field("bytes_per_s", "u32"),
    )
    LENGTH: ClassVar[int] = 12

    period_us: int
    batch: int
    epoch: int
    start_seq: int
    bytes_per_s: int


@dataclass(frozen=True, slots=True)
class StrUnsubscribeRequest(Message):
    """Ends a stream."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_UNSUBSCRIBE
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("stream_id", "u8"),
    )
    LENGTH: ClassVar[int] = 1

    stream_id: int


@dataclass(frozen=True, slots=True)
class StrUnsubscribeResponse(Message):
    """Ends a stream."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_UNSUBSCRIBE


@dataclass(frozen=True, slots=True)
class StrRenewRequest(Message):
    """Keeps a stream alive for another lease."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_RENEW
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("stream_id", "u8"),
        Field("lease_s", "u8"),
    )
    LENGTH: ClassVar[int] = 2

    stream_id: int
    lease_s: int


@dataclass(frozen=True, slots=True)
class StrRenewResponse(Message):
    """Keeps a stream alive for another lease."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_RENEW


@dataclass(frozen=True, slots=True)
class StrSnapshotRequest(Message):
    """One row of the channels, now."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_SNAPSHOT
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("channel_ids", "bytes"),
    )
    LENGTH: ClassVar[int] = 0

    channel_ids: bytes


@dataclass(frozen=True, slots=True)
class StrSnapshotResponse(Message):
    """One row of the channels, now."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.STR_SNAPSHOT
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("t_us", "u64"),
        Field("values", "bytes"),
    )
    LENGTH: ClassVar[int] = 8

    t_us: int
    values: bytes


@dataclass(frozen=True, slots=True)
class EvtFaultListRequest(Message):
    """The faults that are active."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.EVT_FAULT_LIST


@dataclass(frozen=True, slots=True)
class EvtFaultListResponse(Message):
    """The faults that are active."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.EVT_FAULT_LIST
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("fault_flags", "u16"),
    )
    LENGTH: ClassVar[int] = 2

    fault_flags: int


@dataclass(frozen=True, slots=True)
class SimGetRequest(Message):
    """Simulated units only: what rider, road and clock do now, as JSON text. A real unit answers UNKNOWN_MSG."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.SIM_GET


@dataclass(frozen=True, slots=True)
class SimGetResponse(Message):
    """Simulated units only: what rider, road and clock do now, as JSON text. A real unit answers UNKNOWN_MSG."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.SIM_GET
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("text", "bytes"),
    )
    LENGTH: ClassVar[int] = 0

    text: bytes


@dataclass(frozen=True, slots=True)
class SimSetRequest(Message):
    """Simulated units only: changes what the JSON text names and answers like SIM_GET."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.SIM_SET
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("text", "bytes"),
    )
    LENGTH: ClassVar[int] = 0

    text: bytes


@dataclass(frozen=True, slots=True)
class SimSetResponse(Message):
    """Simulated units only: changes what the JSON text names and answers like SIM_GET."""

    MESSAGE_ID: ClassVar[MessageId] = MessageId.SIM_SET
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("text", "bytes"),
    )
    LENGTH: ClassVar[int] = 0

    text: bytes


@dataclass(frozen=True, slots=True)
class BootEvent(Message):
    """Fields of the event BOOT."""

    CODE: ClassVar[Event] = Event.BOOT
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("boot_id", "u32"),
        Field("reset_cause", "u8"),
    )
    LENGTH: ClassVar[int] = 5

    boot_id: int
    reset_cause: int


@dataclass(frozen=True, slots=True)
class FaultSetEvent(Message):
    """Fields of the event FAULT_SET."""

    CODE: ClassVar[Event] = Event.FAULT_SET
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("fault_flags", "u16"),
    )
    LENGTH: ClassVar[int] = 2

    fault_flags: int


@dataclass(frozen=True, slots=True)
class FaultClearedEvent(Message):
    """Fields of the event FAULT_CLEARED."""

    CODE: ClassVar[Event] = Event.FAULT_CLEARED
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("fault_flags", "u16"),
    )
    LENGTH: ClassVar[int] = 2

    fault_flags: int


@dataclass(frozen=True, slots=True)
class ConfigCommittedEvent(Message):
    """Fields of the event CONFIG_COMMITTED."""

    CODE: ClassVar[Event] = Event.CONFIG_COMMITTED
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("generation", "u32"),
        Field("crc32", "u32"),
    )
    LENGTH: ClassVar[int] = 8

    generation: int
    crc32: int


@dataclass(frozen=True, slots=True)
class ConfigRolledBackEvent(Message):
    """Fields of the event CONFIG_ROLLED_BACK."""

    CODE: ClassVar[Event] = Event.CONFIG_ROLLED_BACK
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("generation", "u32"),
        Field("crc32", "u32"),
    )
    LENGTH: ClassVar[int] = 8

    generation: int
    crc32: int


@dataclass(frozen=True, slots=True)
class ConfigDefaultedEvent(Message):
    """Fields of the event CONFIG_DEFAULTED."""

    CODE: ClassVar[Event] = Event.CONFIG_DEFAULTED
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("generation", "u32"),
        Field("crc32", "u32"),
    )
    LENGTH: ClassVar[int] = 8

    generation: int
    crc32: int


@dataclass(frozen=True, slots=True)
class StreamStatsEvent(Message):
    """Fields of the event STREAM_STATS."""

    CODE: ClassVar[Event] = Event.STREAM_STATS
    LAYOUT: ClassVar[tuple[Field, ...]] = (
        Field("stream_id", "u8"),
        Field("built", "u32"),
        Field("dropped_tx", "u32"),
    )
    LENGTH: ClassVar[int] = 9

    stream_id: int
    built: int
    dropped_tx: int


REQUEST_BY_ID: dict[int, type[Message]] = {
    0x0001: HelloRequest,
    0x0002: PingRequest,
    0x0003: SchemaReadRequest,
    0x0005: StatsRequest,
    0x0007: ByeRequest,
    0x0100: CfgInfoRequest,
    0x0101: CfgReadRequest,
    0x0120: CfgBeginRequest,
    0x0121: CfgSetRequest,
    0x0122: CfgValidateRequest,
    0x0123: CfgStagedCrcRequest,
    0x0125: CfgCommitRequest,
    0x0128: CfgAbortRequest,
    0x0201: StrSubscribeRequest,
    0x0202: StrUnsubscribeRequest,
    0x0203: StrRenewRequest,
    0x0205: StrSnapshotRequest,
    0x0302: EvtFaultListRequest,
    0x7001: SimGetRequest,
    0x7002: SimSetRequest,
}

RESPONSE_BY_ID: dict[int, type[Message]] = {
    0x0001: HelloResponse,
    0x0002: PingResponse,
    0x0003: SchemaReadResponse,
    0x0005: StatsResponse,
    0x0007: ByeResponse,
    0x0100: CfgInfoResponse,
    0x0101: CfgReadResponse,
    0x0120: CfgBeginResponse,
    0x0121: CfgSetResponse,
    0x0122: CfgValidateResponse,
    0x0123: CfgStagedCrcResponse,
    0x0125: CfgCommitResponse,
    0x0128: CfgAbortResponse,
    0x0201: StrSubscribeResponse,
    0x0202: StrUnsubscribeResponse,
    0x0203: StrRenewResponse,
    0x0205: StrSnapshotResponse,
    0x0302: EvtFaultListResponse,
    0x7001: SimGetResponse,
    0x7002: SimSetResponse,
}

EVENT_BY_CODE: dict[int, type[Message]] = {
    Event.BOOT: BootEvent,
    Event.FAULT_SET: FaultSetEvent,
    Event.FAULT_CLEARED: FaultClearedEvent,
    Event.CONFIG_COMMITTED: ConfigCommittedEvent,
    Event.CONFIG_ROLLED_BACK: ConfigRolledBackEvent,
    Event.CONFIG_DEFAULTED: ConfigDefaultedEvent,
    Event.STREAM_STATS: StreamStatsEvent,
}

ENUM_BY_NAME: dict[str, type[IntEnum]] = {
    "status": Status,
    "device_class": DeviceClass,
    "access": Access,
    "bank": Bank,
    "config_state": ConfigState,
    "violation": Violation,
    "law": Law,
    "inference": Inference,
    "label": Label,
    "falling_torque": FallingTorque,
    "event": Event,
}

PARAMETERS: tuple[Parameter, ...] = (
    Parameter(
        id=0x0100, name="sensor_offset_counts", group="sensor",
        type="f32", unit="counts", shape=(),
        length=4, min=-30000, max=30000, enum=None,
        increasing=False, access=1, image_offset=0,
        default=0.0,
        doc="Raw reading of the torque sensor with no load on the pedals.",
    ),
    Parameter(
        id=0x0101, name="sensor_gain_nm_per_count", group="sensor",
        type="f32", unit="Nm/count", shape=(),
        length=4, min=0.001, max=0.1, enum=None,
        increasing=False, access=1, image_offset=4,
        default=0.01,
        doc="Torque per raw count, found by hanging known weights on the pedal.",
    ),
    Parameter(
        id=0x0102, name="torque_filter_s", group="sensor",
        type="f32", unit="s", shape=(),
        length=4, min=0.02, max=2.0, enum=None,
        increasing=False, access=1, image_offset=8,
        default=0.5,
        doc="Time constant that averages the rider's torque over the pedal stroke (thesis_checks 4.4).",
    ),
    Parameter(
        id=0x0103, name="torque_rate_interval_ms", group="sensor",
        type="u16", unit="ms", shape=(),
        length=2, min=10, max=500, enum=None,
        increasing=False, access=1, image_offset=12,
        default=100,
        doc="Time over which the relative torque rate of eq. 4.16 is taken (thesis_checks I-15).",
    ),
    Parameter(
        id=0x0104, name="torque_rate_floor_nm", group="sensor",
        type="f32", unit="Nm", shape=(),
        length=4, min=0.1, max=10.0, enum=None,
        increasing=False, access=1, image_offset=14,
        default=1.0,
        doc="Smallest torque the rate is divided by, so that starting to pedal is not a division by zero.",
    ),
    Parameter(
        id=0x0200, name="assist_mode_at_start", group="assist",
        type="u8", unit="", shape=(),
        length=1, min=0, max=4, enum=None,
        increasing=False, access=1, image_offset=18,
        default=3,
        doc="The mode slot that is selected when the unit is switched on.",
    ),
    Parameter(
        id=0x0201, name="mode_names", group="assist",
        type="text", unit="", shape=(5,),
        length=16, min=None, max=None, enum=None,
        increasing=False, access=1, image_offset=19,
        default=("off", "eco", "tour", "sport", "boost"),
        doc="What the five mode slots are called on the display.",
    ),
    Parameter(
        id=0x0202, name="mode_laws", group="assist",
        type="u8", unit="", shape=(5,),
        length=1, min=None, max=None, enum="law",
        increasing=False, access=1, image_offset=99,
        default=("OFF", "FIXED", "FIXED", "FUZZY", "FUZZY"),
        doc="The assist law of each mode slot.",
    ),
    Parameter(
        id=0x0203, name="mode_ratios", group="assist",
        type="f32", unit="", shape=(5,),
        length=4, min=0.0, max=3.0, enum=None,
        increasing=False, access=1, image_offset=104,
        default=(0.0, 0.5, 1.0, 1.0, 1.5),
        doc="Motor torque at the crank per rider torque, before gain and taper.",
    ),
    Parameter(
        id=0x0204, name="fixed_taper_start_kmh", group="assist",
        type="f32", unit="km/h", shape=(),
        length=4, min=0.0, max=25.0, enum=None,
        increasing=False, access=1, image_offset=124,
        default=15.0,
        doc="Speed above which the fixed law's ratio falls in a straight line.",
    ),
    Parameter(
        id=0x0205, name="fixed_taper_end_kmh", group="assist",
        type="f32", unit="km/h", shape=(),
        length=4, min=0.0, max=25.0, enum=None,
        increasing=False, access=1, image_offset=128,
        default=24.0,
        doc="Speed at which the fixed law's ratio reaches zero (thesis_checks I-13).",
    ),
    Parameter(
        id=0x0206, name="assist_ramp_up_nm_per_s", group="assist",
        type="f32", unit="Nm/s", shape=(),
        length=4, min=5.0, max=2000.0, enum=None,
        increasing=False, access=1, image_offset=132,
        default=200.0,
        doc="Fastest rise of the assist torque at the crank.",
    ),
    Parameter(
        id=0x0207, name="assist_ramp_down_nm_per_s", group="assist",
        type="f32", unit="Nm/s", shape=(),
        length=4, min=20.0, max=2000.0, enum=None,
        increasing=False, access=1, image_offset=136,
        default=400.0,
        doc="Fastest gentle fall of the assist torque at the crank; a cut-off does not wait for it.",
    ),
    Parameter(
        id=0x0208, name="pedal_torque_nm_min", group="assist",
        type="f32", unit="Nm", shape=(),
        length=4, min=0.0, max=20.0, enum=None,
        increasing=False, access=1, image_offset=140,
        default=1.0,
        doc="Rider torque below which the law gives no assist.",
    ),
    Parameter(
        id=0x0300, name="fuzzy_table_name", group="fuzzy",
        type="text", unit="", shape=(),
        length=24, min=None, max=None, enum=None,
        increasing=False, access=1, image_offset=144,
        default="thesis 4-2",
        doc="What the rule table is called.",
    ),
    Parameter(
        id=0x0301, name="fuzzy_inference", group="fuzzy",
        type="u8", unit="", shape=(),
        length=1, min=None, max=None, enum="inference",
        increasing=False, access=1, image_offset=168,
        default="MAMDANI_CENTROID",
        doc="Exact centroid of the thesis, or weighted average, which is provably monotone with a monotone table.",
    ),
    Parameter(
        id=0x0302, name="fuzzy_speed_points_kmh", group="fuzzy",
        type="f32", unit="km/h", shape=(5,),
        length=4, min=0.0, max=45.0, enum=None,
        increasing=True, access=1, image_offset=169,
        default=(5.0, 10.0, 15.0, 20.0, 25.0),
        doc="Peaks of the five speed sets.",
    ),
    Parameter(
        id=0x0303, name="fuzzy_torque_rate_points", group="fuzzy",
        type="f32", unit="", shape=(5,),
        length=4, min=0.0, max=5.0, enum=None,
        increasing=True, access=1, image_offset=189,
        default=(0.0, 0.225, 0.45, 0.675, 0.9),
        doc="Peaks of the five torque-rate sets (relative change over the rate interval).",
    ),
    Parameter(
        id=0x0304, name="fuzzy_gain_points", group="fuzzy",
        type="f32", unit="", shape=(5,),
        length=4, min=0.0, max=0.5, enum=None,
        increasing=True, access=1, image_offset=209,
        default=(0.1, 0.2, 0.3, 0.4, 0.5),
        doc="Peaks of the five gain sets: what the rules add to the mode's ratio.",
    ),
    Parameter(
        id=0x0305, name="fuzzy_rules", group="fuzzy",
        type="u8", unit="", shape=(5, 5),
        length=1, min=None, max=None, enum="label",
        increasing=False, access=1, image_offset=229,
        default=(("ZO", "ZO", "PS", "PB", "PB"), ("ZO", "ZO", "PS", "PS", "PB"), ("NS", "ZO", "ZO", "PS", "PS"), ("NB", "NS", "NS", "ZO", "ZO"), ("NB", "NB", "NS", "NS", "NS")),
        doc="Gain label for each speed (row) and torque rate (column): thesis table 4-2.",
    ),
    Parameter(
        id=0x0306, name="fuzzy_falling_torque", group="fuzzy",
        type="u8", unit="", shape=(),
        length=1, min=None, max=None, enum="falling_torque",
        increasing=False, access=1, image_offset=254,
        default="HOLD_ZERO_RATE",
        doc="What the gain does while the rider's torque falls.",
    ),
    Parameter(
        id=0x0400, name="assist_cutoff_kmh", group="limits",
        type="f32", unit="km/h", shape=(),
        length=4, min=0.0, max=25.0, enum=None,
        increasing=False, access=1, image_offset=255,
        default=25.0,
        doc="Speed at and above which there is no assist, whatever the table says.",
    ),
    Parameter(
        id=0x0401, name="assist_cutoff_band_kmh", group="limits",
        type="f32", unit="km/h", shape=(),
        length=4, min=0.0, max=5.0, enum=None,
        increasing=False, access=1, image_offset=259,
        default=0.0,
        doc="Width of the soft ramp below the cut-off speed; 0 cuts hard.",
    ),
    Parameter(
        id=0x0402, name="motor_torque_nm_max", group="limits",
        type="f32", unit="Nm", shape=(),
        length=4, min=0.0, max=2.0, enum=None,
        increasing=False, access=1, image_offset=263,
        default=2.0,
        doc="Largest torque at the motor's shaft.",
    ),
    Parameter(
        id=0x0403, name="battery_current_a_max", group="limits",
        type="f32", unit="A", shape=(),
        length=4, min=1.0, max=12.0, enum=None,
        increasing=False, access=1, image_offset=267,
        default=12.0,
        doc="Largest current drawn from the battery.",
    ),
    Parameter(
        id=0x0404, name="battery_voltage_v_min", group="limits",
        type="f32", unit="V", shape=(),
        length=4, min=24.0, max=40.0, enum=None,
        increasing=False, access=1, image_offset=271,
        default=30.0,
        doc="Battery voltage below which assist ends.",
    ),
    Parameter(
        id=0x0405, name="motor_speed_rpm_max", group="limits",
        type="f32", unit="rpm", shape=(),
        length=4, min=500.0, max=3000.0, enum=None,
        increasing=False, access=1, image_offset=275,
        default=3000.0,
        doc="Motor speed at and above which it gives no torque.",
    ),
    Parameter(
        id=0x0406, name="pedal_stop_ms", group="limits",
        type="u16", unit="ms", shape=(),
        length=2, min=50, max=1000, enum=None,
        increasing=False, access=1, image_offset=279,
        default=150,
        doc="Time without forward pedalling after which assist is cut.",
    ),
    Parameter(
        id=0x0500, name="gear_ratio", group="drivetrain",
        type="f32", unit="", shape=(),
        length=4, min=1.0, max=100.0, enum=None,
        increasing=False, access=2, image_offset=281,
        default=40.34,
        doc="Motor turns per crank turn (thesis text 4.10; the teeth of table 2-3 give 36.744, thesis_checks I-1).",
    ),
    Parameter(
        id=0x0501, name="chainring_teeth", group="drivetrain",
        type="u8", unit="", shape=(),
        length=1, min=10, max=80, enum=None,
        increasing=False, access=2, image_offset=285,
        default=44,
        doc="Teeth of the chainring.",
    ),
    Parameter(
        id=0x0502, name="cog_teeth", group="drivetrain",
        type="u8", unit="", shape=(),
        length=1, min=8, max=60, enum=None,
        increasing=False, access=2, image_offset=286,
        default=14,
        doc="Teeth of the rear cog.",
    ),
    Parameter(
        id=0x0503, name="wheel_radius_m", group="drivetrain",
        type="f32", unit="m", shape=(),
        length=4, min=0.15, max=0.45, enum=None,
        increasing=False, access=2, image_offset=287,
        default=0.33,
        doc="Rolling radius of the driven wheel.",
    ),
    Parameter(
        id=0x0510, name="motor_torque_constant_nm_per_a", group="drivetrain",
        type="f32", unit="Nm/A", shape=(),
        length=4, min=0.01, max=1.0, enum=None,
        increasing=False, access=2, image_offset=291,
        default=0.112,
        doc="Torque per ampere, and volts per rad/s, of the motor (thesis_checks I-5).",
    ),
    Parameter(
        id=0x0511, name="motor_resistance_ohm", group="drivetrain",
        type="f32", unit="ohm", shape=(),
        length=4, min=0.01, max=2.0, enum=None,
        increasing=False, access=2, image_offset=295,
        default=0.25,
        doc="Resistance of winding, bridge and lead (thesis_checks I-5).",
    ),
)
PARAMETER_BY_NAME = {parameter.name: parameter for parameter in PARAMETERS}
PARAMETER_BY_ID = {parameter.id: parameter for parameter in PARAMETERS}

ORDERS: tuple[Order, ...] = (
    Order("fixed_taper_start_kmh", "fixed_taper_end_kmh", "TAPER_ORDER"),
)

CHANNELS: tuple[Channel, ...] = (
    Channel(1, "speed_kmh", "km/h", 0.01, "Bike speed."),
    Channel(2, "cadence_rpm", "rpm", 0.01, "Crank speed."),
    Channel(3, "crank_angle_deg", "deg", 0.02, "Crank angle, 0 with the left crank up."),
    Channel(4, "rider_torque_nm", "Nm", 0.01, "Rider torque at the spindle, as calibrated, unfiltered."),
    Channel(5, "rider_torque_raw", "counts", 1, "Torque sensor reading before calibration."),
    Channel(6, "rider_torque_filtered_nm", "Nm", 0.01, "Rider torque averaged over the stroke: what the law acts on."),
    Channel(7, "torque_rate", "", 0.0005, "Relative torque change over the rate interval: the law's second input."),
    Channel(8, "motor_torque_nm", "Nm", 0.0001, "Torque at the motor's shaft; times gear_ratio it is the torque at the crank."),
    Channel(9, "motor_current_a", "A", 0.001, "Current in the motor."),
    Channel(10, "motor_speed_rpm", "rpm", 0.1, "Motor speed."),
    Channel(11, "battery_current_a", "A", 0.001, "Current from the battery."),
    Channel(12, "battery_voltage_v", "V", 0.002, "Battery voltage at the terminals."),
    Channel(13, "battery_soc_pct", "%", 0.01, "Battery state of charge."),
    Channel(14, "assist_ratio", "", 0.0002, "Motor torque at the crank over filtered rider torque that the law asks for, gain included, before limits."),
    Channel(15, "fuzzy_gain", "", 5e-05, "Gain of the fuzzy law; missing where the mode does not use it."),
    Channel(16, "assist_mode", "", 1, "Selected mode slot, 0 to 4."),
    Channel(17, "limit_flags", "flags", 1, "Bits of limit_flags."),
    Channel(18, "motor_temperature_degc", "degC", 0.01, "Motor winding temperature."),
    Channel(19, "sensor_temperature_degc", "degC", 0.01, "Temperature at the torque sensor."),
    Channel(20, "fault_flags", "flags", 1, "Bits of fault_flags."),
)
CHANNEL_BY_NAME = {channel.name: channel for channel in CHANNELS}
CHANNEL_BY_ID = {channel.id: channel for channel in CHANNELS}
