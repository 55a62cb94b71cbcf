# wiggly. `make run` and `make test` are each all that is needed on a bare Debian or Ubuntu: they install what is missing.
#
#   make [all]    the binary, the library and the tools
#   make library  the library alone, static and shared; needs a C compiler, no packages
#   make run      builds and starts the live app (ARGS="scene.json --size 960x600" for more)
#   make test     builds and runs every test (TESTS="spline test_curves a_case" for rooms, files and cases; JOBS=1 for one at a time)
#   make test-all the same with all that takes long: failing allocations and system calls, other compilers, every size of screen,
#                 browsers, Blender, Python and Node
#   make bench    the solver against LAPACKE (ARGS="--json FILE --large")
#   make npm      the npm package, in build/npm
#   make wheel    the Python package for every platform, in build/wheels (PLATFORMS="win_amd64" for one); fetches zig
#   make web      the app as a web page, in build/web, for any web server; fetches the source of jansson
#   make models   the generated characters, build/models/creature.obj, dog.glb and fox.glb
#   make blender  the extension for Blender with the Python package of every platform that it runs on, a .zip in build; PLATFORMS as above
#   make blender-proof  measures the extension in each Blender, and writes the table of tests/README.md; BPY='PYTHON...' with bpy
#   make proof    has three.js, Blender and usd-core evaluate what wiggly exports, and takes in files of others
#   make check    formatting, static analysis, include arrows, lengths
#   make figures  the paper's figures as SVG and CSV, in FIGURES (build/figures)
#   make feel     how curves answer to a knot that moves, and how far they overshoot, as a table; fails where poses or wind-up change too much
#   make adversary SEED=1 COUNT=2000    random splines meant to be hard, judged in quadruple precision; what is wrong is printed as a scene
#   make fuzz     every reader of files, and exports of what is read, for SECONDS=20 each, or RUNS=10000000 inputs each; SEED=1; needs clang
#   make regress BASE=path/to/other/wiggly    frame times of two builds on the committed session
#   make compile_commands.json    for clangd and other tools that read C
#   make install  PREFIX=/usr/local DESTDIR=
#   make install-library  the library alone, with nothing but a C compiler; PREFIX and DESTDIR as above
#   make clean
#   make help     this
#
# Variables: B (build folder), CC, DEBUG=1 (for a debugger, in build/debug), SANITIZE=1 (ASan and UBSan, in build/sanitize; with
# DEBUG=1 in build/debug-sanitize), WERROR=1 (warnings fail), V=1 (show commands).
# CPPFLAGS, CFLAGS, LDFLAGS and LDLIBS, from the command line or the environment, add to the project's own.

DEBUG ?=
SANITIZE ?=
WERROR ?=
V ?=
empty :=
VARIANT := $(subst $(empty) ,-,$(strip $(if $(DEBUG),debug) $(if $(SANITIZE),sanitize)))
B ?= build$(VARIANT:%=/%)
PREFIX ?= /usr/local
CC := $(if $(filter default,$(origin CC)),gcc,$(CC))
Q := $(if $(V),,@)

# make's targets cannot hold a space: a build folder whose name does is reached through a link.
ifneq ($(words $(B)),1)
override B := $(shell tools/link-build.sh "$(B)")
endif
# Root that installs from somebody else's clone (sudo make install) leaves nothing there: what is built already is installed
# as it stands, anything else is built elsewhere. BORROWED=yes installs what is built, whoever runs it.
ifneq ($(filter install install-library,$(MAKECMDGOALS)),)
INSTALL_FROM := $(shell tools/install-from.sh "$(B)")
BORROWED := $(filter borrowed,$(INSTALL_FROM))
override B := $(or $(filter-out borrowed,$(INSTALL_FROM)),$(B))
endif

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:
ifeq ($(MAKELEVEL),0)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 2)
endif

# --- what is there -----------------------------------------------------------------------------------------------------

VERSION := $(shell sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
MAJOR := $(firstword $(subst ., ,$(VERSION)))
SOURCES := $(sort $(shell find src -name '*.c' -not -path 'src/platform/web/*'))
LIBRARY_SOURCES := $(wildcard src/spline/*.c src/maths/*.c) src/base/status.c
EMBEDDED := LICENSE $(wildcard shaders/*.vert shaders/*.frag assets/scenes/tail.json \
    assets/scenes/figure*.json assets/scenes/dog.json assets/scenes/hands.json \
    assets/models/fox.glb)
TOOLS := $(filter-out adversary,$(basename $(notdir $(wildcard tools/*.c))))
MODEL_MAKERS := creature_obj dog_glb fox_glb
TOOL_PARTS := $(filter-out $(MODEL_MAKERS:%=tools/models/%.c),$(wildcard tools/*/*.c))
TESTS ?=
TEST_ROOMS := $(sort $(patsubst tests/%/,%,$(dir $(wildcard tests/*/test_*.c))))
TEST_SUPPORT := $(wildcard tests/*.c)

GENERATED := $(B)/generated
OBJECTS := $(SOURCES:%.c=$(B)/obj/%.o) $(B)/obj/src/model/draco.o $(B)/obj/build.o $(B)/obj/embedded_table.o $(B)/obj/embedded_data.o
LIBRARY_OBJECTS := $(LIBRARY_SOURCES:%.c=$(B)/obj/%.o)
SHARED_LIBRARY := $(B)/libwiggly.so.$(VERSION)
LIBRARIES := $(B)/libwiggly.a $(if $(findstring mingw,$(CC)),,$(SHARED_LIBRARY))
# FILE or FILE:CASE.
ifneq ($(filter test test-all,$(MAKECMDGOALS)),)
CHOSEN_TESTS := $(shell $(if $(filter test-all,$(MAKECMDGOALS)),THOROUGH=1) tools/find-tests.sh $(TESTS))
$(if $(filter-out 0,$(.SHELLSTATUS)),$(error see CONTRIBUTING.md, "Build and test"))
endif

# --- how it is built ---------------------------------------------------------------------------------------------------
# pkg-config may be installed by this very run, so it is asked when the first recipe needs it, and only once.

PACKAGES := glfw3 epoxy egl jansson cglm stb
PKG_CFLAGS = $(eval PKG_CFLAGS := $(patsubst -I%,-isystem %,$(shell pkg-config --cflags $(PACKAGES))))$(PKG_CFLAGS)
PKG_LIBS = $(eval PKG_LIBS := $(shell pkg-config --libs glfw3 epoxy egl jansson))$(PKG_LIBS)
# Nor are libraries that wiggly does without: -D for what is there, and how to link it. CODECS= builds without them.
CODECS = $(eval CODECS := $(shell tools/find-codecs.sh "$(CC)"))$(CODECS)

# No fused multiply-add and no -ffast-math anywhere: a scene gives the same bits at every optimisation level, number of threads
# and width of vectors, on every machine: of libm only what is exactly rounded is used (src/maths has the rest).
comma := ,
OPTIMISE := $(if $(DEBUG),-O0 -g3,$(if $(SANITIZE),-O1,-O2) -g1) $(if $(SANITIZE),-fno-omit-frame-pointer)
SANITIZERS := $(if $(SANITIZE),-fsanitize=address$(comma)undefined -fno-sanitize-recover=all) \
    $(if $(FUZZ),-fsanitize=fuzzer-no-link$(comma)float-cast-overflow)
WARNINGS := -Wall -Wextra -Wshadow -Wconversion -Wcast-qual $(if $(WERROR),-Werror)
ERRORS := -Werror=implicit-function-declaration -Werror=implicit-int -Werror=int-conversion \
    -Werror=incompatible-pointer-types
OWN_CPPFLAGS := -Isrc -Iinclude -D_GNU_SOURCE
OWN_CFLAGS := $(OPTIMISE) $(WARNINGS)
# After the user's flags: what the code is written for, and what its results depend on.
FIXED_CFLAGS := -std=c11 -fno-fast-math -ffp-contract=off -fPIC -fno-semantic-interposition $(ERRORS) $(SANITIZERS)
# The folder of the clone is not in what is built, so that any two build the same bytes; only a debugger is told it.
PLACE := $(if $(DEBUG),,'-ffile-prefix-map=$(subst ','\'',$(CURDIR))=.')
SPLINE_CFLAGS := $(if $(VARIANT),,-O3 -fno-math-errno -fno-trapping-math)

# src/timing/allocations.c counts what our own objects allocate, src/model/draco.cpp limits what Draco allocates.
WRAPPED := malloc calloc realloc strdup _Znwm _Znam
OWN_LDFLAGS := $(SANITIZERS) -Wl,--as-needed $(WRAPPED:%=-Wl,--wrap=%)
LIBS = $(PKG_LIBS) $(filter-out -D%,$(CODECS)) -lm -ldl -lpthread $(LDLIBS)
TEST_LIBS = -lcmocka -llapacke -lopenblas -lquadmath

$(B)/obj/src/spline/%.o $(B)/obj/src/maths/%.o: OWN_CFLAGS += $(filter -O%,$(SPLINE_CFLAGS))
$(B)/obj/src/spline/%.o $(B)/obj/src/maths/%.o: FIXED_CFLAGS += $(filter -f%,$(SPLINE_CFLAGS))
# The library is made of the objects that the app is made of: fit for a shared one, machine code whatever CFLAGS say (names are
# taken out of it), and without a package.
$(LIBRARY_OBJECTS): FIXED_CFLAGS += -fno-lto
$(LIBRARY_OBJECTS): PKG_CFLAGS :=

COMPILE = $(CC) $(OWN_CPPFLAGS) $(PKG_CFLAGS) $(CPPFLAGS) $(OWN_CFLAGS) $(CFLAGS) $(FIXED_CFLAGS) $(PLACE)
OBJCOPY ?= $(shell $(CC) -print-prog-name=objcopy)
LINK = $(CC) $(OWN_LDFLAGS) $(CFLAGS) $(LDFLAGS)

# --- goals -------------------------------------------------------------------------------------------------------------

.PHONY: all library run test test-all check clean help packages compile_commands.json FORCE

all: $(B)/wiggly $(LIBRARIES) $(TOOLS:%=$(B)/%) $(MODEL_MAKERS:%=$(B)/%)

library: $(LIBRARIES)

# The app itself finds out whether it has a display; however it ran, it leaves its log and its last picture.
LIVE_OUT ?= $(B)
LIVE_LOG := $(LIVE_OUT)/live.csv
LIVE_PICTURE := $(LIVE_OUT)/live.png
run: $(B)/wiggly
	$(Q)rm -f $(LIVE_LOG) $(LIVE_PICTURE)
	$(Q)$(B)/wiggly live --log $(LIVE_LOG) --screenshot $(LIVE_PICTURE) $(ARGS)
	$(Q)[ ! -s $(LIVE_PICTURE) ] || echo "Picture: $(LIVE_PICTURE), timing log: $(LIVE_LOG)"

test: $(B)/wiggly $(LIBRARIES) $(TOOLS:%=$(B)/%) $(MODEL_MAKERS:%=$(B)/%) \
    $(patsubst tests/%/,$(B)/tests/%,$(sort $(foreach test,$(CHOSEN_TESTS),$(if $(findstring .c,$(test)),$(dir $(test))))))
	$(Q)B=$(B) WIGGLY=$(B)/wiggly TEST_OUT=$(B)/test-out CC="$(CC)" tools/run-tests.sh $(CHOSEN_TESTS)

test-all: export THOROUGH = 1
test-all: test

check: | packages
	$(Q)tools/check.sh

# What make would run to compile everything anew.
compile_commands.json: | packages
	$(Q)$(MAKE) --no-print-directory --dry-run --always-make V=1 B=$(B) all $(TEST_ROOMS:%=$(B)/tests/%) | tools/compile-commands.sh > $@

help:
	@sed -n '1,/^$$/s/^# \{0,1\}//p' Makefile

clean:
	rm -rf "$(realpath $(B))" $(B)

# --- what must be installed first --------------------------------------------------------------------------------------
# Everything that is compiled waits for `packages` (order-only); it asks for no more than the goals at hand need.

SETS := $(if $(filter-out check clean help library install-library web npm wheel blender %/libwiggly.a,$(or $(MAKECMDGOALS),all)),build)
SETS += $(if $(filter test test-all $(B)/tests/%,$(MAKECMDGOALS)),test) $(filter bench check,$(MAKECMDGOALS)) $(filter web,$(MAKECMDGOALS))
packages:
	$(Q)tools/install-missing.sh $(SETS)
	$(if $(filter build,$(SETS)),$(Q)tools/check-system.sh "$(CC)" $(PACKAGES))

# --- objects and programs ----------------------------------------------------------------------------------------------

$(B)/obj/%.o: %.c $(B)/flags | packages
	@mkdir -p $(@D)
	$(if $(Q),@echo "CC $<")
	$(Q)$(COMPILE) -MMD -MP -c $< -o $@

$(B)/obj/src/model/glb.o: OWN_CPPFLAGS += $(filter -D%,$(CODECS))
$(B)/obj/src/model/glb.o: $(B)/codecs
# By the C compiler's own C++, so that it takes the same flags; without Draco it is empty. UBSan's runtime for C++ is not linked.
$(B)/obj/src/model/draco.o: src/model/draco.cpp src/model/draco.h $(B)/flags $(B)/codecs | packages
	@mkdir -p $(@D)
	$(if $(Q),@echo "CC $<")
	$(Q)$(CC) $(if $(filter -DWITH_DRACO,$(CODECS)),-x c++ -std=c++17 $(OWN_CPPFLAGS) $(CPPFLAGS) -Wall -Wextra $(filter -Werror,$(WARNINGS)),-x c) \
	    $(OPTIMISE) $(CFLAGS) -fPIC $(PLACE) $(SANITIZERS) $(if $(SANITIZE),-fno-sanitize=undefined) -c $(if $(filter -DWITH_DRACO,$(CODECS)),$<,/dev/null) -o $@

$(B)/obj/%.o: $(GENERATED)/%.c $(B)/flags | packages
	@mkdir -p $(@D)
	$(Q)$(COMPILE) -MMD -MP -c $< -o $@

$(B)/obj/%.o: $(GENERATED)/%.S | packages
	@mkdir -p $(@D)
	$(Q)$(CC) -c $< -o $@

# One object, from which no name leaves but those of its headers.
$(B)/obj/libwiggly.o: $(LIBRARY_OBJECTS) $(B)/objects | packages
	$(Q)$(CC) $(filter -m%,$(CFLAGS)) -nostdlib -r $(LIBRARY_OBJECTS) -o $@
	$(Q)$(OBJCOPY) --wildcard --keep-global-symbol='wiggly_*' $@

$(B)/libwiggly.a: $(B)/obj/libwiggly.o
	$(Q)rm -f $@ && ar rcs $@ $<

$(SHARED_LIBRARY): $(B)/obj/libwiggly.o
	$(Q)$(CC) -shared -Wl,-soname,libwiggly.so.$(MAJOR) -Wl,-z,defs $(SANITIZERS) $(CFLAGS) $(LDFLAGS) $< -lm -lpthread $(LDLIBS) -o $@

# Everything but main(): the app and the tools link it as an archive, the tests as one shared library, which makes each of them small.
PARTS := $(filter-out $(B)/obj/src/main.o,$(OBJECTS))
$(B)/parts.a: $(PARTS) $(B)/objects | packages
	$(Q)rm -f $@ && ar rcs $@ $(filter %.o,$^)

$(B)/tests/libparts.so: $(PARTS) $(TOOL_PARTS:%.c=$(B)/obj/%.o) $(TEST_SUPPORT:%.c=$(B)/obj/%.o) $(B)/objects | packages
	@mkdir -p $(@D)
	$(Q)$(LINK) -shared $(filter %.o,$^) $(TEST_LIBS) $(LIBS) -o $@

$(B)/wiggly: $(B)/obj/src/main.o $(B)/parts.a
	$(if $(Q),@echo "LINK $@")
	$(Q)$(LINK) $^ $(LIBS) -o $@

# What tools are made of besides, each in a folder of tools; tests see that too.
$(B)/obj/tools/%.o: private OWN_CPPFLAGS += -Itools
$(B)/tools.a: $(TOOL_PARTS:%.c=$(B)/obj/%.o)
	$(Q)rm -f $@ && ar rcs $@ $^

$(TOOLS:%=$(B)/%): $(B)/%: $(B)/obj/tools/%.o $(B)/tools.a $(B)/parts.a
	$(Q)$(LINK) $^ $(LIBS) -o $@

# Private: else it would be in the flags of all that a test is made of, where a test is what make is asked for.
$(B)/obj/tests/%.o: private OWN_CPPFLAGS += -Itests -Itools
# A test runs once for each time that it is compiled.
$(TEST_ROOMS:%=$(B)/obj/tests/%/test_%.o): private OWN_CFLAGS += -O0
define TEST_ROOM
$(B)/tests/$(1): $(patsubst %.c,$(B)/obj/%.o,$(wildcard tests/$(1)/test_*.c))
endef
$(foreach room,$(TEST_ROOMS),$(eval $(call TEST_ROOM,$(room))))
$(TEST_ROOMS:%=$(B)/tests/%): $(B)/tests/libparts.so
	$(Q)$(LINK) $^ -Wl,-rpath,'$$ORIGIN' $(TEST_LIBS) $(LIBS) -o $@

# --- generated ---------------------------------------------------------------------------------------------------------

$(GENERATED)/embedded_data.S $(GENERATED)/embedded_table.c &: tools/embed.sh $(EMBEDDED) $(B)/embedded $(B)/parts.txt | packages
	@mkdir -p $(@D)
	$(Q)tools/embed.sh $(GENERATED) $(B)/parts.txt $(EMBEDDED)

# Rewritten only when the text changes, so that what depends on it is rebuilt just then. Tests that call make do it at the same time.
replace = @mkdir -p $(@D); printf '%s\n' '$(1)' > $@.$$$$; cmp -s $@.$$$$ $@ && rm $@.$$$$ || mv $@.$$$$ $@
$(B)/flags: FORCE
	$(call replace,$(CC) $(OWN_CPPFLAGS) $(CPPFLAGS) $(OWN_CFLAGS) $(CFLAGS) $(FIXED_CFLAGS) $(SPLINE_CFLAGS))
$(B)/codecs: FORCE | packages
	$(call replace,$(CODECS))
$(B)/objects: FORCE
	$(call replace,$(OBJECTS))
$(B)/embedded: FORCE
	$(call replace,$(EMBEDDED))
$(B)/parts.txt: FORCE | packages
	@mkdir -p $(@D); tools/find-parts.sh $(if $(filter -DWITH_DRACO,$(CODECS)),draco) > $@.$$$$ && { cmp -s $@.$$$$ $@ && rm $@.$$$$ || mv $@.$$$$ $@; }
$(GENERATED)/build.c: FORCE | packages
	@tools/build-info.sh $@ "$(CC)" "$(filter -O% -f% -m%,$(OWN_CFLAGS) $(CFLAGS) $(FIXED_CFLAGS))$(if $(SPLINE_CFLAGS),; spline $(SPLINE_CFLAGS))"

# --- what is not built every day ----------------------------------------------------------------------------------------

include tools/package.mk tools/measure.mk src/platform/web/web.mk tools/models/models.mk

.SECONDARY:
-include $(shell find $(B)/obj -name "*.d" 2>/dev/null)
