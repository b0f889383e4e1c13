# `make help` lists what there is. Everything installs itself; a fresh machine needs Python 3.11,
# Node 20 and a C compiler.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := .make

# Tests of a file share what it builds and stay together; a browser computes: two at once.
WORKERS ?= 3
PARALLEL := --dist loadfile --no-loadscope-reorder -n
# Two recipes side by side, the output of each in one piece where this make can do so.
SIDE_BY_SIDE := --no-print-directory -j2 $(if $(filter output-sync,$(.FEATURES)),--output-sync=target)

# How long a long target took is its last line.
BEGIN = @mkdir -p $(STAMP); date +%s > $(STAMP)/began-$@
END = @seconds=$$(($$(date +%s) - $$(cat $(STAMP)/began-$@))); \
	echo "make $@ took $$((seconds / 60)) min $$((seconds % 60)) s"

define BOARD_READY
$(BEGIN)
@.ci/ensure-tools $(BOARD_TOOLS)
@$(MAKE) $(SIDE_BY_SIDE) setup
endef

BOARD_TOOLS = board
test-board test-board-all: BOARD_TOOLS = board wireshark

# What runs against the emulated board; `make test-board-all` adds what takes minutes there.
BOARD_SMOKE := tests/board tests/conformance tests/unit/sim_device_app
BOARD_TESTS := tests/board tests/conformance tests/unit/sim_device_app tests/stories

C_SOURCES := $(wildcard firmware_protocol/c/*.[ch] sim_device/firmware/*/*.[ch] \
	sim_device/firmware/app/*/*.[ch] sim_device/firmware/boards/host/*.[ch] sim_device/physics/*.[ch] sim_device/twin/*.[ch] third_party/*/*.[ch])
WEB_SOURCES := $(shell find frontend -type f -not -path '*/node_modules/*' -not -path '*/dist/*')

# Tests start many processes, which would otherwise compile our Python anew each time.
test prove test-fast test-board test-board-smoke test-board-all: export PYTHONDONTWRITEBYTECODE =

.PHONY: help
help: ## what can be made
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 18

.PHONY: run
run: setup ## start Spindle with one simulated drive unit; Ctrl-C stops all of it
	@exec $(BIN)/spindle serve

.PHONY: dev
dev: $(STAMP)/native $(STAMP)/web-modules ## both halves with live reload, on ports that it prints; Ctrl-C stops all
	@exec $(BIN)/python -m backend.dev

.PHONY: sim
sim: setup ## a simulated drive unit alone, on tcp port 7500
	@exec $(BIN)/spindle sim --tcp 7500

.PHONY: setup
setup: $(STAMP)/native $(STAMP)/web ## install and build everything, start nothing

.PHONY: test
test: ## every test but the longest, a real browser included
	$(BEGIN)
	@.ci/check-machine $(PYTHON)
	@.ci/ensure-tools browser database proxy curl
	@$(MAKE) $(SIDE_BY_SIDE) setup lint test-web
	$(BIN)/pytest -m "not long" $(PARALLEL) $(WORKERS) --ignore=tests/browser --ignore=tests/board
	$(BIN)/pytest -m "not long" $(PARALLEL) 2 tests/browser
	$(END)

.PHONY: prove
prove: ## what takes longest, and the large counts of which `make test` does a part, in full
	$(BEGIN)
	@.ci/ensure-tools browser fuzzing database proxy curl wireshark
	@$(MAKE) $(SIDE_BY_SIDE) setup
	$(BIN)/pytest --prove -m "large_count or long" $(PARALLEL) $(WORKERS) --ignore=tests/board
	$(END)

.PHONY: test-board-smoke
test-board-smoke: ## a minute of test-board: image, wire, law and product
	$(BOARD_READY)
	$(BIN)/pytest --unit=qemu -m "not board_long and not long" $(BOARD_SMOKE)
	$(END)

.PHONY: test-board
test-board: ## the unit's tests against the firmware on an emulated Cortex-M4F
	$(BOARD_READY)
	$(BIN)/pytest --unit=qemu -m "not board_long" $(BOARD_TESTS)
	$(END)

.PHONY: test-board-all
test-board-all: ## the same with the longest: power cuts at every byte, ten thousand guesses
	$(BOARD_READY)
	$(BIN)/pytest --unit=qemu --prove $(BOARD_TESTS)
	$(END)

.PHONY: test-web
test-web: $(STAMP)/web ## the tests of the pages' logic
	cd frontend && npm run --silent test

.PHONY: test-fast
test-fast: $(STAMP)/native ## unit and conformance tests without the slow ones; ONLY=path for some
	$(BIN)/pytest -m "not slow and not large_count and not long" $(PARALLEL) 2 \
		$(or $(ONLY),tests/unit tests/conformance)

.PHONY: simulate
simulate: $(STAMP)/native ## the story of one seed of the simulated link: make simulate SEED=123
	$(BIN)/python -m tests.simulation $(or $(SEED),1) $(SEEDS)

.PHONY: fuzz
fuzz: $(STAMP)/native ## every fuzzer for SECONDS each, 60 unless told; C needs clang (libFuzzer)
	@.ci/ensure-tools fuzzing
	$(BIN)/python -m tools.fuzz $(or $(SECONDS),60)

.PHONY: mutate
mutate: $(STAMP)/native ## break the codec and the transaction in every known way; a test must notice
	$(BIN)/python -m tools.mutation

.PHONY: lint lint-python lint-c lint-web
lint: lint-python lint-c lint-web ## all static checks, Python, C and browser

lint-python: $(STAMP)/native
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

lint-c: $(STAMP)/python
	.ci/lint-c

lint-web: $(STAMP)/web-modules
	cd frontend && npm run --silent lint && npm run --silent check

.PHONY: fix
fix: $(STAMP)/python ## format, and mend what the linters can
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	.ci/lint-c --fix

.PHONY: gen
gen: $(STAMP)/python $(STAMP)/web-modules ## regenerate everything that comes from the registry and the API
	$(BIN)/python -m firmware_protocol.generate
	@$(MAKE) --no-print-directory $(STAMP)/native
	cd frontend && npm run --silent gen

.PHONY: bench
bench: setup $(STAMP)/rivals ## ratios against named rivals in one run, into docs/benchmarks.md
	$(BIN)/python -m tools.bench

.PHONY: reproduction
reproduction: $(STAMP)/native ## the thesis beside what the simulator does, tables and filters measured, into docs/
	$(BIN)/python -m tools.reproduction
	$(BIN)/python -m tools.reproduction.tables
	$(BIN)/python -m tools.reproduction.filters
	$(BIN)/python -m tools.reproduction.current_control

.PHONY: release-data
release-data: setup ## what a version leaves on a disk, kept for every later one to open: VERSION=0.6.0
	$(BIN)/python -m tests.releases.make $(VERSION) $(CODE)

.PHONY: lock
lock: $(STAMP)/python ## pin versions and hashes again, without registry addresses
	$(BIN)/uv pip compile -q pyproject.toml --universal --generate-hashes --no-emit-index-url \
		--no-header --all-extras -o requirements.lock
	$(BIN)/uv pip compile -q build.in --universal --generate-hashes --no-emit-index-url \
		--no-header -o build.lock
	$(BIN)/uv pip compile -q tools/bench/rivals.in --universal --generate-hashes \
		--no-emit-index-url --no-header -o tools/bench/rivals.lock

.PHONY: advisories
advisories: $(STAMP)/python ## known flaws of what the lock files name, where the registries answer
	$(BIN)/uv tool run pip-audit --strict --disable-pip --require-hashes -r requirements.lock -r build.lock
	cd frontend && npm audit

.PHONY: native
native: $(STAMP)/python ## the C extension, rebuilt in place
	$(BIN)/uv pip install -q --no-build-isolation --no-deps -e .
	@touch $(STAMP)/native

.PHONY: clean
clean: ## everything built or installed here; rides in data/ stay
	rm -rf $(VENV) $(STAMP) build *.egg-info frontend/node_modules frontend/dist test-results
	find sim_device -name '*.so' -delete

.PHONY: ci
ci: ## what a delivery is checked with
	.ci/run

# ---------------------------------------------------------------- steps behind the targets above

# uv is taken from the lock as well: one pip call, then everything else in seconds.
$(STAMP)/python: requirements.lock build.lock pyproject.toml setup.py
	@mkdir -p $(STAMP)
	@.ci/check-machine $(PYTHON)
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/pip install -q --disable-pip-version-check --require-hashes --no-deps -r build.lock
	$(BIN)/uv pip sync -q --compile-bytecode --require-hashes requirements.lock build.lock
	@touch $@

$(STAMP)/native: $(STAMP)/python $(C_SOURCES) sim_device/firmware/python/build.py
	$(BIN)/uv pip install -q --no-build-isolation --no-deps -e .
	@touch $@

$(STAMP)/web-modules: frontend/package-lock.json
	@mkdir -p $(STAMP)
	cd frontend && npm ci --no-audit --no-fund --loglevel=error
	@touch $@

$(STAMP)/web: $(STAMP)/web-modules $(WEB_SOURCES)
	cd frontend && npm run --silent build
	@touch $@

$(STAMP)/rivals: tools/bench/rivals.lock $(STAMP)/python
	$(BIN)/uv venv -q --clear $(STAMP)/rivals-venv
	$(BIN)/uv pip sync -q --python $(STAMP)/rivals-venv/bin/python --require-hashes tools/bench/rivals.lock
	@touch $@
