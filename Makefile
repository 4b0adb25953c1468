# Targets. All install what is missing (tools/setup) and build what they need.
#   make run       runs an example; ARGS="…" are arguments of `gsv run`, such as "--headless"
#   make test      runs all tests
#   make docs      builds the documentation site in build/release/share/gsv/docs, which gsv serves
#                  at /docs/
#   make install   installs into PREFIX (default: /usr/local)
#   make deb       makes Debian packages in build/release/packages
#   make soak      runs the long tests: the determinism matrix many times, also with a debug build
#                  (a quarter of an hour), a campaign of 500 runs on a Slurm cluster of one machine,
#                  and a viewer whose tab is suspended for three minutes. Also tests the packages on
#                  a bare Debian, which needs root and debootstrap
#   make bench     runs all benches (10 to 30 minutes; run no other programs meanwhile), prints a table
#                  and writes build/release/bench.json. BENCH_ARGS="--quick --rows crowd,lidar" runs
#                  some of them for a short time. With "--against BUILD2", it measures each row
#                  also with the build BUILD2 of another version. bench/all lists its options
#   make chaos     disturbs a running server for CHAOS_SECONDS (3600), see tests/chaos/chaos.py
#   make fuzz      runs each fuzz target with random input for FUZZ_SECONDS (60), which needs clang,
#                  and sends mutated requests to all servants for the same time (FUZZ_SEED: seed)
#   make asan, make tsan, make ubsan   run the tests under a sanitizer
#   make coverage  reports the percentage of the lines of gsv/ that the tests execute; needs gcovr
# PRESET=dev selects another preset of CMakePresets.json.
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
