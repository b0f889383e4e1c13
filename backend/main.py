"""The composition root: builds everything from the settings, wires it, serves it, takes it down.

Opening goes in the order of need: the store, which finishes what a crash left; those who listen;
then the units, which begin to talk at once. Closing goes the other way round.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import signal
import socket
import sys
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import uvicorn
from fastapi import FastAPI

from backend import __version__
from backend.app import build_api
from backend.bikes.records import BikeStore, PairingStore
from backend.bikes.service import Bikes
from backend.calibration.bike.service import BikeNumbers
from backend.calibration.certified_torque import CertifiedTorque
from backend.calibration.clock import JobDates
from backend.calibration.records import CalibrationStore
from backend.calibration.service import Calibrations, open_calibrations
from backend.core.ride import Ride
from backend.device.driver import LinkOpener
from backend.device.families import FAMILIES, Families
from backend.device.link import kind_of
from backend.errors import LinkError, SpindleError, StoreError
from backend.formats import Readers
from backend.imports.mapping import TableMapping
from backend.imports.sample import sample_ride
from backend.imports.service import QUICK_S, Uploads, UploadSettings
from backend.imports.unit_logs import Collect
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
from backend.server.backup import StoreService
from backend.server.health import HealthCheck
from backend.services import Services
from backend.settings import CHECKOUT, Settings
from backend.store import Store, open_store
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
from backend.visits.service import Workbench
from backend.web.app import WebSettings
from backend.web.connections import PatientProtocol
from backend.web.safety import AllowedHosts

LOG = logging.getLogger(__name__)
OpenerOf = Callable[[str], LinkOpener]
# An open WebSocket or a long download must not hold a stopping server back.
SHUTDOWN_S = 2
# Connections that may wait while the store and the units are being opened.
BACKLOG = 128
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
        store = closing.enter_context(open_store(settings.db, settings.objects))
        units, cards = UnitStore(store.database), RideCards(store)
        last_seen = closing.enter_context(contextlib.closing(LastSeen(units)))
        devices = make_devices(settings, units, last_seen, families, opener)
        revisions, proofs = make_revisions(store)
        tuning = Tuning(devices, revisions)
        memory = UnitMemory(devices, revisions, units, tuning.note_trial_end)
        closing.callback(memory.close)
        recorder = Recorder(store.rides, memory.ride_context, unfinished=store.unfinished)
        closing.callback(recorder.close)
        uploads = make_uploads(settings, store, cards.make)
        # Units close first: their last rows still find the recorder.
        closing.callback(devices.close)
        collect = Collect(devices, uploads, settings.data / "collecting")
        closing.callback(collect.close)
        # Closes before those who wait for a file to be read.
        closing.callback(uploads.close)
        dashboards, recent = Dashboards(), RecentRows()
        follow(devices, memory.follow, recorder.watch, dashboards.follow, recent.follow)
        closing.enter_context(upkeep(recorder, uploads, store, last_seen, devices, cards))
        open_units(settings, devices)
        library, inspection = Library(LibraryStore(store.database)), Inspection(devices)
        proposals = Proposals(store, memory.ride_config, proofs)
        closing.callback(proposals.close)
        people = PeopleService(store.database) if settings.needs_sign_in else None
        yield Services(
            store=StoreService(store, __version__),
            health=make_health(devices, recorder, store),
            devices=devices,
            inspection=inspection,
            fault_moments=FaultMoments(store.rides, recent, inspection.faults, memory.ride_context),
            watch=Watch(devices),
            dashboards=dashboards,
            mark=MarkMoment(recorder, store.marks, devices.get),
            tuning=tuning,
            calibrations=make_calibrations(settings, devices, store, tuning),
            bike_numbers=make_bike_numbers(store, memory, tuning),
            trial_values=TrialTuning(devices),
            preview=Preview(),
            library=library,
            compare=Compare(library, tuning),
            prove_limits=ProveLimits(proofs, devices, tuning, library),
            rides=make_rides(store, memory, devices, recorder),
            home=RiderHomeService(store),
            ride_again=RideAgain(store, memory.ride_config),
            proposals=proposals,
            use_of_table=UseOfTable(store, memory.ride_config, devices.unit_at),
            since_change=RidesSinceChange(store, tuning.revisions),
            sensor_drift=make_drift(store, devices, tuning),
            workbench=make_workbench(store, devices, inspection, tuning),
            why_steady=WhySteady(devices.writable),
            why_ride=WhyRide(store, memory.ride_config),
            ledger=EnergyLedger(store, memory.ride_config),
            insight=Insight(store, memory.ride_config),
            uploads=uploads,
            tables=TableMapping(store, uploads),
            sample_ride=partial(sample_ride, store, uploads),
            collect=collect,
            bikes=make_bikes(store, people, units),
            people=people,
        )


def make_revisions(store: Store) -> tuple[ProvenRevisions, LimitProofMaker]:
    """Every unit's configurations, each with the proof that it keeps the limits."""
    proofs = LimitProofMaker(LimitProofStore(store.database), __version__)
    return ProvenRevisions(RevisionStore(store.database), proofs), proofs


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


def make_devices(
    settings: Settings,
    units: UnitStore,
    last_seen: LastSeen,
    families: Families,
    opener: OpenerOf | None,
) -> Devices:
    """The units there are; none is opened yet."""
    devices = Devices(
        flash_folder=settings.data / "units",
        opener=opener,
        schemas=SchemaFiles(settings.data / "schemas"),
        bike_of=units.bike_of,
        last_seen=last_seen.at,
        families=families,
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
) -> contextlib.AbstractContextManager[None]:
    """What is done beside the server: tidying up, and what is kept of each ride."""
    return every_second(
        housekeeping=partial(tidy, recorder, uploads, store, last_seen, devices),
        figures=RideFigures(store).tick,
        cards=cards.tick,
        zeros=RideZeros(store).tick,
        calibrations=JobDates(CalibrationStore(store)).tick,
    )


def tidy(
    recorder: Recorder,
    uploads: Uploads,
    store: Store,
    last_seen: LastSeen,
    devices: Devices,
) -> None:
    """Ends what has been silent too long; fills rides that are over; removes what has expired."""
    now_us = time.time_ns() // 1000
    store.try_again()
    recorder.tick(now_us)
    uploads.retry_waiting()
    store.sweep(now_us)
    store.scrub(now_us)
    last_seen.update(devices.list(), now_us)


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


def listening_socket(host: str, port: int) -> socket.socket:
    """A socket on the address, before anything else is opened. Raises LinkError if it is taken."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, backlog=BACKLOG)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise LinkError(
            f"{host} port {port} cannot be listened on: {reason}. Stop what uses "
            "it, or choose another with --port (0 takes a free one)."
        ) from None


class AnnouncingServer(uvicorn.Server):
    """Prints one line with the address, and only once requests are really answered.

    end_waiting: lets go of requests that would wait for longer than the server takes to end.
    first_token: of the link for the first administrator; None where none is needed.
    """

    def __init__(
        self,
        config: uvicorn.Config,
        end_waiting: Callable[[], None],
        first_token: str | None = None,
    ) -> None:
        super().__init__(config)
        self._end_waiting = end_waiting
        self._first_token = first_token

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Starts to listen, then says where."""
        await super().startup(sockets)
        if self.started and sockets:
            host, port = sockets[0].getsockname()[:2]
            shown = f"[{host}]" if ":" in host else host
            sys.stdout.write(f"Spindle is ready at http://{shown}:{port} (Ctrl-C stops it)\n")
            if self._first_token is not None:
                sys.stdout.write(first_link(host, port, self._first_token))
            sys.stdout.flush()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stops to listen, answers who waits, ends."""
        ending = asyncio.create_task(asyncio.to_thread(self._end_waiting))
        await super().shutdown(sockets)
        await ending


def first_link(host: str, port: int, token: str) -> str:
    """What is printed while there is no administrator.

    The token stands behind the `#`: a browser sends it to nobody, and no log of requests has it.
    """
    anywhere = host in ("0.0.0.0", "::")
    shown = "localhost" if anywhere else f"[{host}]" if ":" in host else host
    return (
        "There is no administrator yet. Whoever opens this link first becomes one (it works once, "
        f"until the next start):\n  http://{shown}:{port}/sign-in#first={token}\n"
    )


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
            config = server_config(build_app(settings, services), settings.proxies)
            # Files that are being read are read at the next start.
            people = services.people
            first_token = None if people is None else people.accounts.first_token()
            server = AnnouncingServer(config, services.uploads.close, first_token)
            server.run(sockets=[listening])
            return 0 if server.started else 1
    except KeyboardInterrupt:
        return 0


def server_config(app: FastAPI, proxies: tuple[str, ...] = ()) -> uvicorn.Config:
    """How uvicorn runs the application.

    proxies: addresses and networks that are believed whom they pass on; nobody else is.
    """
    return uvicorn.Config(
        app,
        log_level="warning",
        lifespan="off",
        proxy_headers=bool(proxies),
        forwarded_allow_ips=",".join(proxies),
        http=PatientProtocol,
        # Compressing 20 small frames a second costs more than it saves on loopback.
        ws_per_message_deflate=False,
        # Browsers send nothing larger; whatever does is not a browser.
        ws_max_size=64 * 1024,
        server_header=False,
        timeout_graceful_shutdown=SHUTDOWN_S,
    )
