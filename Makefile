# Two commands for a stranger: `make demo` and `make test`. Each sets up what it needs inside this folder.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
RUST_SOURCES := $(shell find core/src sensor/src bindings/src -name '*.rs') Cargo.toml core/Cargo.toml sensor/Cargo.toml bindings/Cargo.toml

.PHONY: setup test check schemas

setup: $(VENV)/.built

$(VENV)/.installed: requirements/dev.lock
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --requirement requirements/dev.lock
	touch $@

$(VENV)/.built: $(VENV)/.installed $(RUST_SOURCES) pyproject.toml
	VIRTUAL_ENV=$(abspath $(VENV)) $(BIN)/maturin develop --release --quiet
	touch $@

test: setup
	cargo test --workspace
	$(BIN)/pytest

check: setup
	cargo fmt --check
	cargo clippy --workspace --all-targets -- -D warnings
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

schemas: setup
	$(BIN)/python -m boxwright.io.schemas docs/schemas
