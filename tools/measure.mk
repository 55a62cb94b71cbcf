# make bench, feel, adversary, figures, regress, fuzz and proof: how fast, how good and how safe it is.

.PHONY: bench feel adversary figures regress fuzz fuzzer proof

bench: $(B)/wiggly-bench
	$(Q)$< $(ARGS)

feel: $(B)/feel
	$(Q)$<

COUNT ?= 2000
adversary: $(B)/adversary
	$(Q)$< $(SEED) $(COUNT) $(JOBS)

# It judges by the tests' textbook, which not every machine can build.
$(B)/obj/tools/adversary.o: private OWN_CPPFLAGS += -Itests
$(B)/adversary: $(B)/obj/tools/adversary.o $(patsubst %.c,$(B)/obj/%.o,$(wildcard tests/adversary*.c tests/textbook*.c)) $(B)/parts.a
	$(Q)$(LINK) $^ -lquadmath $(LIBS) -o $@

# Programs of others evaluate every file that wiggly writes; fetched into the build folder.
proof: $(B)/wiggly
	$(Q)B=$(B) WIGGLY=$(B)/wiggly tests/others/proof.sh && B=$(B) WIGGLY=$(B)/wiggly tests/others/strangers.sh

FIGURES ?= $(B)/figures
figures: $(B)/paper_figures
	$(Q)mkdir -p $(FIGURES) && $< $(FIGURES) && echo "Figures: $(FIGURES)"

regress: $(B)/wiggly $(B)/timing_diff
	$(Q)$(if $(BASE),,echo "make regress: BASE=path/to/other/wiggly is missing" >&2; exit 2;) \
	tools/regress.sh "$(BASE)" $(B)/wiggly $(B)/timing_diff $(B)/regress

# Objects of their own, for clang's fuzzer and both sanitizers.
SECONDS ?= 20
SEED ?= 1
fuzz: fuzzer
	$(Q)SECONDS_EACH=$(SECONDS) RUNS=$(RUNS) SEED=$(SEED) tests/fuzz/run.sh $(B)/fuzz

fuzzer:
	$(Q)tools/install-missing.sh build clang
	$(Q)$(MAKE) --no-print-directory CC=$(if $(findstring clang,$(CC)),$(CC),clang) SANITIZE=1 FUZZ=1 B=$(B)/fuzz $(B)/fuzz/fuzzer

# Of the sources only what readers and exports need, and no GL.
FUZZED := $(wildcard src/base/*.c src/maths/*.c src/spline/*.c src/scene/*.c src/model/*.c) src/ui/event.c src/ui/theme.c \
    $(addprefix src/app/,replay.c settings.c) src/timing/framelog.c tools/regress/log.c \
    $(wildcard src/rig/*.c src/export/*.c src/simulation/*.c) src/draw/posed.c src/commands/companion.c $(wildcard tests/fuzz/*.c)
$(B)/fuzzer: $(FUZZED:%.c=$(B)/obj/%.o) $(B)/obj/src/model/draco.o $(B)/obj/build.o $(B)/obj/embedded_table.o $(B)/obj/embedded_data.o
	$(Q)$(CC) -fsanitize=fuzzer$(comma)address$(comma)undefined -Wl,--as-needed -Wl,--wrap=_Znwm -Wl,--wrap=_Znam $^ $(LIBS) -o $@
