# What a stranger runs and what CI runs are the same commands.

.PHONY: reproduce test library thorough attack proofs mutants lint kernels renderers page docs python formats engines gallery flint bench setup
.DEFAULT_GOAL := reproduce

# The main job: the paper's tables, measured again, and what lies beyond them; the report goes to reproduction/.
reproduce: setup
	cargo run --locked --quiet -- reproduce --out reproduction
	cargo run --locked --quiet -- reproduce --nonsmooth --out reproduction

test: setup
	cargo test --locked

# The library without the program, as a dependency of a crate that tests its own ray marcher.
library: setup
	cargo test --locked --package as-a-test

# What takes minutes and finds little: docs/contributing.md lists it with the reasons.
thorough: setup
	cargo test --locked -- --ignored

# Random media, identities and scenes whose truth is known by another route: docs/trust.md has the figures.
attack: setup
	cargo test --locked --test orders attack -- --include-ignored --nocapture
	cargo test --locked --test cases truths -- --include-ignored --nocapture
	cargo test --locked --test studies no_smooth_scene_is_refused -- --nocapture

# Checked by Coq; installs Debian's packages where they are missing. The cases are those that the program writes now.
proofs: setup
	rm -rf target/proofs
	cargo run --locked --quiet -- prove --all --no-check --write target/proofs > /dev/null
	diff -r target/proofs proofs/cases
	proofs/check

# Statements altered one at a time, each of which has to fail; needs what proofs installs.
mutants:
	proofs/mutants/check

lint: setup
	cargo fmt --all --check
	cargo clippy --locked --workspace --all-targets -- -D warnings
	cargo clippy --locked --no-default-features --lib -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --no-deps

# volver verify, for real: the kernels of examples/kernels, VTK's among them, which it installs from PyPI under target/.
kernels: setup
	examples/kernels/check

# volver image, for real: a marcher in NumPy, and VTK's two mappers of volumes, which it installs from PyPI under target/.
renderers: setup
	examples/renderers/check

# The page of every --out directory, read in headless Chromium, which is Debian's package; installs it where it is missing.
page: setup
	tests/page/check

# The site of docs/ with its tutorials, whose code is run, read in headless Chromium; Sphinx comes from PyPI, under target/.
docs: setup
	docs/site/build
	tests/site/check

# The wheel and its package, in fresh environments of the oldest and the newest CPython that can be had.
python: setup
	python/check

# Files of volumes and pictures, read and written by VTK, ITK, pynrrd, OpenEXR, NumPy, OpenCV and Pillow, which come from PyPI.
formats: setup
	tests/formats/check

# Studies in shards by a real Slurm, Debian's, which it installs and starts on this machine as root, and a manifest of Kubernetes.
engines: setup
	tests/engines/check

# What public packages compute, each installed in an environment of its own; takes an hour, and is no part of CI.
gallery: setup
	gallery/run

# FLINT's functions: the same bits as MPFR's. FLINT is compiled, which takes minutes; installs what that needs.
flint: setup
	@command -v autoreconf libtoolize >/dev/null 2>&1 || { \
	  echo "installing autoconf, automake and libtool, which the build of FLINT needs"; \
	  $(SUDO) apt-get update -qq && $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq autoconf automake libtool; }
	cargo clippy --locked --all-targets --features flint -- -D warnings
	cargo test --locked --features flint --test numbers mpfr

bench: setup target/peers
	VOLVER_PYTHON=$(CURDIR)/target/peers/bin/python cargo bench --locked -p volver-benches

# What people would use instead, which benches run beside the library.
target/peers: benches/peers/requirements.txt
	python3 -m venv $@
	$@/bin/pip install --quiet -r $<
	touch $@

# GMP's build needs m4, which fresh machines lack.
SUDO := $(shell [ "$$(id -u)" -eq 0 ] || echo sudo)
setup:
	@command -v m4 >/dev/null 2>&1 || { \
	  echo "installing m4, which the build of GMP needs"; \
	  if command -v apt-get >/dev/null 2>&1; then \
	    $(SUDO) apt-get update -qq && $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq m4; \
	  elif command -v dnf >/dev/null 2>&1; then $(SUDO) dnf install -y -q m4; \
	  elif command -v brew >/dev/null 2>&1; then brew install --quiet m4; \
	  else echo "m4 is missing (allowed: any way to install it; apt-get, dnf and brew are known here)" >&2; exit 2; \
	  fi; }
