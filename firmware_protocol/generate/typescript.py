"""frontend/src/generated/registry.ts: what the browser shows, as typed constants."""

import json
from typing import Any

from firmware_protocol.generate.registry import NOTICE, Registry
from firmware_protocol.spelling import word_of

FIRST_LINE = f"// {NOTICE}"

TYPES = """\
/** What the API does not tell of a parameter. */
export interface ParameterRow {
  /** Bytes of one element; a text's longest UTF-8. */
  readonly length: number;
  /** Least distance of neighbours that increase, to a hundredth; 0 for all others. */
  readonly least_step: number;
  /** Going down is free, going up needs a token. */
  readonly ratchet: boolean;
}

export interface ChannelRow {
  readonly unit: string;
}

export interface FaultRow {
  /** How it ends: by itself, or where it is latched only when it is cleared. */
  readonly severity: "warning" | "assist_off" | "latched";
  /** What the rider reads: what to do now. */
  readonly rider_text: string;
  /** What a mechanic measures and mends. */
  readonly mechanic_text: string;
}
"""


def module(registry: Registry) -> str:
    """The text of registry.ts."""
    parameters: dict[str, Any] = {
        row.name: {"length": row.length, "least_step": row.least_step, "ratchet": row.ratchet}
        for row in registry.parameters
    }
    channels = {row.name: {"unit": row.unit} for row in registry.channels}
    flags = {
        table.name: {word_of(name): bit for name, bit in table.members.items()}
        for table in registry.flags
        if table.name in channels
    }
    lines = [FIRST_LINE, "", TYPES]
    lines += [
        "/** The telemetry count that stands for no value. */",
        "export const MISSING = -32768;",
    ]
    lines += [f"export const CONTROL_PERIOD_US = {registry.protocol['control_period_us']};"]
    for name in ("resting_kmh", "resting_motor_rpm"):
        lines += [f"export const {name.upper()} = {registry.riding[name]:g};"]
    lines += [""]
    lines += ["/** Bit numbers of the channels that are flags. */"]
    lines += _object("FLAGS", flags, "")
    lines += _object("PARAMETERS", parameters, "Record<string, ParameterRow>")
    lines += ["export type ParameterName = keyof typeof PARAMETERS;", ""]
    lines += _object("CHANNELS", channels, "Record<string, ChannelRow>")
    lines += ["export type ChannelName = keyof typeof CHANNELS;", ""]
    lines += _object("FAULTS", _faults(registry), "Record<string, FaultRow>")
    lines += ["export type FaultName = keyof typeof FAULTS;"]
    return "\n".join(lines) + "\n"


def _faults(registry: Registry) -> dict[str, Any]:
    severities = {value: name for name, value in registry.enum("severity").members.items()}
    return {
        word_of(row.name): {
            "severity": word_of(severities[row.severity]),
            "rider_text": row.rider_text,
            "mechanic_text": row.mechanic_text,
        }
        for row in registry.faults
    }


def _object(name: str, rows: dict[str, Any], row_type: str) -> list[str]:
    lines = [f"export const {name} = {{"]
    for key, row in rows.items():
        lines.append(f"  {key}: {{")
        lines += [
            f"    {field}: {json.dumps(value, ensure_ascii=False)}," for field, value in row.items()
        ]
        lines.append("  },")
    return [*lines, "} as const" + (f" satisfies {row_type};" if row_type else ";"), ""]
