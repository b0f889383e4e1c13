"""The configuration of a unit: read, change in one transaction, and who changed what."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends, Header, Query, Request, Response
from fastapi.exceptions import RequestValidationError
from pydantic import ValidationError

from backend.core.parameter_value import TOKEN, TOKEN_PATTERN
from backend.tuning.models.config import (
    CONFIRM_S,
    CONFIRM_S_MAX,
    ConfigPatch,
    ParameterList,
    RevisionList,
    TrialValuesRequest,
)
from backend.tuning.models.law import (
    AssistModes,
    Calibration,
    FuzzyTable,
    LawModel,
    Table,
    UnitLimits,
)
from backend.tuning.models.why import Why, WhyRequest
from backend.tuning.service import Tuning
from backend.tuning.trial_values import TrialTuning
from backend.tuning.types import Config, ConfigChange, LastKnown, TrialValues, etag
from backend.tuning.why import WhySteady
from backend.units.precondition import FOR_ONE_UNIT
from backend.web.authentication import Author
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(
    prefix="/devices/{device_id}",
    tags=["configuration"],
    dependencies=FOR_ONE_UNIT,
    responses=refusals(403, 404, 409, 412, 503, 504),
)
TheTrialTuning = Annotated[TrialTuning, provided("trial_values")]
TheTuning = Annotated[Tuning, provided("tuning")]
TheWhySteady = Annotated[WhySteady, provided("why_steady")]
IfMatch = Annotated[
    str | None,
    Header(
        description="The ETag of the configuration the change was made for, several, or `*`.",
        max_length=400,
    ),
]
Reason = Annotated[
    str, Query(max_length=400, description="Why; kept with the revision for later readers.")
]
WhichTable = Annotated[
    Table,
    Query(description="Which of the unit's two tables; a mode names the one it uses so, too."),
]
ConfirmS = Annotated[int, Query(ge=0, le=CONFIRM_S_MAX, description=CONFIRM_S)]
Token = Annotated[str | None, Query(pattern=TOKEN_PATTERN, description=TOKEN)]
Part = Literal["fuzzy_table", "assist_modes", "calibration", "limits"]
AnyPart = FuzzyTable | AssistModes | Calibration | UnitLimits
PARTS: dict[Part, type[LawModel]] = {
    "fuzzy_table": FuzzyTable,
    "assist_modes": AssistModes,
    "calibration": Calibration,
    "limits": UnitLimits,
}
PART_IN_BODY = {
    "requestBody": {
        "required": True,
        "content": {
            "application/json": {
                "schema": {
                    "anyOf": [
                        {"$ref": f"#/components/schemas/{kind.__name__}"} for kind in PARTS.values()
                    ]
                }
            }
        },
    }
}
Bank = Annotated[
    Literal["active", "previous", "default"],
    Query(description="Of the unit: what is in force, what was before, what its firmware brings."),
]


def place_of(part: Part, table: Table) -> str:
    """What the service calls a part; the second table is one of its own."""
    return "second_fuzzy_table" if (part, table) == ("fuzzy_table", "second") else part


async def part_in_body(part: Part, request: Request) -> LawModel:
    """The body as the part it is for. Raises RequestValidationError with its fields."""
    try:
        return PARTS[part].model_validate_json(await request.body())
    except ValidationError as wrong:
        faults = [{**one, "loc": ("body", *one["loc"])} for one in wrong.errors()]
        raise RequestValidationError(faults) from None


@router.get("/parameters", operation_id="list_parameters", response_model=ParameterList)
def list_parameters(device_id: str, tuning: TheTuning) -> dict[str, Any]:
    """Every parameter with its bounds, its meaning and its value in the unit now."""
    return {"items": tuning.parameters(device_id)}


@router.get("/config", operation_id="get_config", response_model=Config)
def get_config(device_id: str, tuning: TheTuning, response: Response, bank: Bank = "active") -> Any:
    """The whole configuration, read from the unit; 404 where it never had a previous one."""
    config = tuning.read_config(device_id, bank)
    if bank == "active":
        response.headers["etag"] = etag(config.unit_key, config.generation, config.crc32)
    return config


@router.get("/last-known", operation_id="get_last_known", response_model=LastKnown)
def get_last_known(device_id: str, tuning: TheTuning) -> Any:
    """What the unit was last known to be set to, connected or not, over a restart too.

    For reading: what is written goes to a connected unit only. What was on trial is left out. 404
    `never_read` where no configuration is kept.
    """
    return tuning.last_known(device_id)


@router.patch("/config", operation_id="patch_config", response_model=ConfigChange)
def patch_config(
    device_id: str,
    body: ConfigPatch,
    tuning: TheTuning,
    response: Response,
    author: Author,
    if_match: IfMatch = None,
) -> Any:
    """Writes all the named parameters or none, reads them back and compares field by field."""
    change = tuning.write_config(
        device_id,
        body.parameters,
        body.reason,
        if_match,
        body.confirm_s,
        author,
        body.token,
        read_from=body.read_from,
    )
    response.headers["etag"] = etag(change.unit_key, change.generation, change.crc32)
    return change


@router.post("/config/confirm", operation_id="confirm_config", response_model=ConfigChange)
def confirm_config(device_id: str, tuning: TheTuning, response: Response, author: Author) -> Any:
    """Keeps the change on trial, once it was read back and compared field by field."""
    return _stamped(tuning.confirm_config(device_id, author), response)


@router.post("/config/rollback", operation_id="rollback_config", response_model=ConfigChange)
def rollback_config(device_id: str, tuning: TheTuning, response: Response, author: Author) -> Any:
    """Gives up the change on trial: the unit has what it had before."""
    return _stamped(tuning.rollback_config(device_id, author), response)


@router.get("/config/revisions", operation_id="list_revisions", response_model=RevisionList)
def list_revisions(device_id: str, tuning: TheTuning) -> dict[str, Any]:
    """Who changed what, when and why, newest first."""
    return {"items": tuning.revisions(device_id)}


@router.post("/why", operation_id="why_of_device", response_model=Why)
def why_of_device(device_id: str, body: WhyRequest, why: TheWhySteady) -> Any:
    """Why this unit would give what it gives in a steady state, with what it is set to now."""
    return why(*body.parts(), device_id)


@router.get("/trial-values", operation_id="get_trial_values", response_model=TrialValues)
def get_trial_values(device_id: str, trial: TheTrialTuning) -> Any:
    """What is on trial in the unit's memory now, and until when."""
    return trial.read(device_id)


@router.post("/trial-values", operation_id="set_trial_values", response_model=TrialValues)
def set_trial_values(device_id: str, body: TrialValuesRequest, trial: TheTrialTuning) -> Any:
    """Puts values on trial at once, standing or moving; a restart, a commit or the time ends it."""
    return trial.set(device_id, body.parameters, body.ttl_s)


@router.delete("/trial-values", operation_id="end_trial_values", response_model=TrialValues)
def end_trial_values(device_id: str, trial: TheTrialTuning) -> Any:
    """Ends what is on trial: the law runs on the configuration again."""
    return trial.end(device_id)


@router.get("/parts/{part}", operation_id="get_part", response_model=AnyPart)
def get_part(
    device_id: str,
    part: Part,
    tuning: TheTuning,
    response: Response,
    table: WhichTable = "first",
) -> Any:
    """A part of the configuration in the shape people edit.

    `fuzzy_table`: a rule table and its points, as the surface and the linter take them.
    `assist_modes`: the five slots of the rider's switch. `calibration`: how raw counts become
    newton metres. `limits`: what the unit enforces whatever the table says, and where assist ends
    because of it.
    """
    return _tagged(tuning.read_part(device_id, place_of(part, table)), response)


@router.put(
    "/parts/{part}",
    operation_id="put_part",
    response_model=ConfigChange,
    openapi_extra=PART_IN_BODY,
)
def put_part(
    device_id: str,
    part: Part,
    body: Annotated[LawModel, Depends(part_in_body)],
    tuning: TheTuning,
    response: Response,
    author: Author,
    if_match: IfMatch = None,
    reason: Reason = "",
    confirm_s: ConfirmS = 0,
    table: WhichTable = "first",
    token: Token = None,
) -> Any:
    """Writes a whole part in one transaction; the unit refuses what its market forbids.

    Both tables share the points of speed and torque rate: those of the second are not changed here.
    """
    written = body.model_dump(exclude_unset=part == "calibration", exclude_none=part == "limits")
    change = tuning.write_part(
        device_id, place_of(part, table), written, reason, if_match, confirm_s, token, author
    )
    return _stamped(change, response)


def _tagged(view: Any, response: Response) -> Any:
    response.headers["etag"] = etag(view.unit_key, view.generation, view.crc32)
    return view.value


def _stamped(change: Any, response: Response) -> Any:
    response.headers["etag"] = etag(change.unit_key, change.generation, change.crc32)
    return change
