# make install, install-library, wheel, npm and blender: what others install, and packages of it.

.PHONY: install install-library wheel npm blender blender-proof

wheel:
	$(Q)python/wheels.sh $(B) $(PLATFORMS)

npm:
	$(Q)npm/build.sh $(B)

# The platforms that Blender runs on.
blender: PLATFORMS ?= manylinux_2_17_x86_64 win_amd64 macosx_11_0_x86_64 macosx_11_0_arm64
blender: wheel
	$(Q)tools/pack-blender.sh $(B) $(VERSION) $(PLATFORMS)

# Each Blender that there is as a Python module: those of $(BPY), Pythons that have it.
BPY ?= $(B)/proof/venv/bin/python
blender-proof: library
	$(Q)PYTHONPATH=python/src WIGGLY_LIBRARY=$(abspath $(SHARED_LIBRARY)) python3 blender/tests/table.py tests/README.md $(BPY)

ROOT = $(DESTDIR)$(PREFIX)
define PLACE_LIBRARY
	install -d "$(ROOT)/lib/pkgconfig" "$(ROOT)/lib/cmake/wiggly" "$(ROOT)/include/wiggly"
	install -m 644 $(B)/libwiggly.a "$(ROOT)/lib/libwiggly.a"
	$(if $(filter $(SHARED_LIBRARY),$(LIBRARIES)),install -m 755 $(SHARED_LIBRARY) "$(ROOT)/lib" && \
	    ln -sf libwiggly.so.$(VERSION) "$(ROOT)/lib/libwiggly.so.$(MAJOR)" && ln -sf libwiggly.so.$(MAJOR) "$(ROOT)/lib/libwiggly.so")
	install -m 644 include/wiggly/wiggly.h include/wiggly/more.h "$(ROOT)/include/wiggly"
	sed -e 's|@VERSION@|$(VERSION)|' wiggly.pc.in > "$(ROOT)/lib/pkgconfig/wiggly.pc"
	$(Q)for file in assets/cmake/*.in; do \
	    name=$${file##*/}; sed -e 's|@VERSION@|$(VERSION)|; s|@MAJOR@|$(MAJOR)|' $$file > "$(ROOT)/lib/cmake/wiggly/$${name%.in}"; \
	done
	chmod 644 "$(ROOT)/lib/pkgconfig/wiggly.pc" "$(ROOT)"/lib/cmake/wiggly/*
	$(Q)[ -n "$(DESTDIR)" ] || [ "$$(id -u)" != 0 ] || ldconfig
endef

install-library: $(if $(BORROWED),,$(LIBRARIES))
	$(PLACE_LIBRARY)
	$(Q)tools/install-from.sh --done $(B)

install: $(if $(BORROWED),,$(B)/wiggly $(LIBRARIES))
	$(PLACE_LIBRARY)
	install -d "$(ROOT)/bin" "$(ROOT)/share/wiggly/scenes" "$(ROOT)/share/wiggly/models" "$(ROOT)/share/doc/wiggly" \
	    "$(ROOT)/share/man/man1" "$(ROOT)/share/applications" "$(ROOT)/share/icons/hicolor/scalable/apps"
	install -m 755 $(B)/wiggly "$(ROOT)/bin/wiggly"
	install -m 644 $(wildcard assets/scenes/*.json) "$(ROOT)/share/wiggly/scenes"
	install -m 644 $(wildcard assets/models/*.glb) "$(ROOT)/share/wiggly/models"
	$(B)/wiggly --licenses > "$(ROOT)/share/doc/wiggly/copyright"
	install -m 644 assets/desktop/wiggly.desktop "$(ROOT)/share/applications"
	install -m 644 assets/desktop/wiggly.svg "$(ROOT)/share/icons/hicolor/scalable/apps"
	tools/man-page.sh $(B)/wiggly > "$(ROOT)/share/man/man1/wiggly.1"
	chmod 644 "$(ROOT)/share/doc/wiggly/copyright" "$(ROOT)/share/man/man1/wiggly.1"
	$(Q)tools/install-from.sh --done $(B)
