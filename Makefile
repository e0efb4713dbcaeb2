# povgloss: glossy reflections for POV-Ray. `make help` lists the targets.

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:

VERSION := 0.1.0
PREFIX ?= /usr/local
DESTDIR ?=

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
EXR_CFLAGS := $(shell pkg-config --cflags OpenEXR 2>/dev/null)
ifneq ($(SANITIZE),)
CFLAGS += -fsanitize=$(SANITIZE) -fno-sanitize-recover=all -fno-omit-frame-pointer
LDFLAGS += -fsanitize=$(SANITIZE)
endif

PACKAGES := gcc make libc6-dev pkg-config povray povray-includes libopenexr-dev libpng-dev \
            libcmocka-dev openimageio-tools perl

PROGRAMS := $(patsubst src/main_%.c,$(BUILD)/bin/%,$(wildcard src/main_*.c))
# The kernel is compiled once per instruction set from one source.
ISAS := sse2 avx2 avx512
KERNEL_OBJECTS := $(ISAS:%=$(BUILD)/obj/filter_kernel_%.o)
LIB_SOURCES := $(filter-out src/main_%.c src/filter_kernel.c,$(wildcard src/*.c))
LIB_OBJECTS := $(LIB_SOURCES:src/%.c=$(BUILD)/obj/%.o) $(if $(wildcard src/filter_kernel.c),$(KERNEL_OBJECTS))
LIBRARY := $(BUILD)/libgloss.a
UNIT_TESTS := $(patsubst tests/unit/%.c,$(BUILD)/tests/%,$(wildcard tests/unit/test_*.c))

.PHONY: all deps check scenes figures demo clean help
all: $(PROGRAMS)

$(BUILD)/obj/filter_kernel_sse2.o: ISA_FLAGS := -DFILTER_KERNEL_ISA=sse2
$(BUILD)/obj/filter_kernel_avx2.o: ISA_FLAGS := -DFILTER_KERNEL_ISA=avx2 -mavx2
$(BUILD)/obj/filter_kernel_avx512.o: ISA_FLAGS := -DFILTER_KERNEL_ISA=avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512

# Changed flags rebuild: the stamp's content is the command line of the compiler.
FLAGS_STAMP := $(BUILD)/flags
$(FLAGS_STAMP): force
	@mkdir -p $(@D)
	@printf '%s\n' '$(subst ','\'',$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS))' | cmp -s - $@ || \
	 printf '%s\n' '$(subst ','\'',$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS))' > $@
.PHONY: force
force:

$(BUILD)/obj/filter_kernel_%.o: src/filter_kernel.c $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) $(ISA_FLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/obj/exr_io.o: CPPFLAGS += $(EXR_CFLAGS)
$(BUILD)/obj/%.o: src/%.c $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) -MMD -MP -c -o $@ $<

$(LIBRARY): $(LIB_OBJECTS)
	rm -f $@
	$(AR) rcs $@ $^

$(BUILD)/bin/%: $(BUILD)/obj/main_%.o $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS)

$(BUILD)/tests/%: tests/unit/%.c $(LIBRARY) $(FLAGS_STAMP)
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) $(LDFLAGS) -MMD -MP -o $@ $< $(LIBRARY) -lcmocka $(LDLIBS)

.SECONDARY:
-include $(wildcard $(BUILD)/obj/*.d $(BUILD)/tests/*.d)

clean: ## remove everything that make built
	rm -rf build
