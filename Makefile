# Every target sets itself up first. Stamps in .venv tell what is up to date, so a second call
# neither installs nor builds; PYTHON chooses the interpreter of a new .venv.
VENV := .venv
BIN := $(VENV)/bin
STAMPS := $(VENV)/stamps
INSTALL := $(BIN)/uv pip install --quiet --python $(BIN)/python --no-deps --no-build-isolation
INTERFACES := $(wildcard $(foreach spec,msgs_spec tools/tf2_msgs,$(addprefix $(spec)/,\
	package.xml CMakeLists.txt msg/* srv/*)))
CORE := $(shell find planetary_twin_py/core planetary_twin_py/_core -name '*.?pp' -o -name '*.txt' -o -name '*.py' 2>/dev/null)
PARTS := $(wildcard benchmarks/planetary_twin_core_parts/*.?pp)
NODES := $(shell find ros_ws/src/planetary_twin -not -path '*/build*' -not -path '*.egg-info*' \
	-not -name '*.pyc' -not -name __pycache__)

# The ROS of the wheels must not mix with one that happens to be sourced.
unexport PYTHONPATH AMENT_PREFIX_PATH CMAKE_PREFIX_PATH COLCON_PREFIX_PATH
ifneq ($(AMENT_PREFIX_PATH)$(_ROS_WHEELS_BOOTSTRAP_COMPLETE),)
unexport LD_LIBRARY_PATH _ROS_WHEELS_BOOTSTRAP_COMPLETE
endif

.PHONY: setup run test test-features test-all test-exhaustive test-release test-model test-nodes test-cosimulation test-arm test-fast sanitize soak bench view picture sample studies gallery measured docs lint lock clean

setup: $(STAMPS)/interfaces $(STAMPS)/model $(STAMPS)/core $(STAMPS)/nodes $(STAMPS)/whole_core

# What a run does not need is set up after it.
run: $(STAMPS)/interfaces $(STAMPS)/model $(STAMPS)/core $(STAMPS)/nodes
	@$(BIN)/planetary-twin run $(ARGS)
	@$(MAKE) --silent setup

# Nodes wait for one another often: four workers keep two cores busy. Each file is one worker's, so
# that what its tests share is made once. Workers, and the hundreds of programs that they start,
# compile each module once, not each time.
PYTEST := MAKEFLAGS= PYTHONDONTWRITEBYTECODE= $(BIN)/pytest --quiet --numprocesses=4 --dist=loadfile --no-loadscope-reorder

test:
	@echo "tests of every feature: nine to fifteen minutes on 2 idle cores"
	@$(MAKE) --no-print-directory test-features

test-features: setup
	$(PYTEST) -m "not exhaustive and not release" --ignore=tests/ros/test_soak.py $(ARGS)

# What CI runs beyond `make test`: documentation that is executed, searches by chance, every further
# case, and minutes of running live.
test-all:
	@echo "make test, then what takes longer: about half an hour on 2 idle cores"
	@$(MAKE) --no-print-directory test
	@$(MAKE) --no-print-directory --jobs=2 --output-sync=target lint test-cosimulation
	@$(MAKE) --no-print-directory --jobs=2 test-exhaustive soak DURATION=$(or $(DURATION),200)

test-exhaustive: setup
	$(PYTEST) --numprocesses=3 -m "exhaustive and not release" $(ARGS)  # they wait little

# Minutes of processor time for one test, and longer searches by chance: before a release, and after
# a change of what a test guards.
test-release: setup
	$(PYTEST) --numprocesses=3 -m release $(ARGS)
	FUZZ_EXAMPLES=$(or $(FUZZ_EXAMPLES),1000) $(PYTEST) $(shell find tests -name 'test_fuzzed_*.py') $(ARGS)

test-model: setup
	$(PYTEST) -m "not exhaustive and not release" --ignore=tests/ros $(ARGS)

test-nodes: setup
	$(PYTEST) -m "not exhaustive and not release" --ignore=tests/ros/test_soak.py tests/ros $(ARGS)

# The core with checks of addresses, bounds and undefined behaviour, which end a test.
sanitize: setup
	tools/build_core $(VENV) sanitized
	tools/run_sanitized $(VENV) $(or $(ARGS),tests/core tests/stability tests/integrators)

# An FMU in FMPy, a joint in MuJoCo and a data set in mlcroissant, beside .venv: they are large, and
# FMPy wants another CMake than the set-up.
test-cosimulation: setup
	$(BIN)/uv pip install --quiet --python $(BIN)/python --target build/cosimulation --group cosimulation
	PYTHONPATH=$(CURDIR)/build/cosimulation $(PYTEST) --numprocesses=3 tests/fmu/test_fmpy.py tests/examples tests/datasets/test_readers.py $(ARGS)

# The core of 64-bit ARM, cross-compiled, on an emulated processor.
test-arm: setup
	tools/test_arm $(VENV) $(ARGS)

test-fast: setup
	$(PYTEST) -m "not slow and not exhaustive and not release" $(ARGS)

soak: setup
	SOAK_DURATION=$(or $(DURATION),3600) $(BIN)/pytest -q -s -p no:cacheprovider tests/ros/test_soak.py

lint: setup
	$(BIN)/ruff check && $(BIN)/ruff format --check && $(BIN)/mypy && $(BIN)/lint-imports --no-logo
	@$(BIN)/clang-format --dry-run --Werror $(filter %.hpp %.cpp,$(CORE) $(PARTS))

bench: setup
	@$(BIN)/planetary-twin bench $(ARGS)

view: setup
	@$(BIN)/planetary-twin view $(or $(FILE),$(error FILE is missing: make view FILE=recordings/NAME)) $(ARGS)

# The pictures of the README: a recording made for it, and the last measurement.
picture: setup
	rm -rf recordings/picture
	$(BIN)/planetary-twin run --record picture
	$(BIN)/planetary-twin view recordings/picture --screenshot docs/recording.png --at 5.3
	$(BIN)/python benchmarks/glance.py docs/speed-against-error.png
	$(BIN)/planetary-twin plant paper --hidden docs/examples/crack.yaml --duration 40 \
		--out build/readings.parquet --encoders build/encoders.parquet
	$(BIN)/planetary-twin follow paper --from build/readings.parquet --encoders build/encoders.parquet \
		--picture docs/crack-found.png

# The recording that is kept in git, for trying things on.
sample: setup
	tools/make_sample $(VENV)

# The pictures of docs/studies.md and docs/howto/load-sharing.md.
studies: setup
	$(BIN)/planetary-twin sweep paper --dynamics quasi_static --lubrication.lambda_ratio computed \
		--lubrication.boundary load_sharing --input-speed 500rpm:10000rpm:20 \
		--input-torque 5:100:20 --duration 0.1 --settling 0 --out docs/efficiency-map.png
	$(BIN)/planetary-twin stribeck paper --set lubrication.boundary=load_sharing \
		--out docs/stribeck.png
	$(BIN)/planetary-twin load-sharing floating_sun --picture docs/load-sharing.png
	$(BIN)/planetary-twin lost-motion paper --torque "100 N m" --picture docs/lost-motion.png
	$(BIN)/planetary-twin bifurcation paper --input-speed 9500rpm:12500rpm:121 \
		--set input_torque=10 --set backlash=20um --set mesh.damping.loss_factor=0.006 \
		--set drive.speed_limit=14000rpm --cycles 40 --tolerance 1e-3 --out docs/bifurcation.png

# The pictures of docs/gallery.md, made by the commands on that page.
gallery: setup
	cd docs && PATH=$(CURDIR)/$(BIN):$$PATH ../$(BIN)/python -m _generate.gallery

# docs/measured.md: published and measured figures beside the twin's.
measured: setup
	cd benchmarks && PATH=$(CURDIR)/$(BIN):$$PATH ../$(BIN)/python -m measured ../docs/measured.md

# The site, and the pages of its reference that are made from the code; a warning, so a broken link
# too, is an error.
docs: setup
	cd docs && ../$(BIN)/python -m _generate reference
	$(BIN)/sphinx-build --quiet --fail-on-warning --keep-going docs docs/_build/site

lock: setup
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --all-extras \
		--no-header --no-annotate --upgrade pyproject.toml --output-file requirements.lock

clean:
	rm -rf $(VENV) build *.egg-info planetary_twin_py/_core/fmu ros_ws/build ros_ws/install ros_ws/log docs/_build
	find planetary_twin_py/_core benchmarks -name '*.so' -delete -o -name '*.pyi' -delete

$(STAMPS)/dependencies: requirements.lock
	$(eval FOUND := $(shell PYTHON='$(PYTHON)' tools/check_machine 2>&1))
	$(if $(filter-out 0,$(.SHELLSTATUS)),$(error $(FOUND)))
	@tools/make_venv $(FOUND) $(VENV)
	@mkdir -p $(STAMPS) && touch $@

$(STAMPS)/interfaces: $(STAMPS)/dependencies tools/build_interfaces tools/ros_from_pip.cmake \
	tools/parse_once/sitecustomize.py $(INTERFACES)
	@tools/build_interfaces $(VENV)
	@touch $@

# Python reads the model from here; the core is compiled below, each time its sources change.
$(STAMPS)/model: $(STAMPS)/dependencies tools/install_model pyproject.toml benchmarks/pyproject.toml
	@tools/install_model $(VENV)
	@$(INSTALL) --editable benchmarks
	@touch $@

$(STAMPS)/core: $(STAMPS)/dependencies tools/build_core $(CORE)
	@tools/build_core $(VENV) "" held_axes
	@touch $@

$(STAMPS)/whole_core: $(STAMPS)/core $(PARTS)
	@tools/build_core $(VENV) "" rest
	@touch $@

$(STAMPS)/nodes: $(STAMPS)/dependencies tools/install_nodes $(NODES)
	@tools/install_nodes $(VENV)
	@touch $@
