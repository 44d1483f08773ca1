# Needs git, make and Python 3.11 or newer; `setup` brings the rest. `make` lists the commands.
.PHONY: help setup run test gate lock clean

help:
	@echo "make run    set up, run every case in every code found, print the report's path"
	@echo "make test   set up, then lint, types and tests"
	@echo "make gate   set up, judge every case quickly: .vv/gate.md, .vv/gate.xml, .vv/report/index.html"
	@echo "make setup  the virtual environment in .venv; YADE and LIGGGHTS where apt may"
	@echo "make lock   renew requirements.lock from pyproject.toml"
	@echo "make clean  remove .venv and everything generated"
	@echo "            CODES=lmgc90,pybullet,kratos: these too, in environments of their own"
	@echo "Variables: PYTHON=/path/to/python   the Python that .venv is made from"
	@echo "           VV_APT=no                leave the system's packages alone"
	@echo "           VV_REQUIRE=yade,liggghts fail where these codes are missing"

setup:
	@CODES="$(CODES)" ./setup.sh

run: setup
	@.venv/bin/vv run --all

test: setup
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy
	.venv/bin/pytest -n auto --dist loadfile

gate: setup
	@mkdir -p .vv; told=0; .venv/bin/vv gate --against cases/baselines $(if $(VV_REQUIRE),--require $(VV_REQUIRE)) \
	    --markdown .vv/gate.md --junit .vv/gate.xml || told=$$?; .venv/bin/vv report && exit $$told

lock:
	@./setup.sh lock

clean:
	rm -rf .venv .codes .vv .mypy_cache .ruff_cache .pytest_cache .hypothesis
