# Everything a fresh machine needs beyond python3, pip, git and make is set up here.
.PHONY: demo test check docs bench lock clean
.DEFAULT_GOAL := demo

TOOLS := .tools
UV    := PYTHONPATH=$(TOOLS) $(TOOLS)/bin/uv
READY := .venv/.ready
BIN   := .venv/bin
DESIGN ?= examples/gonzalez-fuentes-2022.toml

$(TOOLS)/bin/uv:
	python3 -m pip install --quiet --target $(TOOLS) uv

# Libraries are compiled to bytecode once, not at every start where the environment forbids Python to keep it.
$(READY): pyproject.toml uv.lock | $(TOOLS)/bin/uv
	$(UV) sync --frozen --quiet --compile-bytecode
	@touch $@

# The CAD kernel (400 MB) is for those who test or write STEP.
CAD := .venv/.cad
$(CAD): $(READY)
	$(UV) sync --frozen --quiet --compile-bytecode --extra cad
	@touch $@

# Status 1 of a command means: computed, and the design has a fault that the message names.
demo: $(READY)
	@$(BIN)/hypoid report $(DESIGN) -o report.html || [ $$? -eq 1 ]
	@echo "The report is $(CURDIR)/report.html: open it in any browser."

test: check docs

check: $(CAD)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/pyright --pythonpath $(BIN)/python
	$(BIN)/lint-imports
	OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n auto --dist loadfile

docs: $(READY)
	$(BIN)/sphinx-build -W --keep-going -b html docs docs/_build/html

bench: $(READY)
	$(BIN)/pytest benchmarks

lock: | $(TOOLS)/bin/uv
	$(UV) lock

clean:
	rm -rf $(TOOLS) .venv docs/_build report.html
