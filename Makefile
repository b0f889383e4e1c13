# `make help` lists what there is. Everything installs itself: a fresh machine needs Python 3.11,
# Node 20 and a C compiler.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
export PYTHONDONTWRITEBYTECODE = 1

.PHONY: native
native: ## the C extension, rebuilt in place
	$(BIN)/python setup.py -q build_ext --inplace
