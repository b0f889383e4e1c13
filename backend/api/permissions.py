"""Who may ask for what: the one table, and the one place where it is held against who asks.

Every operation of the API is in it, by its `operation_id`; a WebSocket and a page for people by the
name of its function. What is not in the table is refused, to everybody and on every server.
"""

from __future__ import annotations

from enum import StrEnum

from fastapi.requests import HTTPConnection

from backend.domain.people.permission import Permission
from backend.domain.people.person import Caller
from backend.errors import NotAllowed, NotSignedIn

SIGN_IN_FIRST = (
    "This server asks who you are: sign in at /sign-in, or send a key as `Authorization: Bearer "
    "sp_...` (the command takes it from SPINDLE_KEY or --key)."
)


class Anyone(StrEnum):
    """What needs no permission. STRANGER: not even an account. SIGNED_IN: any account or key."""

    STRANGER = "stranger"
    SIGNED_IN = "signed_in"


P = Permission
OPERATIONS: dict[Permission | Anyone, str] = {
    Anyone.STRANGER: "get_not_built get_healthz get_readyz get_session sign_in make_first_person",
    Anyone.SIGNED_IN: "sign_out change_own_password give_ticket get_description get_docs",
    P.COMPUTE: "compute_surface compute_points compute_torque_surface compute_mode_curves "
    "lint_table why_steady evaluate_calibration read_fis list_scenarios",
    P.SEE_SERVER: "get_health get_store list_ports",
    P.BACK_UP: "get_backup",
    P.MANAGE_PEOPLE: "list_people add_person change_person list_keys add_key revoke_key",
    P.SEE_BIKES: "list_devices get_device get_snapshot get_service get_dashboard list_faults "
    "moment_of_fault get_simulation list_logs get_log_download list_parameters get_config "
    "get_last_known list_revisions since_revision why_of_device get_live get_fuzzy_table "
    "get_assist_modes get_calibration get_limits list_calibrations get_calibration_job "
    "get_calibration_reading get_calibration_certificate get_calibration_certificate_pdf "
    "sensor_drift certify live",
    P.CHANGE_BIKES: "add_device remove_device clear_faults mark_moment erase_log "
    "start_log_download patch_config confirm_config rollback_config set_live end_live "
    "put_fuzzy_table put_assist_modes put_limits",
    P.CALIBRATE: "put_calibration open_calibration set_up_calibration capture strike_capture "
    "fit_calibration write_calibration verify_calibration restore_calibration "
    "close_calibration roll_out_wheel track_wheel count_wheel_pulses check_cadence "
    "check_by_climb",
    P.SIMULATE: "put_simulation advance_simulation",
    P.SEE_LIBRARY: "list_library compare get_library_entry export_library_entry "
    "get_library_feel list_library_versions",
    P.CHANGE_LIBRARY: "add_library_item change_library_item remove_library_item",
    P.SEE_RIDES: "rider_home export_rides compare_rides compare_ride_series "
    "compare_ride_crank energy_of_ride effort_of_ride pedalling_of_ride diagnosis_of_ride "
    "report_of_ride list_rides get_ride get_ride_series get_ride_track get_ride_figure "
    "export_ride replay_ride ride_again why_of_ride cuts_of_ride ledger_of_ride table_use "
    "propose get_proposal cancel_proposal list_tables list_uploads",
    P.CHANGE_RIDES: "tag_rides delete_rides patch_ride delete_ride delete_upload "
    "forget_table sample_ride",
    P.UPLOAD: "import_ride describe_uploads create_upload "
    "get_upload_offset append_upload get_upload get_mapping put_mapping",
}
NEEDED = {one: needed for needed, operations in OPERATIONS.items() for one in operations.split()}


def operation_of(connection: HTTPConnection) -> str:
    """The name of what is asked for, as the table has it."""
    route = connection.scope["route"]
    return getattr(route, "operation_id", None) or str(route.name)


def caller_of(connection: HTTPConnection) -> Caller | None:
    """Who asks, as the door found out; None where nobody is known."""
    caller: Caller | None = connection.scope.get("state", {}).get("caller")
    return caller


async def require_permission(connection: HTTPConnection) -> None:
    """A dependency of every route; without waiting, so that no request takes a thread for it.

    Raises NotSignedIn and NotAllowed where accounts are required, NotAllowed everywhere for what
    the table does not have.
    """
    operation = operation_of(connection)
    needed = NEEDED.get(operation)
    if needed is None:
        raise NotAllowed(f"{operation} is in no role.", "not_in_the_table")
    if connection.app.state.people is None or needed is Anyone.STRANGER:
        return
    caller = caller_of(connection)
    if caller is None:
        raise NotSignedIn(SIGN_IN_FIRST)
    if needed is not Anyone.SIGNED_IN and needed not in caller.permissions:
        raise NotAllowed(f"This needs the permission `{needed}`, which you do not have.")
