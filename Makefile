# `make run` shows GSV at work, `make test` runs every test. Both first install what is missing
# (tools/setup) and build what they need: `make run` no tests.
# `make docs` builds the documentation site, build/release/share/gsv/docs, which gsv serves at /docs/.
# `make install` installs into PREFIX (/usr/local), `make deb` makes Debian packages in build/release/packages.
# `make soak` repeats the determinism matrix many times and compares a debug build (a quarter of an hour, and the debug build);
# it also runs a campaign of 500 runs by a Slurm of its own, has a viewer's tab stand still for three minutes,
# and tries the packages on a bare Debian, which needs root and debootstrap.
# `make bench` runs all benches (half an hour, on a machine that does nothing else) and prints one table; it writes
# build/release/bench.json. BENCH_ARGS="--quick --rows crowd,lidar" runs some, in short; bench/all lists its options.
# `make chaos` kills, stops, floods and fills up all that a server lives with for CHAOS_SECONDS (3600).
# `make fuzz` feeds each fuzz target with random input for FUZZ_SECONDS (60), for which it needs clang, and sends
# mutated requests to every servant of the real programs for as long (of PRESET; FUZZ_SEED says which).
# `make asan`, `make tsan` and `make ubsan` run every test under a sanitizer; `make coverage` tells what share of
# the lines of gsv/ the tests run, for which it needs gcovr.
#   ARGS="…"      more arguments for `gsv run`, as in: make run ARGS="--headless --duration 5"
#   PRESET=dev    another preset of CMakePresets.json
PRESET ?= release
JOBS ?= $(shell nproc)
FUZZ_SECONDS ?= 60
FUZZ_SEED ?= 1
CHAOS_SECONDS ?= 3600
CHAOS_SEED ?= 1
BUILD := build/$(PRESET)

.PHONY: run test bench docs install deb soak chaos build configure setup asan tsan ubsan coverage fuzz format clean

run: configure
	cmake --build $(BUILD) --target programs docs --parallel $(JOBS)
	$(BUILD)/bin/gsv run $(ARGS)

test: build
	tools/run_tests $(BUILD)

bench: configure
	cmake --build $(BUILD) --target programs --parallel $(JOBS)
	bench/all $(BUILD) $(BUILD)/bench.json $(BENCH_ARGS)

docs: configure
	cmake --build $(BUILD) --target docs

# Programs, the SDK, the Python module: into PREFIX (/usr/local), or as Debian packages.
PREFIX ?= /usr/local
install: configure
	cmake --build $(BUILD) --target installed --parallel $(JOBS)
	cmake --install $(BUILD) --prefix $(PREFIX)

deb: configure
	cmake --build $(BUILD) --target installed --parallel $(JOBS)
	cd $(BUILD) && cpack
	@ls $(BUILD)/packages/*.deb

soak: build deb
	cmake --preset dev
	cmake --build build/dev --target gsv --parallel $(JOBS)
	tools/soak $(BUILD) build/dev
	tools/try_packages $(BUILD)

chaos: configure
	cmake --build $(BUILD) --target programs --parallel $(JOBS)
	tests/chaos/chaos.py $(BUILD) --seconds $(CHAOS_SECONDS) --seed $(CHAOS_SEED) --report $(BUILD)/chaos.json

build: configure
	cmake --build $(BUILD) --parallel $(JOBS)

configure: setup
	cmake --preset $(PRESET)

setup:
	tools/setup

asan tsan ubsan:
	$(MAKE) test PRESET=$@

coverage:
	$(MAKE) test PRESET=coverage
	tools/report_coverage build/coverage

fuzz: configure
	@command -v clang++ > /dev/null || { echo "make fuzz needs clang: apt-get install clang"; exit 5; }
	cmake --preset fuzz
	cmake --build --preset fuzz --parallel $(JOBS)
	tools/run_fuzzers build/fuzz $(FUZZ_SECONDS)
	cmake --build $(BUILD) --target programs --parallel $(JOBS)
	tests/giop/mutate.py $(BUILD) --seconds $(FUZZ_SECONDS) --seed $(FUZZ_SEED)

format:
	tools/format

clean:
	rm -rf build
