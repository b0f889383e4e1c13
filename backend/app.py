"""The API: every route, and the permission each needs.

`python -m backend.app` prints its OpenAPI description; it starts and opens nothing.
"""

from __future__ import annotations

import json
import sys

from fastapi import FastAPI

from backend import __version__
from backend.audit import api as audit
from backend.bikes import api as bikes
from backend.calibration import api as calibrations
from backend.calibration.bike import api as bike_numbers
from backend.core.person import Permission
from backend.imports import api as uploads
from backend.imports import logs_api as logs
from backend.imports import tables_api as tables
from backend.people.api import router as people_router
from backend.people.passkeys import api as passkeys
from backend.people.service import PeopleService
from backend.rides import api as rides
from backend.rides.comparison import api as comparison
from backend.rides.diagnosis import api as sensor_drift
from backend.rides.insight import api as insight
from backend.rides.logbook import api as logbook
from backend.rides.recording import api as moments
from backend.rides.replay import api as proposals
from backend.server import api as server
from backend.services import Services
from backend.tuning import api as config
from backend.tuning import law_api as law
from backend.tuning.library import api as library
from backend.units import api as devices
from backend.units import live
from backend.visits import api as workbench
from backend.visits import visits_api as visits
from backend.web.app import Operations, WebSettings, create_app
from backend.web.permissions import Anyone, Own

P = Permission
OPERATIONS: dict[Permission | Anyone, str] = {
    Anyone.STRANGER: "get_not_built get_healthz get_readyz get_session sign_in make_first_person "
    "get_pairing join_by_pairing begin_passkey_sign_in sign_in_with_passkey",
    Anyone.SIGNED_IN: "sign_out change_own_password give_ticket list_keys add_key revoke_key "
    "take_pairing get_addresses get_description get_docs list_passkeys begin_passkey add_passkey "
    "remove_passkey",
    P.COMPUTE: "compute_surface compute_points compute_torque_surface compute_mode_curves "
    "lint_table why_steady evaluate_calibration read_fis list_scenarios",
    P.SEE_REGISTER: "list_bikes get_bike list_visits get_visit get_visit_photo get_bike_history",
    P.CHANGE_REGISTER: "add_bike change_bike remove_bike give_rides pair_bike leave_bike "
    "open_visit change_visit look_at_unit close_visit remove_visit consent_to_visit "
    "add_visit_photo remove_visit_photo add_bike_history",
    P.SEE_SERVER: "get_health get_store list_ports",
    P.SEE_AUDIT: "list_audit export_audit",
    P.BACK_UP: "get_backup",
    P.MANAGE_PEOPLE: "list_people add_person change_person remove_person",
    P.SEE_BIKES: "list_devices get_device get_snapshot get_service get_dashboard list_faults "
    "check_unit get_support_file moment_of_fault get_simulation list_logs get_log_download "
    "list_parameters get_config get_last_known list_revisions since_revision why_of_device "
    "get_trial_values get_part list_calibrations get_calibration_job get_calibration_reading "
    "get_calibration_certificate get_calibration_certificate_pdf sensor_drift prove_limits live",
    P.CHANGE_BIKES: "add_device remove_device clear_faults mark_moment erase_log "
    "start_log_download patch_config confirm_config rollback_config set_trial_values "
    "end_trial_values put_part",
    P.CALIBRATE: "open_calibration set_up_calibration capture strike_capture "
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
    "propose get_proposal cancel_proposal list_tables get_mapping",
    P.CHANGE_RIDES: "tag_rides delete_rides patch_ride delete_ride delete_upload "
    "forget_table sample_ride put_mapping",
    P.UPLOAD_FILES: "import_ride describe_uploads create_upload "
    "get_upload_offset append_upload get_upload list_uploads",
}
NEEDED = {one: needed for needed, operations in OPERATIONS.items() for one in operations.split()}

# What those may who have only their own; everything else that is not for anybody is the workshop's.
OWN_OPERATIONS = {
    Own.ADDRESSED: "get_bike change_bike pair_bike leave_bike list_visits get_visit "
    "get_visit_photo get_bike_history consent_to_visit energy_of_ride effort_of_ride "
    "pedalling_of_ride diagnosis_of_ride report_of_ride get_ride get_ride_series get_ride_track "
    "get_ride_figure export_ride replay_ride ride_again why_of_ride cuts_of_ride ledger_of_ride "
    "patch_ride delete_ride get_upload_offset append_upload get_upload delete_upload get_mapping "
    "put_mapping",
    Own.NARROWED: "list_bikes list_rides rider_home export_rides compare_rides "
    "compare_ride_series compare_ride_crank tag_rides delete_rides sample_ride list_uploads "
    "import_ride describe_uploads create_upload",
}
OWN = {one: kept for kept, operations in OWN_OPERATIONS.items() for one in operations.split()}


# What the table calls a stranger's, by its path; a test compares them.
STRANGERS = frozenset(
    {
        ("GET", "/healthz"),
        ("GET", "/readyz"),
        ("GET", "/api/v1/session"),
        ("POST", "/api/v1/sign-in"),
        ("POST", "/api/v1/sign-in/passkey"),
        ("POST", "/api/v1/sign-in/passkey/challenges"),
        ("POST", "/api/v1/first-person"),
        ("GET", "/api/v1/pairings/{code}"),
        ("POST", "/api/v1/pairings/{code}/account"),
    }
)

OF_UNITS = (devices, moments, logs, config, calibrations, bike_numbers, sensor_drift)
# Before the rides: what several rides come to is at no ride's number.
OF_RIDES = (logbook, comparison, insight, rides, proposals)
ROUTERS = [
    server.router,
    people_router,
    passkeys.router,
    audit.router,
    bikes.router,
    workbench.router,
    visits.router,
    calibrations.figures,
    comparison.of_units,
    *(part.router for part in (*OF_UNITS, law, library, *OF_RIDES, uploads, tables, live)),
]


def build_api(
    settings: WebSettings, services: Services | None = None, people: PeopleService | None = None
) -> FastAPI:
    """The application over open services; without any it can only describe itself.

    people: who may sign in; None where nobody is asked to.
    """
    operations = Operations(ROUTERS, server.probes, NEEDED, STRANGERS, OWN)
    return create_app(settings, operations, services, people, getattr(services, "bikes", None))


def main() -> None:
    """Writes the description to standard output, sorted as the application gives it."""
    description = build_api(WebSettings(version=__version__)).openapi()
    json.dump(description, sys.stdout, indent=1, ensure_ascii=False)
    sys.stdout.write("\n")


if __name__ == "__main__":
    main()
