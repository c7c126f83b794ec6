# The way in. `make help` tells what there is; `make all PROFILE=reduced` makes the whole experiment.
#
# Two steps: CMake builds the programs, then BUILD/release/bin/hbr cuts the profile into one slice per stage, finds
# by content what is not as it should be, and calls make again with the plan of just that (OUT/.plan/plan.mk).
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
MAKEFLAGS += --no-builtin-rules --no-print-directory
.DEFAULT_GOAL := help

# What a user gives is a text: no $ in it is make's, and recipes find it in their environment as GIVEN_OUT and so on,
# where no quote in it is the shell's. (Under names of their own: another make that a recipe starts would heed OUT.)
given := PROFILE OUT BUILD THREADS LAUNCH RETRY GROUP DEPS REP BENCH URDF MESHES POSE MNIST_DIR FORMAT STAGE TO A B \
  PREFIX HBR_ARCH WERROR UNITY CXX SANITIZER TESTS SECONDS READER FILES COUNT SEED COMPILERS OBJECTS TARGETS LINKED \
  RELEASES SAME CASES MIRROR
# tcsh tells everyone the user's group by this name.
ifneq ($(filter environment%,$(origin GROUP)),)
override GROUP := 0
endif
$(foreach name,$(given),$(if $(filter-out undefined default,$(origin $(name))),\
  $(eval override $(name) := $$(value $(name)))))

# Any other variable on the command line is a slip, and what it was meant for would be made otherwise in silence.
slips := $(filter-out $(given) MAKE% -%,$(foreach name,$(.VARIABLES),\
  $(if $(findstring command line,$(origin $(name))),$(name))))
flags := $(firstword $(filter CXXFLAGS LDFLAGS,$(slips)))
$(if $(flags),$(error $(flags) is heeded where it is in the environment; write it before make: $(flags)='$(value $(flags))' make))
$(if $(slips),$(error there is no variable '$(firstword $(slips))'; there are $(given) (`make help`)))

empty :=
space := $(empty) $(empty)
define newline


endef
# One word of a recipe, whatever is in it, and a word for each of several.
quoted = '$(subst ','\'',$(1))'
several = $(foreach one,$(1),$(call quoted,$(one)))
PROFILE ?= paper
# Its file's name, without folder and ending; a space in it is no end of a word.
OUT ?= out/$(subst <space>,$(space),$(patsubst %.toml,%,$(notdir $(subst $(space),<space>,$(PROFILE)))))
BUILD ?= build
HBR_ARCH ?= native
WERROR ?=
UNITY ?= 1
THREADS ?= 0
LAUNCH ?=
RETRY ?= 0
GROUP ?= 0
DEPS ?= auto
REP ?=
BENCH ?=
URDF ?=
MESHES ?=
POSE ?=
FORMAT ?=
STAGE ?=
TO ?= $(OUT)/export
A ?=
B ?=
PREFIX ?= /usr/local
SANITIZER ?= address
TESTS ?=
SECONDS ?= 60
READER ?=
FILES ?= pipeline models
COUNT ?= 60
SEED ?= 1
$(foreach name,$(given),$(eval export GIVEN_$(name) = $$($(name))))
export MNIST_DIR

targets := help deps build data all keys test bench test-cluster sanitize fuzz mutate coverage format check-format status audit graph reference \
  figures verify export compare robot install check-targets check-odr check-releases check-bytes clean distclean
# Every other goal is a stage, or a family of stages.
stages := $(filter-out $(targets),$(MAKECMDGOALS))
goals := $(filter all,$(MAKECMDGOALS)) $(stages)
dry := $(findstring n,$(filter-out -%,$(firstword $(MAKEFLAGS))))

# What can't be handed on as it is meant is refused here, in one line.
odd := ' " ` $$ ; & | < > { } [ ] * ? ! \ ~ : % = \# ( ) ,
refuse_if = $(if $(1),$(error $(2)))
$(foreach letter,$(odd),$(call refuse_if,$(findstring $(letter),$(stages)),no stage has a $(letter) in its name: '$(stages)'))
# A / stands between a variation and its stage, and nowhere else.
paths := $(strip $(filter /% ../% $(BUILD)/%,$(stages)) $(foreach goal,$(stages),$(if $(word 3,$(subst /, ,$(goal))),$(goal))))
$(call refuse_if,$(paths),'$(firstword $(paths))' is a path: goals are stages and what `make help` lists; `make build` makes the programs)
$(foreach letter,$(odd),$(call refuse_if,$(findstring $(letter),$(BUILD)),BUILD is '$(BUILD)': the build folder may have no $(letter) in its path))
$(call refuse_if,$(word 2,$(BUILD)),BUILD is '$(BUILD)': the build folder may have no space in its path)
beyond_cmake := ; " \ \#
$(if $(filter-out help,$(or $(MAKECMDGOALS),help)),$(foreach letter,$(beyond_cmake),\
  $(call refuse_if,$(findstring $(letter),$(CURDIR)),CMake can not build in $(CURDIR): there is a $(letter) in this path)))
places := PROFILE OUT URDF MESHES MNIST_DIR FORMAT STAGE TO A B PREFIX
$(foreach name,$(given),$(call refuse_if,$(findstring $(newline),$($(name))),$(name) has a line break in it))
$(foreach name,WERROR UNITY,$(call refuse_if,$(filter-out 0 1,$($(name))),$(name) is '$($(name))'; expected 0 or 1))
$(foreach name,$(places),\
  $(call refuse_if,$(filter -%,$(firstword $($(name)))),$(name) is '$($(name))': write ./$($(name)))\
  $(call refuse_if,$(filter ~%,$(firstword $($(name)))),$(name) is '$($(name))': the shell did not replace the ~; write $$HOME))
$(foreach name,PROFILE OUT BUILD HBR_ARCH,$(call refuse_if,$(if $(strip $($(name))),,empty),$(name) is empty: leave it out for its default, or name one (`make help`)))

# For recipes: what must be a number, or may not be empty, or nothing would be done in silence.
whole = [[ $$GIVEN_$(1) =~ ^[0-9]{1,9}$$ ]] && ((10\#$$GIVEN_$(1) >= $(2))) || \
  { echo "$(1) is '$$GIVEN_$(1)'; expected a whole number from $(2)" >&2; exit 2; }
named = [[ $$GIVEN_$(1) = *[![:space:]]* ]] || \
  { echo '$(1) is empty: leave it out for its default, or name some (`make help`)' >&2; exit 2; }

programs := $(BUILD)/release/bin
arguments := --profile "$$GIVEN_PROFILE" --out "$$GIVEN_OUT" --threads "$$GIVEN_THREADS" --launch "$$GIVEN_LAUNCH" \
  --retry "$$GIVEN_RETRY" \
  $(if $(REP),--replication "$$GIVEN_REP")

.PHONY: $(targets) $(stages) experiment

help:
	@echo 'Experiments'
	@echo '  make all             the whole experiment; its report is OUT/report/index.html'
	@echo '  make STAGE           one stage (layer3_n10), or a family (layer3), and what it needs; REP=2: that replication;'
	@echo '                       VARIATION or VARIATION/STAGE: those of a variation of the profile'
	@echo '  make readings        combinations of readings against the paper (PROFILE=readings): OUT/readings.json'
	@echo '  make keys            every key of the profile: its value, what may be said, what it means'
	@echo '  make status          what is fresh, stale or missing, and why'
	@echo '  make audit           read every artifact again and compare it with its manifest'
	@echo '  make graph           OUT/graph.svg: the stages and what they hand on'
	@echo '  make verify          compare the finished run in OUT with reports/reference/NAME, NAME as in the profile'
	@echo '  make reference       keep the finished run in OUT as that reference'
	@echo '  make figures         the kept verdicts by the rules of reports/claims.toml, and from reports/reference the tables'
	@echo '                       and sentences of the READMEs (reports/kept_tables.toml)'
	@echo '  make compare A=out/one B=out/other   in what two runs differ, finished or not: OUT/index.html (here out/compare)'
	@echo '  make export          the repertoires of the run in OUT for FORMAT=pyribs (.csv) or FORMAT=qdax (.npy), below TO'
	@echo '                       (OUT/export); STAGE=layer4, REP=0: only these'
	@echo '  Add -n to see what would run, -jN to run N stage programs side by side, -k to go on after a failure.'
	@echo
	@echo 'Robots'
	@echo '  make robot URDF=FILE what a robot is: joints, mass, reach, what is odd; in OUT (here out/robot) a page on which'
	@echo '                       it turns and its joints move, a .glb, and pictures of it, of what its chains reach and'
	@echo '                       of the largest level, upright and leaning boards;'
	@echo '                       MESHES=folder: where its meshes are; POSE="JOINT=rad ...": how it stands'
	@echo
	@echo 'Building'
	@echo '  make deps, build, data   install what is missing; build the programs; fetch MNIST'
	@echo '  make install         the search and the layers for other programs (find_package(hbr)), below'
	@echo '                       PREFIX='"$$GIVEN_PREFIX"
	@echo '  make clean           remove BUILD; distclean: out/ and .cache/ (downloads), too'
	@echo
	@echo 'Tests and checks'
	@echo '  make test            build and run all tests'
	@echo '  make bench           build and run the benchmarks and keep their table; BENCH=regex: only those, only shown'
	@echo '  make sanitize        all tests with the address and undefined-behaviour sanitizers; SANITIZER=thread: races;'
	@echo '                       TESTS="pipeline/qd models/arm": only the tests of these folders'
	@echo '  make fuzz            each reader of foreign files for SECONDS=60 with libFuzzer; READER=urdf: only that'
	@echo '  make mutate          which of COUNT=60 small deliberate bugs in FILES="pipeline models" no test notices; SEED=1'
	@echo '  make coverage        all tests, and BUILD/coverage/html: which lines they reach'
	@echo '  make check-targets   compile everything for TARGETS by COMPILERS, warnings being errors; OBJECTS=regex: only these,'
	@echo '                       with UNITY=0 by the names of their files'
	@echo '  make check-odr       compile and link everything without optimisation, the linker comparing definitions;'
	@echo '                       LINKED="layer signature_built": only these programs'
	@echo '  make check-bytes     layers 1 to 3 by both compilers, for SAME: the same bytes?'
	@echo '  make check-releases  all of this on bare machines of the Debian releases RELEASES, as root (debootstrap);'
	@echo '                       MIRROR: where packages come from; WERROR=1: warnings are errors there, too'
	@echo '  make test-cluster    what becomes of a run when its Slurm cluster fails: a real one, on loopback; CASES=node_lost: only this'
	@echo '  make format          clang-format on all sources; check-format only tells'
	@echo
	@echo "PROFILE=$$GIVEN_PROFILE"'   a file.toml, or one of'
	@for profile in stages/profiles/*.toml; do \
	  name=$${profile##*/}; printf '  %-17s %s\n' "$${name%.toml}" "$$(sed -n 's/^# Costs: //p' $$profile)"; \
	done
	@echo "OUT=$$GIVEN_OUT"'   where artifacts go'
	@echo "BUILD=$$GIVEN_BUILD"'   where programs are built; with OUT elsewhere, too, the sources may be read-only'
	@echo "HBR_ARCH=$$GIVEN_HBR_ARCH"'   processors to build for (-march): this one, or x86-64-v3 and so on; CXX=clang++: another compiler'
	@echo "WERROR=$$GIVEN_WERROR"'   1: a warning stops the build, as CI has it'
	@echo "UNITY=$$GIVEN_UNITY"'   0: files are compiled one by one, for those who change a few and build again'
	@echo "THREADS=$$GIVEN_THREADS"'   threads of one stage program; 0: the processors, shared among the N of -jN'
	@echo "LAUNCH=$$GIVEN_LAUNCH"'   words before every stage program, as in LAUNCH="srun -n1 --quit-on-interrupt";'
	@echo '                     in single quotes they may use $$HBR_JOB, $$HBR_THREADS, $$HBR_MEMORY_MB and $$HBR_SECONDS'
	@echo "RETRY=$$GIVEN_RETRY"'   how often a stage is tried again that was killed, lost or crashed'
	@echo "GROUP=$$GIVEN_GROUP"'   seconds of short stages of one replication that are run by one LAUNCH; 0: each by its own'
	@echo '                     (heeded on the command line alone)'
	@echo "MNIST_DIR=$$MNIST_DIR"'   folder of the four MNIST files; without it they are downloaded'
	@echo "DEPS=$$GIVEN_DEPS"'   auto: install missing packages; manual: tell the command and stop; none: do not look'

# Set-up and build -----------------------------------------------------------------------------------------------

packages := $(BUILD)/.packages
deps: $(packages)
# Looked at again when the list or what is installed changes, or nobody has looked yet.
$(packages): .ci/packages.txt $(wildcard /var/lib/dpkg/status)
	@mkdir -p '$(BUILD)' 2>/dev/null && touch '$(BUILD)/.lock' 2>/dev/null || \
	  { echo "can't write to $(BUILD): name a folder for the programs with BUILD, one for the results with OUT" >&2; exit 2; }
	@.ci/packages "$$GIVEN_DEPS"
	@$(if $(filter none,$(DEPS)),,touch $@)

# settings(preset): what a build folder is made for; it keeps them. Others (the checkout moved, HBR_ARCH changed)
# need CMake afresh, or the sources of elsewhere would be compiled. CMake reads CXXFLAGS and LDFLAGS itself.
compiler := $(if $(filter-out default undefined,$(origin CXX)),$(if $(strip $(CXX)),-DCMAKE_CXX_COMPILER=$(call quoted,$(CXX))))
settings = -DHBR_BUILD=$(1) -DHBR_ARCH=$(call quoted,$(HBR_ARCH)) -DHBR_WERROR=$(if $(filter-out 0,$(WERROR)),ON,OFF) \
  -DHBR_UNITY=$(if $(filter 0,$(UNITY)),OFF,ON) \
  $(if $(filter fuzz,$(1)),-DCMAKE_CXX_COMPILER=clang++,$(compiler))
kept = $(settings) $(value CXXFLAGS) $(value LDFLAGS) $(CURDIR) $(abspath $(BUILD))

# What follows it in a recipe's line waits for another build in BUILD, where there are locks.
alone = { exec 9>$(BUILD)/.lock; } 2>/dev/null && { flock -n 9 2>/dev/null || [ $$? != 1 ] || \
  { echo 'waiting for another build in $(BUILD)' >&2; flock 9; }; } || true;

# configure(preset): CMake, once; Ninja calls it again when a CMakeLists.txt or a folder's files change.
define configure
ifneq ($$(file <$(BUILD)/$(1)/settings.txt),$$(call kept,$(1)))
.PHONY: $(BUILD)/$(1)/build.ninja
endif
$(BUILD)/$(1)/build.ninja: | $(packages)
	@$$(alone) rm -f $(BUILD)/$(1)/settings.txt; \
	  cmake --fresh -S . -B $(BUILD)/$(1) -G Ninja $$(call settings,$(1)) >$(BUILD)/$(1).log || \
	    { cat $(BUILD)/$(1).log >&2; exit 1; }; \
	  printf '%s\n' $$(call quoted,$$(call kept,$(1))) >$(BUILD)/$(1)/settings.txt
endef
$(foreach preset,release sanitize sanitize-thread fuzz coverage odr,$(eval $(call configure,$(preset))))

# compile(preset, target): Ninja tells its steps, and nothing where there are none.
idle := ^ninja: (no work|Entering)|Re-checking globbed
compile = ( $(alone) cmake --build $(BUILD)/$(1) --target $(2) | { grep --line-buffered -vE '$(idle)' || true; } )

# Programs in a folder that this user can't write are used as they are.
frozen := $(if $(wildcard $(programs)/hbr),$(shell [ -w $(BUILD)/release ] || echo yes))
ready := $(if $(frozen),,$(packages) $(BUILD)/release/build.ninja)
made_ready = $(if $(frozen),echo 'the programs in $(BUILD) are used as they are: you can not write there' >&2,\
  $(call compile,release,$(1)))
# Where a table is printed, Ninja's steps are none of its lines.
build: $(ready)
	@$(call made_ready,programs) $(if $(filter keys graph,$(MAKECMDGOALS)),>&2)

# The experiment -------------------------------------------------------------------------------------------------

# The page is an artifact; the report is the page with the times, hosts and versions of the manifests.
all $(stages): experiment
	@[ ! -e "$$GIVEN_OUT/page.json" ] || $(if $(filter all,$@),,[ "$$GIVEN_OUT/report/index.html" -nt "$$GIVEN_OUT/page.json" ] ||) \
	  $(programs)/publish "$$GIVEN_OUT/page" "$$GIVEN_OUT" "$$GIVEN_OUT/report"
	@$(if $(filter all,$@),[ ! -e "$$GIVEN_OUT/report/index.html" ] || printf 'the report: %s\n' "$$GIVEN_OUT/report/index.html",:)

data: $(packages)
	@DEPS="$$GIVEN_DEPS" pipeline/fetch_mnist.sh $(mnist)

# MNIST is fetched where the profile asks for it and it is not there, and so is three.js, without which the page shows
# robots by pictures alone. The + hands over make's jobs, and lets `make -n` list what would run.
mnist := .cache/mnist
three := .cache/three
experiment: build
	+@$(if $(dry),[ -x $(programs)/hbr ] || { echo '# then all that the profile asks for: nothing is built yet'; exit 0; };) \
	  missing=$$($(programs)/hbr missing $(arguments) $(goals)); \
	  case $$missing in *"/$(mnist)/"* $(if $(MNIST_DIR),| *"$$MNIST_DIR/"*)) \
	    $(if $(dry),echo '# MNIST is fetched first',DEPS="$$GIVEN_DEPS" pipeline/fetch_mnist.sh $(mnist));; esac; \
  case $$missing in *"/$(three)/"*) \
    $(if $(dry),echo '# three.js is fetched first',DEPS="$$GIVEN_DEPS" pipeline/fetch_three.sh $(three) || true);; esac; \
	  exec $(programs)/hbr $(if $(dry),plan,make --group "$$GIVEN_GROUP" --make '$(MAKE)' --parent $(shell echo $$PPID)) $(arguments) $(goals)

keys: build
	@$(programs)/hbr keys "$$GIVEN_PROFILE"

status audit: build
	@$(programs)/hbr $@ $(arguments)

# Of a run that can only be read it goes elsewhere.
graph: build
	@dot=$$($(programs)/hbr graph $(arguments)); \
	  mkdir -p "$$GIVEN_OUT" 2>/dev/null && [ -w "$$GIVEN_OUT" ] && place=$$GIVEN_OUT/graph.svg || place=$$(mktemp --suffix=.svg); \
	  dot -Tsvg <<<"$$dot" >"$$place"; printf '%s\n' "$$place"

# reports/reference/NAME: what a finished run found, in a few small files.
reference: build
	@$(programs)/reference keep "$$GIVEN_OUT" reports/reference

# The READMEs' figures of kept runs.
figures: build
	@$(programs)/reference claims reports/claims.toml reports/reference
	@$(programs)/reference tables reports/kept_tables.toml reports/reference

verify: build
	@$(programs)/reference verify "$$GIVEN_OUT" reports/reference

# In what two runs differ, as a page.
ifeq ($(origin OUT),file)
compare: OUT := out/compare
endif
compare: build
	@$(programs)/compare "$$GIVEN_A" "$$GIVEN_B" "$$GIVEN_OUT"

# Repertoires for other programs' readers.
export: build
	@$(programs)/export_repertoires "$$GIVEN_OUT" "$$GIVEN_FORMAT" "$$GIVEN_TO" "$$GIVEN_STAGE" "$$GIVEN_REP"

# The search and the layers for other programs: find_package(hbr), see pipeline/hbrConfig.cmake.in.
install: $(packages) $(BUILD)/release/build.ninja
	@$(call compile,release,hbr_arm)
	@cmake --install $(BUILD)/release --prefix "$$GIVEN_PREFIX"

# Any robot, before it has a place in a profile.
ifeq ($(origin OUT),file)
robot: OUT := out/robot
endif
robot: $(ready)
	@$(call made_ready,robot)
	@$(if $(frozen),,DEPS="$$GIVEN_DEPS" pipeline/fetch_three.sh $(three) || true)
	@set -f; $(programs)/robot "$$GIVEN_URDF" "$$GIVEN_OUT" "$$GIVEN_MESHES" $$GIVEN_POSE

# Tests and checks -----------------------------------------------------------------------------------------------

# run_tests(preset, target, options of CTest): all tests; CTest's summary stands last.
run_tests = @.ci/packages "$$GIVEN_DEPS" test && $(call compile,$(1),$(2)) && ctest --test-dir $(BUILD)/$(1) --output-on-failure --parallel $$(nproc) $(3)

test: $(packages) $(BUILD)/release/build.ninja
	$(call run_tests,release,all)

sanitized := $(if $(word 2,$(SANITIZER)),,$(or $(if $(filter address,$(SANITIZER)),sanitize),$(if $(filter thread,$(SANITIZER)),sanitize-thread)))
sanitize: $(packages) $(if $(sanitized),$(BUILD)/$(sanitized)/build.ninja)
	@[ -n '$(sanitized)' ] || { echo "SANITIZER is '$$GIVEN_SANITIZER'; expected address or thread" >&2; exit 2; }
	$(call run_tests,$(sanitized),$(if $(TESTS),$(call several,$(addprefix test_,$(subst /,_,$(TESTS)))),tests), \
	  $(if $(TESTS),-R $(call quoted,^($(subst $(space),|,$(strip $(TESTS))))/)))

# What is found stays in BUILD/fuzz/found, with the command that reads it again.
fuzz: $(BUILD)/fuzz/build.ninja
	@$(call compile,fuzz,$(if $(READER),$(call several,$(addprefix fuzz_,$(READER))),fuzz))
	@tests/fuzz/run $(BUILD)/fuzz "$$GIVEN_SECONDS" $(call several,$(READER))

.PHONY: fuzz-packages
fuzz-packages:
	@$(call whole,SECONDS,1)
	@.ci/packages "$$GIVEN_DEPS" fuzz
$(BUILD)/fuzz/build.ninja: | fuzz-packages

mutate: $(packages)
	@$(call whole,COUNT,1); $(call whole,SEED,0); $(call named,FILES)
	@.ci/packages "$$GIVEN_DEPS" mutate
	@python3 tests/mutation/mutate.py --place $(BUILD)/mutate --seed "$$GIVEN_SEED" --count "$$GIVEN_COUNT" -- \
	  $(call several,$(FILES))

coverage: $(packages) $(BUILD)/coverage/build.ninja
	@.ci/packages "$$GIVEN_DEPS" coverage
	@find $(BUILD)/coverage -name '*.gcda' -delete
	$(call run_tests,coverage,tests)
	@lcov --quiet --capture --directory $(BUILD)/coverage --base-directory "$$PWD" --no-external \
	  --output-file $(BUILD)/coverage/all.info
	@lcov --quiet --extract $(BUILD)/coverage/all.info "$$PWD/pipeline/*" "$$PWD/models/*" "$$PWD/reports/*" \
	  "$$PWD/stages/*" --output-file $(BUILD)/coverage/own.info
	@genhtml --quiet --output-directory $(BUILD)/coverage/html $(BUILD)/coverage/own.info
	@lcov --summary $(BUILD)/coverage/own.info

# Each benchmark's fastest of three repetitions counts. A whole run is kept with the sources.
bench: $(packages) $(BUILD)/release/build.ninja
	@$(call compile,release,benchmarks)
	@rm -rf $(BUILD)/bench && mkdir -p $(BUILD)/bench
	@for bench in $(programs)/bench_*; do \
	  results=$(BUILD)/bench/$${bench##*/bench_}; \
	  "$$bench" --benchmark_filter="$${GIVEN_BENCH:-.}" --benchmark_repetitions=3 --benchmark_min_time=0.2 \
	    --benchmark_display_aggregates_only --benchmark_out=$$results.json >$$results.txt 2>&1 || { cat $$results.txt; exit 1; }; \
	  [ -s $$results.json ] || rm $$results.json; \
	done
	@ls $(BUILD)/bench/*.json >/dev/null 2>&1 || { echo "no benchmark's name matches '$$GIVEN_BENCH'" >&2; exit 2; }
	@$(programs)/speed_table tests/benchmarks.toml '$(if $(BENCH),,reports/reference/bench.json)' $(BUILD)/bench/*.json

# Compiles everything for other processors, by both compilers, warnings being errors; links and runs nothing. The files
# of a target together, as `make` builds them; with UNITY=0 each alone. OBJECTS (a regex): only these.
COMPILERS ?= g++ clang++
OBJECTS ?=
TARGETS ?= x86-64 x86-64-v2 x86-64-v3 x86-64-v4 haswell sapphirerapids znver2 znver3 native
check-targets: $(packages)
	@$(call named,COMPILERS); $(call named,TARGETS)
	@.ci/packages "$$GIVEN_DEPS" check-targets
	@UNITY="$$GIVEN_UNITY" .ci/targets '$(BUILD)/targets' "$$GIVEN_COMPILERS" "$$GIVEN_TARGETS" "$$GIVEN_OBJECTS"

# What an optimised program hides: a function that no file defines, a name that two files mean differently. LINKED:
# only these programs.
LINKED ?= programs tests
check-odr: $(packages) $(BUILD)/odr/build.ninja
	@$(call named,LINKED)
	@$(call compile,odr,$(call several,$(LINKED)))

# The README's commands and all tests on a bare machine of each Debian release, as root.
RELEASES ?= bookworm trixie
check-releases:
	@$(call named,RELEASES)
	@.ci/packages "$$GIVEN_DEPS" check-releases
	@rm -f '$(BUILD)'/releases/*.sha256
	@for release in $(call several,$(RELEASES)); do \
	  MIRROR="$$GIVEN_MIRROR" WERROR="$$GIVEN_WERROR" tests/releases/try.sh "$$release" '$(BUILD)/releases'; done

# The layers of the reduced profile, built by each compiler for each of these: all the same bytes?
SAME ?= x86-64 x86-64-v3 native
check-bytes: build
	@$(call named,COMPILERS); $(call named,SAME)
	@.ci/packages "$$GIVEN_DEPS" check-targets
	@tests/releases/bytes.sh '$(BUILD)/bytes' $(programs)/hbr "$$GIVEN_COMPILERS" "$$GIVEN_SAME"

# A real Slurm on loopback, as root. CASES: only these of tests/cluster/run.
CASES ?=
test-cluster: build
	@.ci/packages "$$GIVEN_DEPS" test-cluster
	@BUILD="$$GIVEN_BUILD" tests/cluster/run $(call several,$(CASES))

# The folder of git's own is named, or git would refuse a checkout of another user's, as a container's may be.
tracked := git --git-dir=.git --work-tree=. ls-files

format:
	@.ci/packages "$$GIVEN_DEPS" format
	@$(tracked) '*.h' '*.cpp' | xargs clang-format -i

check-format:
	@.ci/packages "$$GIVEN_DEPS" format
	@$(tracked) '*.h' '*.cpp' | xargs clang-format --dry-run -Werror

clean:
	@rm -rf '$(BUILD)'
distclean: clean
	@rm -rf out .cache
