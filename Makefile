# Every target sets up what it needs: a private .venv, built once and again only when its sources change.
PYTHON ?= python3
BIN := .venv/bin
WORKSPACE := --manifest-path shared/core/Cargo.toml
SETUP := .venv/.setup-stamp
NUMBA := .venv/.numba-stamp
RUST := $(shell find shared/core \( -name target -o -name tests -o -name examples \) -prune -o \( -name '*.rs' -o -name Cargo.toml \) -print)

help:
	@sed -n 's/^## //p' Makefile

## make setup   the private .venv with everything in it (every other target does this itself)
setup: $(SETUP)

$(SETUP): pyproject.toml MANIFEST.in .ci/setup .ci/python-constraints.txt .ci/build-constraints.txt .ci/cargo-versions.txt $(RUST)
	@bash .ci/setup $(PYTHON) && touch $@

## make demo    a server and two clients, films and a verdict in out/demo
demo: $(SETUP)
	@$(BIN)/kuglice demo

## make test    cargo test (debug build) and pytest
test: $(SETUP)
	cargo test $(WORKSPACE) --workspace --exclude kuglice-python
	$(BIN)/pytest --numprocesses auto --maxprocesses 4 --dist loadfile

## make lint    formatting, types, stubs, docker files: nothing is changed, only judged
lint: $(SETUP)
	@bash .ci/lint

## make bench   what a ball-step, a copy, a server costs, beside peers and targets; bytes on the wire; some minutes
bench: $(SETUP) $(NUMBA)
	@$(BIN)/kuglice bench
	@$(BIN)/kuglice bench wire --seconds 3

# A peer that is too large for everybody, and not there for every new Python: the bench says so and goes on without.
$(NUMBA): $(SETUP)
	@echo "make bench: installing numba, one of the peers" >&2
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint .ci/python-constraints.txt numba || true
	@touch $@

## make instructions  count those of fixed runs and compare with .ci/instructions.csv (RENEW=1: write it anew)
instructions:
	@$(PYTHON) .ci/instructions.py $(if $(RENEW),--renew)

## make memcheck  the unsafe code under valgrind
memcheck: $(SETUP)
	@bash .ci/memcheck

## make chart   all figures of the lab in out/chart, and the table that the planner reads
chart: $(SETUP)
	@$(BIN)/kuglice chart --plan-table shared/kuglice/planner/measured.csv

## make rapier  build Rapier as one more peer of bench and chart
rapier: $(SETUP)
	cargo build --release --quiet --manifest-path shared/kuglice/lab/peers/rapier/Cargo.toml
	cp shared/kuglice/lab/peers/rapier/target/release/lib_rapier.so shared/kuglice/lab/peers/_rapier.abi3.so

## make core    rebuild the compiled module only
core:
	cargo build --release --quiet $(WORKSPACE) -p kuglice-python
	rm -f shared/kuglice/_core.*.so
	cp shared/core/target/release/libkuglice_core.so shared/kuglice/_core.abi3.so

## make golden  new golden hashes; refused unless STEP_VERSION has changed (tests/determinism/mint.py)
golden: $(SETUP)
	$(BIN)/python tests/determinism/mint.py

## make clean   remove everything that make has made
clean:
	rm -rf .venv out build dist shared/core/target shared/kuglice/_core*.so shared/*.egg-info *.egg-info
	find . -name __pycache__ -prune -exec rm -rf {} + ; rm -rf .mypy_cache .ruff_cache .pytest_cache .hypothesis

.PHONY: help setup demo test lint bench instructions memcheck chart rapier core golden clean
