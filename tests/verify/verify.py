"""The checks that take too long for every change, by name. usage: verify.py [--list] [--fuzz-seconds N] [PART ...]

Without a part all of them run, the quick ones first. A part that fails does not keep the others from running; the last line is
"N passed, N failed". What a part printed is kept in build/verify/PART.log. Builds are incremental: a second run repeats what changed.
"""

import argparse
import collections.abc
import concurrent.futures
import dataclasses
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOGS = ROOT / "build/verify"
JOBS = str(os.cpu_count() or 1)
# clang's build has the address and undefined behaviour sanitizers and what guides a fuzzer in it: one build for three parts.
CLANG = "asan"
# Unit tests with a sanitizer take several times as long, and hold several times the memory.
# Fast DDS gives back some of its lists as another type than it asked for them (new_delete_type_mismatch); ours are seen by the compiler.
SANITIZED = {"asan": {"ASAN_OPTIONS": "detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1:new_delete_type_mismatch=0",
                      "LSAN_OPTIONS": f"suppressions={ROOT}/tests/verify/lsan.supp",
                      "UBSAN_OPTIONS": "print_stacktrace=1:halt_on_error=1"},
             "tsan": {"TSAN_OPTIONS": f"halt_on_error=1:second_deadlock_stack=1:suppressions={ROOT}/tests/verify/tsan.supp"}}
# What compares a page or a list with the sources that it is made from.
CROSS_CHECKS = r"^house\.|^editors\.grammar$|[Rr]eference|Grammar|OpenApi|Protocol|^web\.(check|lint)$"

Run = collections.abc.Callable[..., None]


class Failed(Exception):
    """What a person does next is in the text."""


@dataclasses.dataclass(frozen=True)
class Part:
    """One check with its name, and what it says of itself in the list."""

    name: str
    what: str
    check: collections.abc.Callable[[Run], None]


def build(run: Run, preset: str, *targets: str) -> pathlib.Path:
    folder = ROOT / "build" / preset
    if not (folder / "build.ninja").exists():
        run("cmake", "--preset", preset)
    # All mistakes of a build in one go: nobody wants to wait an hour for the second one.
    run("cmake", "--build", str(folder), "--target", *(targets or ("all",)), "--", "-k", "0")
    return folder


def tidy(run: Run) -> None:
    # The rules read what a compiler is told, and headers that the build makes.
    folder = build(run, "clang", "lapwing_dialect_headers")
    run(sys.executable, str(ROOT / "tests/verify/tidy.py"), str(folder))


def cross_checks(run: Run) -> None:
    run("ctest", "--test-dir", str(ROOT / "build/release"), "-R", CROSS_CHECKS, "-j", JOBS, "--output-on-failure", "--no-tests=error")


def long_flights(run: Run) -> None:
    # They wait for a clock more than for a processor.
    run("ctest", "--test-dir", str(ROOT / "build/release"), "-L", "^long$", "-j", str(2 * int(JOBS)), "--output-on-failure", "--no-tests=error")


def sanitized(run: Run, preset: str) -> None:
    folder = build(run, preset)
    run("ctest", "--test-dir", str(folder), "-L", "^unit$", "-j", JOBS, "--output-on-failure", "--no-tests=error",
        env=SANITIZED[preset])


def fuzz_targets() -> list[str]:
    return re.findall(r"^ *lapwing_fuzz\((\w+)", (ROOT / "fuzz/CMakeLists.txt").read_text(), re.MULTILINE)


def fuzz(run: Run, seconds: int) -> None:
    targets = fuzz_targets()
    folder = build(run, CLANG, "frame_seeds", *(f"fuzz_{target}" for target in targets))

    def survives(target: str) -> bool:
        with (LOGS / f"fuzz-{target}.log").open("w") as log:
            try:
                runner(log)(str(ROOT / "fuzz/run.sh"), target, str(seconds), str(folder))
            except Failed:
                return False
        return True

    # A fuzzer has one thread: as many at once as there are processors.
    with concurrent.futures.ThreadPoolExecutor(int(JOBS)) as pool:
        found = [target for target, well in zip(targets, pool.map(survives, targets)) if not well]
    if found:
        raise Failed(f"inputs that fail are in build/fuzz/failures: {' '.join(found)}")


def parts(fuzz_seconds: int) -> list[Part]:
    return [
        Part("sources", "includes, folders, format; pages, protocol and grammar are what the sources say", cross_checks),
        Part("long", "flights and drives of minutes, which others of their kind stand for in ./lapwing test", long_flights),
        Part("clang", "everything builds with clang, warnings as errors", lambda run: build(run, CLANG) and None),
        Part("tidy", "clang-tidy: mistakes, names, sizes of functions", tidy),
        Part("asan", "every unit test under the address and undefined behaviour sanitizers", lambda run: sanitized(run, CLANG)),
        Part("tsan", "every unit test under the thread sanitizer", lambda run: sanitized(run, "tsan")),
        Part("fuzz", f"each of {len(fuzz_targets())} fuzz targets for {fuzz_seconds} s", lambda run: fuzz(run, fuzz_seconds)),
    ]


def runner(log) -> Run:
    """Runs a command with its words in the log, and the build's progress on a terminal."""
    def run(*command: str, env: dict[str, str] | None = None) -> None:
        print("$", *command, file=log, flush=True)
        started = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                                   env={**os.environ, **(env or {})})
        assert started.stdout
        for line in started.stdout:
            log.write(line)
            if sys.stderr.isatty():
                print(f"\r\033[K{line.rstrip()[:100]}", end="", file=sys.stderr, flush=True)
        if sys.stderr.isatty():
            print("\r\033[K", end="", file=sys.stderr, flush=True)
        if started.wait() != 0:
            raise Failed(f"{' '.join(command[:4])} ended with {started.returncode}")
    return run


def carry_out(part: Part) -> bool:
    print(f"{part.name}: {part.what}", flush=True)
    begun = time.monotonic()
    path = LOGS / f"{part.name}.log"
    with path.open("w", buffering=1) as log:  # line by line, for who looks on
        try:
            part.check(runner(log))
            outcome = "passed"
        except Failed as failure:
            outcome = f"FAILED: {failure}; see {path.relative_to(ROOT)}"
    print(f"{part.name}: {outcome} after {time.monotonic() - begun:.0f} s", flush=True)
    return outcome == "passed"


def main() -> int:
    arguments = argparse.ArgumentParser(prog="./lapwing verify", description="Checks that take too long for every change.")
    arguments.add_argument("parts", nargs="*", metavar="PART")
    arguments.add_argument("--list", action="store_true", help="show the parts and end")
    arguments.add_argument("--fuzz-seconds", type=int, default=60, metavar="N", help="for each fuzz target (60)")
    chosen = arguments.parse_args()
    if chosen.fuzz_seconds < 1:
        arguments.error("--fuzz-seconds must be 1 or more")
    known = {part.name: part for part in parts(chosen.fuzz_seconds)}
    if unknown := [name for name in chosen.parts if name not in known]:
        arguments.error(f"there is no part {' or '.join(unknown)}; parts: {' '.join(known)}")
    wanted = [part for part in known.values() if not chosen.parts or part.name in chosen.parts]
    if chosen.list:
        print("\n".join(f"{part.name:8} {part.what}" for part in wanted))
        return 0
    LOGS.mkdir(parents=True, exist_ok=True)
    passed = [carry_out(part) for part in wanted]
    print(f"{sum(passed)} passed, {len(passed) - sum(passed)} failed")
    return 0 if all(passed) else 1


if __name__ == "__main__":
    sys.exit(main())
