# Two commands for a stranger: `make demo` and `make test`. Each sets up what it needs inside this folder.
# Needs a C compiler, cargo (Rust 1.89 or newer) and Python 3.11 or newer; `make help` lists the targets.
PYTHON ?= python3
SECONDS ?= 60

VENV := .venv
BIN := $(VENV)/bin
DIST_VENV := target/dist-venv
RUST_SOURCES := $(shell find core/src sensor/src bindings/src -name '*.rs') \
	Cargo.toml Cargo.lock core/Cargo.toml sensor/Cargo.toml bindings/Cargo.toml
# A reader that takes 5 s or 128 MB in one piece for a fuzzer's few kilobytes has a fault.
FUZZ_TARGETS = $(basename $(notdir $(wildcard core/fuzz/fuzz_targets/*.rs)))

# A failure left of a pipe is a failure.
SHELL := bash
.SHELLFLAGS := -eu -o pipefail -c

.PHONY: help tools setup demo test check bench dist fuzz weights weights-of weights-exact weights-fitted evaluate experiments lock schemas

help: ## This list
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*##/\t/' | expand -t 12

tools:
	@command -v cargo >/dev/null || { echo "make: cargo is missing; install Rust 1.89 or newer (https://rustup.rs)" >&2; exit 1; }
	@command -v cc >/dev/null || { echo "make: a C compiler (cc) is missing; on Debian: apt-get install build-essential" >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
	{ echo "make: $(PYTHON) is not Python 3.11 or newer; name one that is: make PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip' 2>/dev/null || \
	{ echo "make: $(PYTHON) cannot make virtual environments; on Debian: apt-get install python3-venv" >&2; exit 1; }

setup: $(VENV)/.built ## Make .venv with the locked tools, and build the core into it

$(VENV)/.installed: requirements/dev.lock | tools
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --requirement requirements/dev.lock
	@touch $@

$(VENV)/.built: $(VENV)/.installed $(RUST_SOURCES) pyproject.toml | tools
	VIRTUAL_ENV=$(abspath $(VENV)) $(BIN)/maturin develop --release --quiet
	@touch $@

demo: setup ## Make a frame, infer its boxes, write everything to out/demo
	$(BIN)/boxwright demo -o out/demo

test: setup ## All tests, Rust and Python, and how many they were
	@mkdir -p target
	cargo test --workspace 2>&1 | tee target/test-rust.log
	$(BIN)/pytest 2>&1 | tee target/test-python.log
	@awk '/^test result:/ { passed += $$4; failed += $$6; ignored += $$8 } \
	END { printf "Rust tests: %d passed, %d failed, %d ignored\n", passed, failed, ignored; exit passed == 0 }' target/test-rust.log
	@echo "Python tests: $$(grep -E '[0-9]+ passed' target/test-python.log | tail -n 1)"

check: setup ## Format, lints and types; changes nothing
	cargo fmt --check
	cargo clippy --workspace --all-targets -- -D warnings
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

bench: setup ## Time by stage and peak memory, one thread; the plane front end beside PCL and Open3D, where installed
	$(BIN)/python benchmarks/bench.py
	$(BIN)/python benchmarks/front_end.py

dist: $(VENV)/.installed | tools ## One wheel for Python 3.11 and newer in dist/, installed and tried in a fresh environment
	rm -rf dist $(DIST_VENV)
	$(BIN)/maturin build --release --quiet --out dist
	@ls dist/*-cp311-abi3-*.whl >/dev/null
	$(PYTHON) -m venv $(DIST_VENV)
	$(DIST_VENV)/bin/pip install --quiet --constraint requirements/dev.lock dist/*.whl
	cd $(DIST_VENV) && bin/boxwright --help >/dev/null && \
	bin/python -c 'from boxwright.models import *; [load_object_model(name) for name in TEMPLATE_NAMES]'
	@echo "dist: $$(ls dist) ($$(du -h dist/*.whl | cut -f 1)) installs and runs"

fuzz: ## Each reader's fuzz target for SECONDS (needs nightly Rust and cargo-fuzz)
	@test -n "$(FUZZ_TARGETS)" || { echo "make: no fuzz target in core/fuzz/fuzz_targets" >&2; exit 1; }
	@cargo fuzz --version >/dev/null 2>&1 || { echo "make: cargo-fuzz is missing; cargo install cargo-fuzz --locked" >&2; exit 1; }
	cd core && for target in $(FUZZ_TARGETS); do \
		mkdir -p fuzz/corpus/$$target; \
		cargo +nightly fuzz run $$target fuzz/corpus/$$target $$(ls -d fuzz/seeds/$$target 2>/dev/null) -- \
			-max_total_time=$(SECONDS) -timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=128; \
	done

WEIGHTS := src/boxwright/models/weights
SETS := out/sets

weights: setup ## Make the training frames and learn the shipped weights anew (takes hours)
	$(BIN)/boxwright synth $(SETS)/train --count 180 --seed 1
	$(BIN)/boxwright synth $(SETS)/train_none --count 30 --seed 2 --category none
	$(MAKE) --no-print-directory weights-of PLANES=grid
	$(MAKE) --no-print-directory weights-of PLANES=ransac
	$(MAKE) --no-print-directory weights-exact
	$(MAKE) --no-print-directory weights-fitted

# Each front end breaks panels in its own way: the weights are learnt on what it finds.
weights-of:
	mkdir -p $(WEIGHTS)/$(PLANES)
	$(BIN)/boxwright train $(SETS)/train $(SETS)/train_none --template carton \
		--planes $(PLANES) -o $(WEIGHTS)/$(PLANES)/carton.json
	$(BIN)/boxwright train $(SETS)/train $(SETS)/train_none --template cake_box \
		--category cake --category carton --category none --planes $(PLANES) -o $(WEIGHTS)/$(PLANES)/cake_box.json
	$(BIN)/boxwright train $(SETS)/train $(SETS)/train_none --template pizza_box \
		--category pizza --category cake --category none --planes $(PLANES) -o $(WEIGHTS)/$(PLANES)/pizza_box.json

# The method exact has its own terms and learner.
weights-exact:
	mkdir -p $(WEIGHTS)/exact
	$(BIN)/boxwright train $(SETS)/train $(SETS)/train_none --template carton \
		--method exact -o $(WEIGHTS)/exact/carton.json
	$(BIN)/boxwright train $(SETS)/train $(SETS)/train_none --template cake_box \
		--category cake --category carton --category none --method exact -o $(WEIGHTS)/exact/cake_box.json
	$(BIN)/boxwright train $(SETS)/train $(SETS)/train_none --template pizza_box \
		--category pizza --category cake --category none --method exact -o $(WEIGHTS)/exact/pizza_box.json
	$(BIN)/boxwright synth $(SETS)/calibrate --count 180 --seed 3
	$(BIN)/boxwright synth $(SETS)/calibrate_none --count 90 --seed 4 --category none
	$(BIN)/boxwright calibrate $(SETS)/calibrate $(SETS)/calibrate_none -o $(WEIGHTS)/exact

# What tells templates of fitted boxes apart; totes are no category of the training frames.
weights-fitted:
	$(BIN)/boxwright synth $(SETS)/totes --count 30 --seed 4 --category tote
	$(BIN)/boxwright train $(SETS)/train $(SETS)/train_none $(SETS)/totes --template tote \
		--method exact -o $(WEIGHTS)/exact/tote.json
	$(BIN)/boxwright synth $(SETS)/judge --count 360 --seed 503
	$(BIN)/boxwright synth $(SETS)/judge_none --count 160 --seed 504 --category none
	$(BIN)/boxwright synth $(SETS)/judge_2 --count 360 --seed 505
	$(BIN)/boxwright synth $(SETS)/judge_none_2 --count 107 --seed 506 --category none
	$(BIN)/boxwright synth $(SETS)/upright --count 120 --seed 509 --category upright
	$(BIN)/boxwright synth $(SETS)/part_shut --count 120 --seed 510 --category part_shut
	$(BIN)/boxwright synth $(SETS)/lying --count 120 --seed 511 --category lying
	$(BIN)/boxwright synth $(SETS)/judge_3 --count 240 --seed 8001
	$(BIN)/boxwright synth $(SETS)/judge_4 --count 240 --seed 8101
	$(BIN)/boxwright synth $(SETS)/judge_5 --count 240 --seed 8201
	$(BIN)/boxwright synth $(SETS)/judge_none_3 --count 200 --seed 8002 --category none
	$(BIN)/boxwright synth $(SETS)/judge_none_4 --count 200 --seed 8102 --category none
	$(BIN)/boxwright synth $(SETS)/judge_upright --count 60 --seed 8203 --category upright --boxes 1
	$(BIN)/boxwright synth $(SETS)/judge_closed --count 60 --seed 8206 --category closed
	$(BIN)/boxwright synth $(SETS)/judge_lying --count 60 --seed 8205 --category lying --boxes 1
	$(BIN)/boxwright train $(SETS)/judge $(SETS)/judge_none $(SETS)/judge_2 $(SETS)/judge_none_2 $(SETS)/upright $(SETS)/part_shut \
		$(SETS)/judge_3 $(SETS)/judge_4 $(SETS)/judge_5 $(SETS)/judge_none_3 $(SETS)/judge_none_4 $(SETS)/judge_upright \
		$(SETS)/judge_closed --lying $(SETS)/lying --lying $(SETS)/judge_lying --method fitted -o $(WEIGHTS)/fitted/judgement.json
	$(BIN)/python -m benchmarks.kinds $(SETS)/judge $(SETS)/totes --learn $(WEIGHTS)/fitted/kinds.json
	$(BIN)/python -m benchmarks.coverage $(SETS)/judge --scales

evaluate: setup ## Evaluate on simulated frames that no training saw (240 and 120, 60 upright, 60 half shut, 60 on a side, 60 closed, and 200 and 60 without an open box)
	$(BIN)/boxwright synth $(SETS)/boxes --count 240 --seed 9401
	$(BIN)/boxwright synth $(SETS)/no_boxes --count 200 --seed 9402 --category none
	$(BIN)/boxwright synth $(SETS)/boxes_upright --count 60 --seed 9403 --category upright --boxes 1
	$(BIN)/boxwright synth $(SETS)/boxes_part_shut --count 60 --seed 9404 --category part_shut --boxes 1
	$(BIN)/boxwright synth $(SETS)/boxes_lying --count 60 --seed 9405 --category lying --boxes 1
	$(BIN)/boxwright synth $(SETS)/boxes_closed --count 60 --seed 9406 --category closed
	$(BIN)/boxwright evaluate $(SETS)/boxes_closed --template closed_carton -o out/boxes_closed.json
	for set in boxes_upright boxes_part_shut boxes_lying; do $(BIN)/boxwright evaluate $(SETS)/$$set -o out/$$set.json; done
	for method in fitted exact paper; do \
		$(BIN)/boxwright evaluate $(SETS)/boxes --method $$method -o out/boxes_$$method.json; \
		$(BIN)/boxwright evaluate $(SETS)/no_boxes --method $$method -o out/no_boxes_$$method.json; \
	done
	$(BIN)/python -m benchmarks.gallery $(SETS)/boxes out/boxes_fitted.json -o docs/results/gallery \
		--without $(SETS)/no_boxes out/no_boxes_fitted.json
	$(BIN)/python -m benchmarks.coverage $(SETS)/boxes -o docs/results/coverage.md
	$(BIN)/boxwright synth $(SETS)/test --count 120 --seed 1000
	$(BIN)/boxwright synth $(SETS)/test_none --count 60 --seed 1003 --category none
	$(BIN)/boxwright evaluate $(SETS)/test --method paper --planes grid -o out/test.json
	$(BIN)/boxwright evaluate $(SETS)/test_none --method paper --planes grid -o out/test_none.json
	$(BIN)/boxwright evaluate $(SETS)/test --method paper --planes ransac -o out/test_ransac.json
	$(BIN)/boxwright evaluate $(SETS)/test_none --method paper --planes ransac -o out/test_none_ransac.json
	$(BIN)/boxwright evaluate $(SETS)/test --method exact -o out/test_exact.json
	$(BIN)/boxwright evaluate $(SETS)/test_none --method exact -o out/test_none_exact.json
	$(BIN)/python benchmarks/calibration.py $(SETS)/test $(SETS)/test_none --figure docs/results/calibration.png
	$(BIN)/boxwright synth $(SETS)/totes_test --count 20 --seed 1005 --category tote
	$(BIN)/python -m benchmarks.kinds $(SETS)/test $(SETS)/totes_test -o docs/results/kinds.md
	$(BIN)/boxwright synth $(SETS)/looks --count 36 --seed 3601 --boxes 1 --views 3
	$(BIN)/boxwright synth $(SETS)/looks_none --count 20 --seed 3602 --category none --views 3
	$(BIN)/python -m benchmarks.views $(SETS)/looks $(SETS)/looks_none -o docs/results/views.md

experiments: setup ## The paper's claims measured: tables and pictures in docs/results (half an hour)
	$(BIN)/python -m benchmarks.experiments

lock: $(VENV)/.installed ## Lock the versions of requirements/dev.in anew
	$(BIN)/pip install --quiet uv
	$(BIN)/uv pip compile -q --no-header --no-annotate --no-emit-index-url --no-emit-find-links --universal \
		--python-version 3.11 requirements/dev.in -o requirements/dev.lock

schemas: setup ## Write docs/schemas anew from the types
	$(BIN)/python -m boxwright.io.schemas docs/schemas
