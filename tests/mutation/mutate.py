"""make mutate: do the tests notice small deliberate bugs?

Puts one bug after the other into a copy of the tree, builds the test programs that cover its file and runs them. Ends
with the bugs that no test noticed. The same seed, count and files choose the same bugs.
"""

import argparse
import collections
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import time

from mutants import mutants_of

# The test programs that cover a folder: its own, then those asked where its own notices nothing.
COVER = {
    "pipeline/core": ["pipeline_core", "pipeline_qd", "pipeline_hierarchy"],
    "pipeline/qd": ["pipeline_qd", "pipeline_hierarchy"],
    "pipeline/hierarchy": ["pipeline_hierarchy"],
    "pipeline/drawing": ["pipeline_drawing", "pipeline_hierarchy"],
    "pipeline/statistics": ["pipeline_statistics", "reports"],
    "pipeline/process": ["pipeline_process", "pipeline_artifact"],
    "pipeline/artifact": ["pipeline_artifact", "end_to_end"],
    "models/arm": ["models_arm", "pipeline_hierarchy"],
    "models/autoencoder": ["models_autoencoder", "models_descriptor"],
    "models/dataset": ["models_dataset", "stages"],
    "models/descriptor": ["models_descriptor", "models_onnx"],
    "models/judge": ["models_judge", "stages"],
    "models/nao": ["models_nao"],
    "models/onnx": ["models_onnx"],
    "models/robot": ["models_robot", "models_nao"],
}

MEMORY = 8 << 30  # bytes of address space of a test program


def folder_of(file):
    return "/".join(file.split("/")[:2])


class Tree:
    """A copy of the sources with a build of its own."""

    def __init__(self, sources, place):
        self.sources, self.tree, self.build = sources, place / "tree", place / "build"
        # The folder of git's own is named, or git would refuse a checkout of another user's.
        files = subprocess.run(["git", "--git-dir=.git", "--work-tree=.", "ls-files", "-z", "--cached", "--others",
                                "--exclude-standard"], cwd=sources, check=True, capture_output=True, text=True)
        names = {name for name in files.stdout.split("\0")[:-1] if (sources / name).exists()}
        for name in names:
            self.put(name, (sources / name).read_bytes())
        # What an earlier call copied and is no longer among the sources would still be compiled.
        for path in self.tree.rglob("*"):
            if not path.is_dir() and str(path.relative_to(self.tree)) not in names:
                path.unlink()
        if not (self.build / "build.ninja").exists():
            subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DHBR_BUILD=release",
                            "-DHBR_UNITY=OFF"],
                           check=True, stdout=subprocess.DEVNULL)

    def put(self, name, content):
        path = self.tree / name
        if path.exists() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        path.chmod((self.sources / name).stat().st_mode)

    def builds(self, program):
        done = subprocess.run(["cmake", "--build", self.build, "--target", f"test_{program}", "--", "-k", "1"],
                              capture_output=True, text=True)
        return done.returncode == 0

    def passes(self, program, limit):
        """Whether all tests pass within `limit` seconds, and how long they take."""
        began = time.monotonic()
        # The first failure is enough. Loops that no longer end must not take all memory.
        tests = subprocess.Popen([self.build / "bin" / f"test_{program}", "--gtest_fail_fast", "--gtest_brief=1"],
                                 cwd=self.build, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 start_new_session=True,
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))
        try:
            tests.wait(limit)
        except subprocess.TimeoutExpired:
            os.killpg(tests.pid, signal.SIGKILL)  # with what the tests started
            tests.wait()
        return tests.returncode == 0, time.monotonic() - began


def chosen(sources, files, seed):
    """All bugs of the files, in an order that hangs on the seed alone."""
    all_mutants = []
    for path in sorted(files):
        name = str(path.relative_to(sources))
        if folder_of(name) in COVER:
            all_mutants += mutants_of(name, path.read_text())
    random.Random(seed).shuffle(all_mutants)
    return all_mutants


def known_equivalent(path):
    """(file, line, what takes its place) of bugs that change nothing; see the file."""
    known = set()
    lines = [line.rstrip("\n") for line in path.open() if line.strip() and not line.startswith("#")]
    for file, before, after, why in zip(*[iter(lines)] * 4):
        if not (before.startswith("  - ") and after.startswith("  + ") and why.startswith("    ")):
            sys.exit(f"{path}: expected a file's name, '  - LINE', '  + LINE' and why, found\n{file}\n{before}\n{after}\n{why}")
        known.add((file, before[4:], after[4:]))
    return known


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=60, help="how many bugs to try")
    parser.add_argument("--seed", type=int, default=1, help="which ones")
    parser.add_argument("--place", type=pathlib.Path, required=True, help="where the copy is built")
    parser.add_argument("files", nargs="+", help="folders or files to put them into")
    a = parser.parse_args()
    here = pathlib.Path(__file__).resolve().parent
    sources = here.parent.parent
    files = set()
    for name in a.files:
        path = sources / name
        found = [path] if path.is_file() else [*path.rglob("*.cpp"), *path.rglob("*.h")]
        if not found:
            sys.exit(f"{name}: no source file; expected folders or files below the repository")
        files.update(found)
    equivalent = known_equivalent(here / "equivalent.txt")
    candidates = [m for m in chosen(sources, files, a.seed)
                  if (m.file, m.before.strip(), m.after.strip()) not in equivalent]
    if not candidates:
        sys.exit(f"{' '.join(a.files)}: no place for a bug; the folders known are {', '.join(COVER)}")

    tree = Tree(sources, a.place.resolve())
    limits = {}  # seconds a program may take

    def limit(program):
        if program not in limits:
            print(f"test_{program} without any bug", flush=True)
            if not tree.builds(program):
                sys.exit(f"test_{program} does not build")
            good, seconds = tree.passes(program, 3600)
            if not good:
                sys.exit(f"test_{program} fails without any bug")
            limits[program] = 20 + 10 * seconds
        return limits[program]

    def noticed(name, text, programs):
        """By which program; "" by none; None where the bug does not compile."""
        for program in programs:
            most = limit(program)  # of the sources as they are, so before the bug
            tree.put(name, text)
            built = tree.builds(program)
            good = built and tree.passes(program, most)[0]
            tree.put(name, (sources / name).read_bytes())
            if not built:
                return None
            if not good:
                return program
        return ""

    tried, survivors, unbuilt = collections.Counter(), [], 0
    for mutant in candidates:
        if sum(tried.values()) == a.count:
            break
        lines = (sources / mutant.file).read_text().split("\n")
        lines[mutant.line - 1] = mutant.after
        by = noticed(mutant.file, "\n".join(lines).encode(), COVER[folder_of(mutant.file)])
        if by is None:
            unbuilt += 1
            continue
        tried[folder_of(mutant.file)] += 1
        print(f"{sum(tried.values())}/{a.count} {'noticed by test_' + by if by else 'SURVIVES'}: {mutant}", flush=True)
        if not by:
            survivors.append(mutant)

    print("\nNo test notices:" if survivors else "\nThe tests notice every one.")
    for mutant in survivors:
        print(mutant)
    print()
    for folder, n in sorted(tried.items()):
        lost = sum(folder_of(m.file) == folder for m in survivors)
        print(f"{folder}: {n - lost} of {n} noticed")
    total = sum(tried.values())
    print(f"{total - len(survivors)} of {total} noticed ({100 * (total - len(survivors)) / max(total, 1):.0f} %), "
          f"{unbuilt} more did not compile")


if __name__ == "__main__":
    main()
