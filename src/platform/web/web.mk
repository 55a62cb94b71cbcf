# make web: the app as a page, in $(B)/web, made by Emscripten. What CFLAGS, CPPFLAGS and LDFLAGS say is for gcc, so they do not count here.

WASM := $(B)/wasm
EMCC ?= emcc
# Its clang with its flags, asked for once: emcc takes longer to start than most files take to compile.
WEB_CC = $(eval WEB_CC := $(shell tools/web-compiler.sh "$(EMCC)"))$(WEB_CC)
WEB_SOURCES := $(filter-out src/platform/% src/timing/allocations.c,$(SOURCES)) src/platform/events.c $(wildcard src/platform/web/*.c)
JANSSON ?= $(WASM)/jansson
WEB_OBJECTS := $(WEB_SOURCES:%.c=$(WASM)/%.o) \
    $(patsubst %,$(WASM)/jansson-%.o,dump error hashtable hashtable_seed load memory pack_unpack strbuffer strconv utf value version) \
    $(addprefix $(WASM)/generated/,build.o embedded_table.o embedded_data.o)

# SSE2 as on x86-64, and as -msse2 means to emcc: cglm adds in another order without it.
WEB_CFLAGS := -Os -msimd128 -D__SSE__=1 -D__SSE2__=1 $(WARNINGS) $(filter-out -fPIC -fno-semantic-interposition -fsanitize% -fno-sanitize%,$(FIXED_CFLAGS))
WEB_CPPFLAGS = $(OWN_CPPFLAGS) -isystem src/platform/web -isystem $(WASM)/include -isystem $(JANSSON)/src
JANSSON_CFLAGS := -w -DHAVE_UNISTD_H -DHAVE_STDINT_H -Dutf8_encode=jansson_utf8_encode# which is a name of ours
WEB_LDFLAGS := -Os -lnodefs.js -sMIN_WEBGL_VERSION=2 -sMAX_WEBGL_VERSION=2 -sALLOW_MEMORY_GROWTH=1 -sINITIAL_MEMORY=64MB \
    -sENVIRONMENT=web,node -sMODULARIZE=1 -sEXPORT_NAME=createWiggly -sEXPORTED_RUNTIME_METHODS=FS,callMain,allocateUTF8 -sINVOKE_RUN=0
WEB_FILES := $(wildcard $(addprefix src/platform/web/,*.html *.js *.json)) assets/desktop/wiggly.svg
WEB_PAGE := $(addprefix $(B)/web/,$(filter-out sw.js,$(notdir $(WEB_FILES))) wiggly.js)

.PHONY: web
web: $(WEB_PAGE) $(B)/web/sw.js $(addprefix $(B)/web/models/,dog.glb creature.glb)
	@echo "Page: $(B)/web/index.html"

$(WASM)/src/spline/%.o $(WASM)/src/maths/%.o: private WEB_CFLAGS += $(SPLINE_CFLAGS)
$(WASM)/%.o: %.c $(WASM)/flags | $(WASM)/ready
	@mkdir -p $(@D)
	$(if $(Q),@echo "EMCC $<")
	$(Q)$(WEB_CC) $(WEB_CPPFLAGS) $(WEB_CFLAGS) -MMD -MP -c $< -o $@
$(WASM)/jansson-%.o: $(WASM)/flags | $(WASM)/ready
	$(Q)$(WEB_CC) $(WEB_CPPFLAGS) $(WEB_CFLAGS) $(JANSSON_CFLAGS) -c $(JANSSON)/src/$*.c -o $@
$(WASM)/generated/%.o: $(WASM)/generated/%.c $(WASM)/flags | $(WASM)/ready
	$(Q)$(WEB_CC) $(WEB_CPPFLAGS) $(WEB_CFLAGS) -c $< -o $@
$(WASM)/generated/%.o: $(WASM)/generated/%.S | $(WASM)/ready
	$(Q)$(WEB_CC) -c $< -o $@

# Debian keeps node's modules where only its own node looks for them.
$(B)/web/wiggly.js: $(WEB_OBJECTS) $(WASM)/flags
	@mkdir -p $(@D)
	$(if $(Q),@echo "LINK $@")
	$(Q)NODE_PATH=/usr/share/nodejs:$$NODE_PATH $(EMCC) $(WEB_LDFLAGS) $(WEB_OBJECTS) -o $@

# The worker names the files that it keeps, and a version that changes when they do.
$(B)/web/sw.js: src/platform/web/sw.js $(WEB_PAGE)
	$(Q)version=$$(cat $^ $(B)/web/wiggly.wasm | sha256sum | cut -c 1-16); \
	sed "s/@VERSION@/$$version/; s|@FILES@|$(WEB_PAGE:$(B)/web/%=%) wiggly.wasm|" $< > $@
$(B)/web/%: src/platform/web/%
	@mkdir -p $(@D)
	$(Q)cp $< $@
$(B)/web/models/%: assets/models/%
	@mkdir -p $(@D)
	$(Q)cp $< $@
$(B)/web/%.svg: assets/desktop/%.svg
	@mkdir -p $(@D)
	$(Q)cp $< $@

# What must be there before anything is compiled: the compiler, jansson, and headers that are not beside the C library's.
$(WASM)/ready: | packages
	@mkdir -p $(WASM)/include
	$(Q)for module in cglm stb; do ln -sfn "$$(pkg-config --variable=includedir $$module | sed "s|/$$module\$$||")/$$module" $(WASM)/include; done
	$(Q)[ -e $(JANSSON)/src/jansson.h ] || tools/web-jansson.sh $(JANSSON)
	$(Q): > $(WASM)/include/jansson_private_config.h; sed 's/@json_inline@/inline/; s/@json_.*@/1/' $(JANSSON)/src/jansson_config.h.in > $(WASM)/include/jansson_config.h
	@touch $@
$(WASM)/flags: FORCE
	$(call replace,$(EMCC) $(JANSSON) $(WEB_CPPFLAGS) $(WEB_CFLAGS) $(SPLINE_CFLAGS) $(JANSSON_CFLAGS) $(WEB_LDFLAGS) $(WEB_OBJECTS))

# The same files as in the program, but of fonts only what is drawn.
$(WASM)/parts.txt: FORCE | packages
	@mkdir -p $(@D); tools/find-parts.sh > $@.$$$$ && { cmp -s $@.$$$$ $@ && rm $@.$$$$ || mv $@.$$$$ $@; }
$(WASM)/fonts.txt: $(WASM)/parts.txt src/ui/font.c tools/web-fonts.sh
	$(Q)tools/web-fonts.sh $(WASM) < $< > $@
$(WASM)/generated/embedded_data.S $(WASM)/generated/embedded_table.c &: tools/embed.sh $(EMBEDDED) $(B)/embedded $(WASM)/fonts.txt
	@mkdir -p $(@D)
	$(Q)tools/embed.sh $(@D) $(WASM)/fonts.txt $(EMBEDDED)
$(WASM)/generated/build.c: FORCE | packages
	@tools/build-info.sh $@ "$(EMCC)" "$(filter -O% -f% -m%,$(WEB_CFLAGS)); spline $(SPLINE_CFLAGS)"

-include $(shell find $(WASM) -name "*.d" 2>/dev/null)
