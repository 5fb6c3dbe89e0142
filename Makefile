# make quick: from a fresh clone to a PDF. make site: pages of what `make papers` and configs/front.toml left. make check,
# make test, make gate: what .ci/run calls. Each sets up what it needs, with the interpreter PYTHON. A .venv of another
# interpreter than the PYTHON that is named is made anew.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/ready

version = $(shell $(1) -c "import sys; print(sys.version)" 2>/dev/null)
ifneq ($(origin PYTHON),file)
ifneq ($(call version,$(PYTHON)),$(call version,$(BIN)/python))
.PHONY: $(READY)
CLEAR := --clear
endif
endif

.PHONY: quick papers site guide test campaign bench gate check style types kernels format clean
quick: $(READY)
	$(BIN)/firsthit run configs/quick.toml
	$(BIN)/firsthit report runs/quick

papers: $(READY)
	$(BIN)/firsthit run configs/papers.toml
	$(BIN)/firsthit report runs/papers

RUNS := runs/papers runs/front
site: $(READY)
	@for run in $(RUNS); do test -f $$run/plan.json || echo "$$run is not there, and no part of the site;" \
		"$(BIN)/firsthit run configs/$${run#runs/}.toml makes it"; done
	$(BIN)/firsthit publish $(patsubst %/plan.json,%,$(wildcard $(RUNS:=/plan.json))) -o site

guide: $(READY)
	$(BIN)/python -m sphinx --fail-on-warning --nitpicky --quiet docs build/guide
	@echo build/guide/index.html

test: $(READY)
	$(BIN)/python -m pytest -q -n auto --dist loadscope

campaign: $(READY)
	$(BIN)/python -m tests.campaigns --table docs/reliability.md

bench: $(READY)
	$(BIN)/python -m tests.benchmarks.startup
	$(BIN)/python -m tests.benchmarks.oracle_speed
	$(BIN)/python -m tests.benchmarks.plan_memory 14
	$(BIN)/python -m tests.benchmarks.storing
	$(BIN)/python -m tests.benchmarks.cluster
	$(BIN)/python -m tests.benchmarks.report_speed 10000 100000 1000000
	$(BIN)/python -m pytest -q tests/benchmarks --benchmark-enable --benchmark-only --benchmark-autosave

gate: $(READY)
	$(BIN)/firsthit gate configs/gate.toml

check: style types kernels

style: $(READY)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .

types: $(READY)
	$(BIN)/mypy

kernels: $(READY)
	$(BIN)/firsthit compile --together --timeout 300 --surface torus

format: $(READY)
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean:
	rm -rf .venv runs site build *.egg-info

$(READY): pyproject.toml constraints.txt drivers.sh
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
		|| { echo "firsthit needs Python 3.11 or newer; try: make PYTHON=python3.13"; exit 2; }
	$(PYTHON) -m venv $(CLEAR) .venv
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[opengl,opencl,mesh,report,guide,dev]'
	sh drivers.sh $(BIN)/python
	touch $@
