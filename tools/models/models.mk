# make models: the generated characters, in $(B)/models. README.md says how they become those of assets/models.

.PHONY: models
models: $(addprefix $(B)/models/,creature.obj dog.glb fox.glb)
$(B)/models/%.obj: $(B)/%_obj
	@mkdir -p $(@D)
	$(Q)$< $@
$(B)/models/%.glb: $(B)/%_glb
	@mkdir -p $(@D)
	$(Q)$< $@

$(MODEL_MAKERS:%=$(B)/%): $(B)/%: $(B)/obj/tools/models/%.o $(B)/tools.a $(B)/parts.a
	$(Q)$(LINK) $^ $(LIBS) -o $@
