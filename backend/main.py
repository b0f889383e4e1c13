"""The composition root: builds everything from the settings, wires it, serves it, takes it down.

Opening goes in the order of need: the store, which finishes what a crash left; those who listen;
then the units, which begin to talk at once. Closing goes the other way round.
"""

from __future__ import annotations

import contextlib
import logging
import signal
import socket
import threading
import time
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Protocol, TypeVar

from fastapi import FastAPI

from backend import __version__
from backend.app import build_api
from backend.audit.records import AuditReader
from backend.audit.service import Audit
from backend.bikes.records import BikeStore, PairingStore
from backend.bikes.service import Bikes
from backend.calibration.bike.service import BikeNumbers
from backend.calibration.certified_torque import CertifiedTorque
from backend.calibration.clock import JobDates
from backend.calibration.describe import summary_of
from backend.calibration.records import CalibrationStore
from backend.calibration.service import Calibrations, open_calibrations
from backend.calibration.types import JobSummary
from backend.core.audit import Note
from backend.core.ride import Ride
from backend.device.driver import LinkOpener
from backend.device.families import FAMILIES, Families
from backend.device.link import kind_of
from backend.errors import SpindleError, StoreError
from backend.formats import Readers
from backend.imports.mapping import TableMapping
from backend.imports.sample import sample_ride
from backend.imports.service import QUICK_S, Uploads, UploadSettings
from backend.imports.unit_logs import Collect
from backend.listening import AnnouncingServer, listening_socket, server_config
from backend.people.service import PeopleService
from backend.rides.comparison.since_change import RidesSinceChange
from backend.rides.diagnosis.sensor_drift import SensorDriftService
from backend.rides.diagnosis.service import RideZeros
from backend.rides.insight.ledger import EnergyLedger
from backend.rides.insight.table_use import UseOfTable
from backend.rides.logbook.cards import RideCards, RideFigures
from backend.rides.logbook.home import RiderHomeService
from backend.rides.questions import Insight
from backend.rides.recording.fault_moment import FaultMoments, RecentRows
from backend.rides.recording.marks import MarkMoment
from backend.rides.recording.recorder import Recorder
from backend.rides.replay.propose import Proposals
from backend.rides.replay.ride_again import RideAgain
from backend.rides.replay.service import RideReplay
from backend.rides.replay.why_ride import WhyRide
from backend.rides.service import Rides
from backend.rides.settings_in_force import all_through
from backend.server.addresses import ServerAddresses, certificate_names
from backend.server.backup import StoreService
from backend.server.certificate import ServerCertificate, given_certificate, own_certificate
from backend.server.health import HealthCheck
from backend.services import Services
from backend.settings import CHECKOUT, Settings
from backend.store import Store, open_store
from backend.store.audit import AuditLog
from backend.store.schemas import SchemaFiles
from backend.tuning.library.compare import Compare
from backend.tuning.library.records import LibraryStore
from backend.tuning.library.service import Library
from backend.tuning.limit_proof import LimitProofMaker, ProveLimits, ProvenRevisions
from backend.tuning.preview import Preview
from backend.tuning.records import LimitProofStore, RevisionStore
from backend.tuning.service import Tuning
from backend.tuning.trial_values import TrialTuning
from backend.tuning.why import WhySteady
from backend.units.dashboard import Dashboards
from backend.units.inspection import Inspection
from backend.units.last_seen import LastSeen
from backend.units.memory import UnitMemory
from backend.units.records import UnitStore
from backend.units.service import Devices, Watcher
from backend.units.watch import Watch
from backend.visits.records import VisitStore
from backend.visits.service import Visits
from backend.visits.workbench import Workbench
from backend.web.app import WebSettings
from backend.web.safety import AllowedHosts

LOG = logging.getLogger(__name__)
OpenerOf = Callable[[str], LinkOpener]
# How often rides of silent units and expired uploads are looked for.
HOUSEKEEPING_S = 1.0
# Where the pages are: beside the package in a checkout, inside it once installed.
FRONTENDS = (CHECKOUT / "frontend" / "dist", Path(__file__).resolve().parent / "pages")


@contextlib.contextmanager
def open_services(
    settings: Settings, families: Families = FAMILIES, opener: OpenerOf | None = None
) -> Iterator[Services]:
    """Everything behind the API, opened; closed again in the other order, whatever happens.

    opener: how a url becomes a link, if not by `device.link`. Raises StoreError, InvalidRequest.
    """
    check(settings)
    with contextlib.ExitStack() as closing:
        store = closing.enter_context(open_store(settings.db, settings.objects, settings.cache))
        units, cards = UnitStore(store.database), RideCards(store)
        audit = closed_by(closing, AuditLog(store.database))
        last_seen = closing.enter_context(contextlib.closing(LastSeen(units)))
        devices = make_devices(settings, units, last_seen, families, opener, audit.note)
        revisions, proofs = make_revisions(store)
        tuning, inspection = Tuning(devices, revisions), Inspection(devices, audit.note)
        memory = closed_by(closing, UnitMemory(devices, revisions, units, tuning.note_trial_end))
        recorder = Recorder(store.rides, memory.ride_context, unfinished=store.unfinished)
        closing.callback(recorder.close)
        uploads = make_uploads(settings, store, cards.make)
        # Units close first: their last rows still find the recorder.
        closing.callback(devices.close)
        collect = Collect(devices, uploads, settings.data / "collecting", audit.note)
        closing.callback(collect.close)
        # Closes before those who wait for a file to be read.
        closing.callback(uploads.close)
        dashboards, recent, library = Dashboards(), RecentRows(), make_library(store)
        follow(devices, memory.follow, recorder.watch, dashboards.follow, recent.follow)
        closing.enter_context(upkeep(recorder, uploads, store, last_seen, devices, cards, audit))
        open_units(settings, devices)
        people = PeopleService(store.database) if settings.needs_sign_in else None
        yield Services(
            store=StoreService(store, __version__, audit.note),
            health=make_health(devices, recorder, store),
            addresses=make_addresses(settings),
            devices=devices,
            inspection=inspection,
            fault_moments=FaultMoments(store.rides, recent, inspection.faults, memory.ride_context),
            watch=Watch(devices),
            dashboards=dashboards,
            mark=MarkMoment(recorder, store.marks, devices.get),
            tuning=tuning,
            calibrations=make_calibrations(settings, devices, store, tuning),
            bike_numbers=make_bike_numbers(store, memory, tuning),
            trial_values=TrialTuning(devices, note=audit.note),
            preview=Preview(),
            library=library,
            compare=Compare(library, tuning),
            prove_limits=ProveLimits(proofs, devices, tuning, library),
            rides=make_rides(store, memory, devices, recorder),
            home=RiderHomeService(store),
            ride_again=RideAgain(store, memory.ride_config),
            proposals=closed_by(closing, Proposals(store, memory.ride_config, proofs)),
            use_of_table=UseOfTable(store, memory.ride_config, devices.unit_at),
            since_change=RidesSinceChange(store, tuning.revisions),
            sensor_drift=make_drift(store, devices, tuning),
            workbench=make_workbench(store, devices, inspection, tuning),
            why_steady=WhySteady(devices.writable),
            why_ride=WhyRide(store, memory.ride_config),
            ledger=EnergyLedger(store, memory.ride_config),
            insight=Insight(store, memory.ride_config),
            uploads=uploads,
            tables=TableMapping(store, uploads, audit.note),
            sample_ride=partial(sample_ride, store, uploads),
            collect=collect,
            bikes=make_bikes(store, people, units),
            visits=make_visits(store, devices, inspection, tuning),
            audit=Audit(AuditReader(store.database)),
            people=people,
        )


class Closable(Protocol):
    def close(self) -> None: ...


Closed = TypeVar("Closed", bound=Closable)


def closed_by(closing: contextlib.ExitStack, one: Closed) -> Closed:
    """Something that is closed when `closing` is."""
    closing.callback(one.close)
    return one


def make_revisions(store: Store) -> tuple[ProvenRevisions, LimitProofMaker]:
    """Every unit's configurations, each with the proof that it keeps the limits."""
    proofs = LimitProofMaker(LimitProofStore(store.database), __version__)
    return ProvenRevisions(RevisionStore(store.database), proofs), proofs


def make_library(store: Store) -> Library:
    """Tables and configurations that have a name."""
    return Library(LibraryStore(store.database))


def make_health(devices: Devices, recorder: Recorder, store: Store) -> HealthCheck:
    """Status of units, recordings and the store."""
    return HealthCheck(
        __version__,
        devices,
        recorder,
        store.watch,
        store.database.ping,
        store.soundness,
        store.entries,
    )


def make_addresses(settings: Settings) -> ServerAddresses:
    """Where people find the server, and the certificate they find it with.

    Raises InvalidRequest, StoreError.
    """
    hosts = settings.allowed_hosts
    certificate = given(settings)
    if settings.tls == "own":
        names = certificate_names(hosts)
        certificate = own_certificate(settings.data / "tls", names, datetime.now(UTC))
    behind_proxy = bool(settings.proxies)
    return ServerAddresses(settings.host, hosts, behind_proxy, settings.root_path, certificate)


def given(settings: Settings) -> ServerCertificate | None:
    """The certificate that the settings name, if they do. Raises InvalidRequest."""
    if settings.tls != "files" or settings.tls_certificate is None or settings.tls_key is None:
        return None
    return given_certificate(settings.tls_certificate, settings.tls_key, datetime.now(UTC))


def make_devices(
    settings: Settings,
    units: UnitStore,
    last_seen: LastSeen,
    families: Families,
    opener: OpenerOf | None,
    note: Note,
) -> Devices:
    """The units there are; none is opened yet."""
    devices = Devices(
        flash_folder=settings.data / "units",
        opener=opener,
        schemas=SchemaFiles(settings.data / "schemas"),
        bike_of=units.bike_of,
        last_seen=last_seen.at,
        families=families,
        note=note,
    )
    devices.watch(last_seen.follower(devices.get))
    return devices


def follow(devices: Devices, *watchers: Watcher) -> None:
    """Says to each what becomes of every unit."""
    for watcher in watchers:
        devices.watch(watcher)


def open_units(settings: Settings, devices: Devices) -> None:
    """Begins to open the units that the settings name; one that is slow keeps nobody waiting."""
    for url in settings.device:
        in_background(url, partial(devices.add, url))


def make_drift(store: Store, devices: Devices, tuning: Tuning) -> SensorDriftService:
    """What a unit's rides show of its sensor's zero."""
    return SensorDriftService(store, devices.last_known_key, tuning.revisions)


def make_workbench(
    store: Store, devices: Devices, inspection: Inspection, tuning: Tuning
) -> Workbench:
    """What a workshop looks at of a unit."""
    drift = make_drift(store, devices, tuning)
    return Workbench(devices, inspection, tuning, drift, __version__)


def make_visits(store: Store, devices: Devices, inspection: Inspection, tuning: Tuning) -> Visits:
    """Service visits, with what became of the unit meanwhile."""
    workbench = make_workbench(store, devices, inspection, tuning)
    revisions, jobs = RevisionStore(store.database), CalibrationStore(store)

    def calibrations(unit_key: str) -> list[JobSummary]:
        return [summary_of(job) for job in jobs.list(unit_key)]

    return Visits(VisitStore(store), workbench, revisions, calibrations)


def make_calibrations(
    settings: Settings, devices: Devices, store: Store, tuning: Tuning
) -> Calibrations:
    """The calibration of sensors, judged by the house's limits."""
    limits = settings.calibration_limits
    return open_calibrations(devices, CalibrationStore(store), tuning, __version__, limits)


def make_bikes(store: Store, people: PeopleService | None, units: UnitStore) -> Bikes:
    """The register; what it says of units is looked up anew where it changes."""
    return Bikes(BikeStore(store.database), PairingStore(store.database), people, units.moved)


def make_rides(store: Store, memory: UnitMemory, devices: Devices, recorder: Recorder) -> Rides:
    """Rides, recorded and replayed by what their unit was set to."""
    replay = RideReplay(Preview(), memory.ride_config)
    return Rides(store, replay, devices.unit_at, recorder.running)


def make_bike_numbers(store: Store, memory: UnitMemory, tuning: Tuning) -> BikeNumbers:
    """With what a ride's unit was configured as and certified for."""
    certified = CertifiedTorque(CalibrationStore(store), partial(all_through, memory.ride_config))
    return BikeNumbers(store, memory.ride_config, tuning.parameters, certified)


def make_uploads(settings: Settings, store: Store, judge: Callable[[Ride], None]) -> Uploads:
    """What becomes of files: they are read in processes of their own, and their rides judged.

    What a server before did not read is read in the background.
    """
    limit = UploadSettings(length_max=settings.upload_bytes_max)
    readers = Readers()
    quick = partial(readers.read, wall_s=QUICK_S)
    uploads = Uploads(store, limit, quick, readers.read, readers.stop, readers.unpack, judge)
    in_background("uploads", uploads.recover)
    return uploads


def check(settings: Settings) -> None:
    """What must be right before anything is opened. Raises InvalidRequest, StoreError."""
    for url in settings.device:
        kind_of(url)
    given(settings)
    make_data_folder(settings.data)


def make_data_folder(folder: Path) -> None:
    """The folder of everything that is kept. Raises StoreError where it cannot be."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(
            f"The data folder {folder} cannot be made: {error.strerror or error}. Choose another "
            "with --data DIR or SPINDLE_DATA."
        ) from None


def upkeep(
    recorder: Recorder,
    uploads: Uploads,
    store: Store,
    last_seen: LastSeen,
    devices: Devices,
    cards: RideCards,
    audit: AuditLog,
) -> contextlib.AbstractContextManager[None]:
    """What is done beside the server: tidying up, and what is kept of each ride."""
    return every_second(
        recording=partial(tidy_rides, recorder, last_seen, devices),
        housekeeping=partial(tidy_store, uploads, store),
        figures=RideFigures(store).tick,
        cards=cards.tick,
        audit=audit.catch_up,
        zeros=RideZeros(store).tick,
        calibrations=JobDates(CalibrationStore(store)).tick,
    )


def tidy_rides(recorder: Recorder, last_seen: LastSeen, devices: Devices) -> None:
    """Ends what has been silent too long; notes which units are here."""
    now_us = time.time_ns() // 1000
    recorder.tick(now_us)
    last_seen.update(devices.list(), now_us)


def tidy_store(uploads: Uploads, store: Store) -> None:
    """Tries again what the store refused; fills rides that are over; removes what has expired.

    Beside `tidy_rides`, as a bucket that does not answer is waited for.
    """
    now_us = time.time_ns() // 1000
    store.try_again()
    uploads.retry_waiting(now_us)
    store.sweep(now_us)
    store.scrub(now_us)


def in_background(name: str, work: Callable[[], object]) -> None:
    """Does what the server need not wait for; a failure is logged."""

    def run() -> None:
        try:
            work()
        except SpindleError as error:
            LOG.error("%s: %s", name, error.message)

    threading.Thread(target=run, name=name, daemon=True).start()


@contextlib.contextmanager
def every_second(**works: Callable[[], object]) -> Iterator[None]:
    """Does each of `works` once a second, on a thread of its own, until the context ends.

    Whatever one raises is logged, and its thread goes on.
    """
    stopped = threading.Event()

    def run(name: str, work: Callable[[], object]) -> None:
        note = ""
        while not stopped.wait(HOUSEKEEPING_S):
            try:
                work()
                note = ""
            except Exception as error:
                # What lasts need not be said every second.
                if repr(error) != note:
                    fault = None if isinstance(error, SpindleError) else error
                    LOG.warning("%s: %s", name, error, exc_info=fault)
                note = repr(error)

    threads = [
        threading.Thread(target=run, args=one, name=one[0], daemon=True) for one in works.items()
    ]
    for thread in threads:
        thread.start()
    try:
        yield
    finally:
        stopped.set()
        for thread in threads:
            thread.join()


def build_app(settings: Settings, services: Services) -> FastAPI:
    """The application over open services."""
    hosts = AllowedHosts(frozenset(settings.allowed_hosts), any_address=not settings.is_loopback)
    web = WebSettings(
        version=__version__,
        hosts=hosts,
        guarded=settings.auth == "off" or settings.needs_sign_in,
        frontend=next((folder for folder in FRONTENDS if folder.is_dir()), None),
        upload_bytes_max=settings.upload_bytes_max,
        author=settings.author,
        root_path=settings.root_path,
    )
    return build_api(web, services, services.people)


def serve(settings: Settings) -> int:
    """Runs the server until Ctrl-C or SIGTERM; the process's exit code.

    Raises SpindleError with what to do if it cannot start.
    """
    with listening_socket(settings.host, settings.port) as listening:
        return serve_on(listening, settings)


def serve_on(listening: socket.socket, settings: Settings) -> int:
    """Runs the server on a socket that listens already; as `serve`."""
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(name)s: %(message)s")
    # uvicorn hands SIGTERM back once it has stopped; by default that would end the process before
    # rides and units are closed.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        with open_services(settings) as services:
            certificate = services.addresses.certificate
            tls = None if certificate is None else certificate.context()
            config = server_config(build_app(settings, services), settings.proxies, tls)
            # Files that are being read are read at the next start.
            people = services.people
            first_token = None if people is None else people.accounts.first_token()
            server = AnnouncingServer(config, services.uploads.close, first_token, certificate)
            server.run(sockets=[listening])
            return 0 if server.started else 1
    except KeyboardInterrupt:
        return 0
