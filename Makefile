# povgloss: glossy reflections for POV-Ray. `make help` lists the targets.

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:

VERSION := 0.1.0

# A sanitized build lives in a folder of its own: SANITIZE=address,undefined or SANITIZE=thread.
SANITIZE ?=
comma := ,
BUILD := build$(if $(SANITIZE),/sanitize-$(subst $(comma),-,$(SANITIZE)))

ifeq ($(origin CC),default)
CC := gcc
endif
CPPFLAGS += -D_GNU_SOURCE -DPOVGLOSS_VERSION='"$(VERSION)"' -Isrc
CFLAGS += -std=c11 -O3 -g -ffp-contract=off -fno-math-errno -fno-trapping-math -pthread \
          -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla
LDLIBS += -lOpenEXRCore -lpng -lm -pthread
# Asked for when it is used: `make deps` may install it first.
EXR_CFLAGS = $(shell pkg-config --cflags OpenEXR)
ifneq ($(SANITIZE),)
CFLAGS += -fsanitize=$(SANITIZE) -fno-sanitize-recover=all -fno-omit-frame-pointer
LDFLAGS += -fsanitize=$(SANITIZE)
endif

PACKAGES := gcc g++ binutils make libc6-dev pkg-config povray povray-includes povray-examples libopenexr-dev libpng-dev \
            libcmocka-dev libsdl2-dev xvfb xdotool imagemagick openimageio-tools openexr mandoc dpkg-dev python3-venv perl \
            coreutils findutils bubblewrap valgrind

PROGRAMS := $(patsubst src/main_%.c,$(BUILD)/bin/%,$(filter-out src/main_view.c,$(wildcard src/main_*.c)))
# The window of glossfilter --view, where SDL2 is.
VIEWER := $(BUILD)/lib/povgloss/view
# The inner loops are compiled once per instruction set from one source each.
ISAS := sse2 avx2 avx512
KERNELS := filter_kernel filter_sight
KERNEL_OBJECTS := $(foreach kernel,$(KERNELS),$(ISAS:%=$(BUILD)/obj/$(kernel)_%.o))
# Loaded into POV-Ray: its waits are shorter, and what it reads is noted for --depfile.
PRELOAD := $(BUILD)/lib/povgloss/preload.so
PRELOAD_SOURCES := src/preload_reads.c src/preload_waits.c
LIB_SOURCES := $(filter-out src/main_%.c $(KERNELS:%=src/%.c) $(PRELOAD_SOURCES),$(wildcard src/*.c))
LIB_OBJECTS := $(LIB_SOURCES:src/%.c=$(BUILD)/obj/%.o) $(if $(wildcard src/filter_kernel.c),$(KERNEL_OBJECTS))
LIBRARY := $(BUILD)/libgloss.a
# What is installed of it has the functions of gloss.h, and no other name that could meet a user's.
PUBLIC_LIBRARY := $(BUILD)/lib/libgloss.a
PUBLIC_NAMES := gloss_filter gloss_open gloss_apply gloss_close
# Found by the programs from the folder that they are in, here and installed.
INCLUDE := $(BUILD)/share/povgloss/include/povgloss.inc

PREFIX ?= /usr/local
DESTDIR ?=
UNIT_TESTS := $(patsubst tests/unit/%.c,$(BUILD)/tests/%,$(wildcard tests/unit/test_*.c))

TOOLS := $(patsubst tests/tools/%.c,$(BUILD)/tests/tools/%,$(filter-out tests/tools/preload_%,$(wildcard tests/tools/*.c)))
TOOLS += $(BUILD)/tests/tools/faults.so
# Each fuzz target twice: with a main that replays files, and with libFuzzer's.
FUZZ_TARGETS := $(patsubst tests/fuzz/fuzz_%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
FUZZ_REPLAYS := $(FUZZ_TARGETS:%=$(BUILD)/tests/fuzz/replay_%)
FUZZERS := $(FUZZ_TARGETS:%=$(BUILD)/tests/fuzz/fuzz_%)
FUZZ_SECONDS := 60
SCENES := $(patsubst povscenes/%.pov,build/scenes/%.png,$(wildcard povscenes/*.pov))

.PHONY: all
all: $(PROGRAMS) $(PRELOAD) $(VIEWER) $(INCLUDE) $(PUBLIC_LIBRARY) ## the programs povgloss and glossfilter, in build/bin

$(KERNELS:%=$(BUILD)/obj/%_sse2.o): ISA_FLAGS := -DFILTER_KERNEL_ISA=sse2
$(KERNELS:%=$(BUILD)/obj/%_avx2.o): ISA_FLAGS := -DFILTER_KERNEL_ISA=avx2 -mavx2
$(KERNELS:%=$(BUILD)/obj/%_avx512.o): ISA_FLAGS := -DFILTER_KERNEL_ISA=avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512

# Changed flags rebuild: the stamp's content is the command line of the compiler.
FLAGS_STAMP := $(BUILD)/flags
$(FLAGS_STAMP): force
	@mkdir -p $(@D)
	@printf '%s\n' '$(subst ','\'',$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS))' | cmp -s - $@ || \
	 printf '%s\n' '$(subst ','\'',$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS))' > $@
.PHONY: force
force:

define KERNEL_RULE
$(BUILD)/obj/$(1)_%.o: src/$(1).c $(FLAGS_STAMP)
	@mkdir -p $$(@D)
	$$(CC) $$(CPPFLAGS) $$(CFLAGS) $$(ISA_FLAGS) -MMD -MP -c -o $$@ $$<
endef
$(foreach kernel,$(KERNELS),$(eval $(call KERNEL_RULE,$(kernel))))

$(BUILD)/obj/exr_io.o: CPPFLAGS += $(EXR_CFLAGS)
$(BUILD)/obj/%.o: src/%.c $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) -MMD -MP -c -o $@ $<

# POV-Ray isn't sanitized, and what is loaded into it can't be either; nor what stands before a sanitizer's own calls.
$(PRELOAD): $(PRELOAD_SOURCES)
$(BUILD)/tests/tools/faults.so: tests/tools/preload_faults.c
$(PRELOAD) $(BUILD)/tests/tools/faults.so: $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(filter-out -fsanitize=%,$(CFLAGS)) -fPIC -shared -o $@ $(filter %.c,$^) -ldl

$(VIEWER): src/main_view.c $(LIBRARY) $(FLAGS_STAMP)
	@mkdir -p $(@D)
	@! pkg-config --exists sdl2 || { set -x; \
	 $(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -MMD -MP -MF $(BUILD)/obj/main_view.d -MT $@ -o $@ $< $(LIBRARY) \
	     $$(pkg-config --cflags --libs sdl2) $(LDLIBS); }

$(LIBRARY): $(LIB_OBJECTS)
	rm -f $@
	$(AR) rcs $@ $^

$(PUBLIC_LIBRARY): $(LIBRARY)
	@mkdir -p $(@D)
	rm -f $@
	$(LD) -r -u gloss_filter -o $(BUILD)/obj/gloss_public.o $<
	objcopy $(PUBLIC_NAMES:%=--keep-global-symbol=%) $(BUILD)/obj/gloss_public.o
	$(AR) rcs $@ $(BUILD)/obj/gloss_public.o

$(INCLUDE): povscenes/povgloss.inc
	@mkdir -p $(@D)
	cp $< $@

$(BUILD)/bin/%: $(BUILD)/obj/main_%.o $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS)

$(BUILD)/tests/%: tests/unit/%.c $(LIBRARY) $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -MMD -MP -o $@ $< $(LIBRARY) -lcmocka $(LDLIBS)

$(BUILD)/tests/tools/%: tests/tools/%.c $(LIBRARY) $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -MMD -MP -o $@ $< $(LIBRARY) -lcmocka $(LDLIBS)

$(BUILD)/tests/fuzz/replay_%: tests/fuzz/fuzz_%.c tests/fuzz/replay.c $(LIBRARY) $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -o $@ $< tests/fuzz/replay.c $(LIBRARY) $(LDLIBS)

$(BUILD)/tests/fuzz/fuzz_%: tests/fuzz/fuzz_%.c $(LIBRARY) $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -fsanitize=fuzzer -o $@ $< $(LIBRARY) $(LDLIBS)

$(FUZZ_REPLAYS) $(FUZZERS): tests/fuzz/fuzz_support.h $(wildcard src/*.h)

# What follows `deps` on the command line needs what it installs.
ifneq ($(filter deps,$(MAKECMDGOALS)),)
.NOTPARALLEL:
endif

.PHONY: deps
deps: ## install what building and testing need: Debian packages (apt-get, through sudo when not root) and Mitsuba
	@missing=; for package in $(PACKAGES); do \
	    dpkg-query -W -f '$${Status}\n' $$package 2>/dev/null | grep -q '^install ok installed$$' || \
	        missing="$$missing $$package"; \
	done; \
	if [ -n "$$missing" ]; then \
	    sudo=; [ "$$(id -u)" = 0 ] || sudo=sudo; \
	    $$sudo apt-get update -qq && \
	    $$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing; \
	fi
	@$(MAKE) --no-print-directory mitsuba || echo "Mitsuba can't be installed: its test will be skipped"

# Only the test of scripts/mitsuba_passes.py needs it.
.PHONY: mitsuba
mitsuba: build/mitsuba/bin/python ## install Mitsuba 3 in build/mitsuba

build/mitsuba/bin/python:
	python3 -m venv build/mitsuba
	build/mitsuba/bin/pip install -q --disable-pip-version-check --timeout 20 --retries 2 mitsuba numpy || \
	     { rm -rf build/mitsuba; exit 1; }

.PHONY: slurm
slurm: ## install Slurm and GNU parallel, for the test of scripts/povgloss-array.sbatch
	$(MAKE) --no-print-directory deps PACKAGES='slurm-wlm parallel'

.PHONY: trade
trade: all ## measure error and time of every method (hours): docs/trade.png, the tables of docs/accuracy.md
	scripts/trade.sh

.PHONY: demo
demo: build/demo.png ## render the demo scene
	@echo "The picture is build/demo.png"

build/demo.png: povscenes/interior.pov povscenes/povgloss.inc $(PROGRAMS)
	$(BUILD)/bin/povgloss render povscenes/interior.pov +W640 +H480 +A0.3 Declare=Roughness=0.1 -o $@

.PHONY: scenes
scenes: $(SCENES) ## render every povscenes/*.pov to build/scenes/*.png

build/scenes/%.png: povscenes/%.pov $(PROGRAMS) $(PRELOAD)
	@mkdir -p $(@D)
	$(BUILD)/bin/povgloss render $< +W640 +H480 +A0.3 --depfile $(@:.png=.d) -o $@

-include $(SCENES:.png=.d)

# The passes are rendered once; each figure filters them with another roughness.
FIGURES := build/figures/figure2.png build/figures/figure3.png build/figures/figure4.png
.PHONY: figures
figures: build/figures/figures.png ## the paper's Figures 2 to 4: one scene at roughness 0 %, 10 % and 50 %
	@echo "The figures are $(FIGURES); side by side: $<"

build/figures/passes.exr: povscenes/interior.pov povscenes/povgloss.inc $(PROGRAMS)
	@mkdir -p $(@D)
	$(BUILD)/bin/povgloss passes $< +W640 +H480 +A0.3 -o $@

build/figures/figure2.png: ROUGHNESS := 0
build/figures/figure3.png: ROUGHNESS := 0.1
build/figures/figure4.png: ROUGHNESS := 0.5
$(FIGURES): build/figures/passes.exr
	$(BUILD)/bin/glossfilter $< --roughness $(ROUGHNESS) -o $@

build/figures/figures.png: $(FIGURES)
	oiiotool $^ --mosaic:pad=8 3x1 -o $@

.PHONY: check
check: all $(UNIT_TESTS) $(TOOLS) $(FUZZ_REPLAYS) ## all tests; SANITIZE=address,undefined tests a sanitized build
	BIN=$(BUILD)/bin TOOLS=$(BUILD)/tests/tools CC=$(CC) scripts/check.sh $(UNIT_TESTS)

.PHONY: accuracy-float
accuracy-float: $(BUILD)/tests/tools/float_accuracy ## the table of the filters' errors against double, in docs/reliability.md
	@$<

.PHONY: faults
faults: $(PROGRAMS) $(PRELOAD) $(TOOLS) ## every call that can fail, failing in turn, and 100 signals (long)
	BIN=$(BUILD)/bin TOOLS=$(BUILD)/tests/tools FAULTS=all MOMENTS=100 prove --exec '' --timer tests/e2e/faults.sh \
	    tests/e2e/signals.sh

# Programs whose tests run on several threads; of those that have many others, the tests called after that.
THREADED_TESTS := filter filter_properties control_variate exr_io gloss
.PHONY: threads
threads: ## the tests of what runs on several threads, under ThreadSanitizer
	$(MAKE) SANITIZE=thread run-threads

.PHONY: run-threads
run-threads: $(THREADED_TESTS:%=$(BUILD)/tests/test_%)
	CMOCKA_MESSAGE_OUTPUT=TAP TESTS='*threads*' SEEDS=1 prove --exec '' --timer $^

# A corpus grows in build/fuzz; an input that fails is left beside it, and becomes a seed when its cause is gone.
.PHONY: fuzz
fuzz: ## fuzz each reader for FUZZ_SECONDS (60) with clang's libFuzzer and sanitizers
	@$(MAKE) --no-print-directory deps PACKAGES='clang llvm libclang-rt-14-dev'
	$(MAKE) CC=clang SANITIZE=fuzzer-no-link,address,undefined run-fuzzers

.PHONY: run-fuzzers
run-fuzzers: $(FUZZERS)
	for target in $(FUZZ_TARGETS); do \
	    mkdir -p build/fuzz/$$target && \
	    $(CURDIR)/$(BUILD)/tests/fuzz/fuzz_$$target -max_total_time=$(FUZZ_SECONDS) -timeout=20 -rss_limit_mb=3000 \
	        -print_final_stats=1 -artifact_prefix=$(CURDIR)/build/fuzz/$$target- \
	        $(CURDIR)/build/fuzz/$$target $(CURDIR)/tests/fuzz/seeds/$$target || exit; \
	done

.PHONY: bench
bench: $(PROGRAMS) $(PRELOAD) $(TOOLS) ## times of the filter, and errors of its variants
	BIN=$(BUILD)/bin TOOLS=$(BUILD)/tests/tools OUT=$(BUILD)/bench scripts/bench.sh

.PHONY: growth
growth: $(PROGRAMS) $(INCLUDE) ## time and memory against pixels, exponent and threads (an hour): docs/growth.png
	BIN=$(BUILD)/bin scripts/growth.sh

.PHONY: corpus
corpus: $(PROGRAMS) ## run every scene of povray-examples as it is; the table is docs/corpus.md
	BIN=$(BUILD)/bin OUT=$(BUILD)/corpus REPORT=docs/corpus.md scripts/corpus.sh

# What is installed, by the folder under PREFIX.
INSTALLED_bin := $(PROGRAMS)
INSTALLED_lib := $(PUBLIC_LIBRARY)
INSTALLED_lib/povgloss := $(PRELOAD) $(VIEWER)
INSTALLED_lib/pkgconfig := $(BUILD)/lib/pkgconfig/libgloss.pc
INSTALLED_include := src/gloss.h
INSTALLED_share/povgloss/include := $(INCLUDE)
INSTALLED_share/man/man1 := $(wildcard man/*.1)
INSTALLED_share/man/man5 := $(wildcard man/*.5)
INSTALLED_share/bash-completion/completions := $(wildcard completions/*)
INSTALL_FOLDERS := $(patsubst INSTALLED_%,%,$(filter INSTALLED_%,$(.VARIABLES)))

.PHONY: $(BUILD)/lib/pkgconfig/libgloss.pc
$(BUILD)/lib/pkgconfig/libgloss.pc:
	@mkdir -p $(@D)
	@printf '%s\n' 'prefix=$(PREFIX)' 'libdir=$${prefix}/lib' 'includedir=$${prefix}/include' '' 'Name: libgloss' \
	    'Description: Glossy reflections from planes of floats' 'Version: $(VERSION)' 'Cflags: -I$${includedir}' \
	    'Libs: -L$${libdir} -lgloss -lm -pthread' > $@

.PHONY: install
install: all $(INSTALLED_lib/pkgconfig) ## install below PREFIX (/usr/local); DESTDIR goes before it
	@set -e; $(foreach folder,$(INSTALL_FOLDERS), \
	    install -d "$(DESTDIR)$(PREFIX)/$(folder)"; \
	    install -m $(if $(filter bin,$(folder)),755,644) $(wildcard $(INSTALLED_$(folder))) \
	        "$(DESTDIR)$(PREFIX)/$(folder)";)
	@[ ! -e $(VIEWER) ] || chmod 755 "$(DESTDIR)$(PREFIX)/lib/povgloss/view"
	@echo "Installed below $(DESTDIR)$(PREFIX)"

.PHONY: uninstall
uninstall: ## remove what install put below PREFIX, and folders that this leaves empty
	@rm -f $(foreach folder,$(INSTALL_FOLDERS), \
	    $(patsubst %,"$(DESTDIR)$(PREFIX)/$(folder)/%",$(notdir $(INSTALLED_$(folder)))))
	@for folder in lib/povgloss lib/pkgconfig share/povgloss/include share/povgloss share/man/man1 share/man/man5 \
	        share/bash-completion/completions share/bash-completion; do \
	    [ ! -d "$(DESTDIR)$(PREFIX)/$$folder" ] || rmdir --ignore-fail-on-non-empty "$(DESTDIR)$(PREFIX)/$$folder"; \
	done

.PHONY: deb
deb: $(PROGRAMS) ## a Debian package in build/
	scripts/deb.sh $(VERSION) $(BUILD)

.PHONY: fresh
fresh: ## type README's commands on a fresh Debian 12, made by debootstrap (root, 15 minutes)
	scripts/fresh_machine.sh

.PHONY: clean
clean: ## remove everything that make built
	rm -rf build

.PHONY: help
help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1 \t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 24

.SECONDARY:
-include $(wildcard $(BUILD)/obj/*.d $(BUILD)/tests/*.d $(BUILD)/tests/tools/*.d)
