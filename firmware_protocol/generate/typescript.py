"""frontend/src/generated/registry.ts: what the browser shows, as typed constants."""

import json
from typing import Any

from firmware_protocol.generate.registry import NOTICE, Registry

FIRST_LINE = f"// {NOTICE}"

TYPES = """\
export type ParameterValue = number | string | readonly ParameterValue[];

export interface ParameterRow {
  readonly id: number;
  readonly name: string;
  readonly group: string;
  readonly type: "f32" | "u8" | "u16" | "text";
  readonly unit: string;
  readonly shape: readonly number[];
  /** Bytes of one element; a text's longest UTF-8. */
  readonly length: number;
  readonly min: number | null;
  readonly max: number | null;
  readonly enum: string | null;
  readonly increasing: boolean;
  /** Least distance of neighbours that increase, to a hundredth; 0 for all others. */
  readonly least_step: number;
  /** Going down is free, going up needs a token. */
  readonly ratchet: boolean;
  readonly default: ParameterValue;
  readonly access: string;
}

export interface ChannelRow {
  readonly id: number;
  readonly name: string;
  readonly unit: string;
  /** value = count * scale */
  readonly scale: number;
}

export interface FaultRow {
  readonly bit: number;
  /** WARNING, ASSIST_OFF or LATCHED */
  readonly severity: string;
  /** What the rider reads: what to do now. */
  readonly rider_text: string;
  /** What a mechanic measures and mends. */
  readonly mechanic_text: string;
}
"""


def module(registry: Registry) -> str:
    """The text of registry.ts."""
    access = {value: name for name, value in registry.enum("access").members.items()}
    parameters: dict[str, Any] = {
        row.name: {
            "id": row.id,
            "name": row.name,
            "group": row.group,
            "type": row.type,
            "unit": row.unit,
            "shape": row.shape,
            "length": row.length,
            "min": row.min,
            "max": row.max,
            "enum": row.enum,
            "increasing": row.increasing,
            "least_step": row.least_step,
            "ratchet": row.ratchet,
            "default": row.default,
            "access": access[row.access],
        }
        for row in registry.parameters
    }
    channels = {
        row.name: {
            "id": row.id,
            "name": row.name,
            "unit": row.unit,
            "scale": row.scale,
        }
        for row in registry.channels
    }
    lines = [FIRST_LINE, "", TYPES]
    lines += [
        "/** The telemetry count that stands for no value. */",
        "export const MISSING = -32768;",
    ]
    lines += [f"export const CONTROL_PERIOD_US = {registry.protocol['control_period_us']};", ""]
    lines += _object("ENUMS", {table.name: table.members for table in registry.enums}, "")
    lines += ["/** Bit numbers. */"]
    lines += _object("FLAGS", {table.name: table.members for table in registry.flags}, "")
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
        row.name: {
            "bit": row.bit,
            "severity": severities[row.severity],
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
