"""clang-tidy over what a build compiles, one process a core. usage: tidy.py BUILD [--jobs N] [WORD ...]

A file that passed is not read again until it, something that it includes, its command, the rules or the tool change.
With words only files with one of them in their path are read. What a header has wrong is told once, not for each file that includes it.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = "clang-tidy-19"
# The analyzer's usual depth takes longer than all other checks together; what it alone finds, the sanitizers' runs show as well.
SHALLOW = [f"--extra-arg={word}" for word in ("-Xclang", "-analyzer-config", "-Xclang", "mode=shallow")]
FINDING = re.compile(r"^(?=\S+:\d+:\d+: (?:warning|error): )", re.MULTILINE)
INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


@functools.cache
def includes(file: pathlib.Path, build: pathlib.Path) -> frozenset[pathlib.Path]:
    """What a file names itself, of the repository or made by the build."""
    found = set()
    for name in INCLUDE.findall(file.read_bytes()):
        for folder in (file.parent, ROOT / "src", build / "dialect"):
            if (folder / name.decode()).is_file():
                found.add((folder / name.decode()).resolve())
                break
    return frozenset(found)


def inputs(file: pathlib.Path, build: pathlib.Path) -> list[pathlib.Path]:
    seen: set[pathlib.Path] = set()
    ahead = {file}
    while ahead:
        seen |= ahead
        ahead = set().union(*(includes(one, build) for one in ahead)) - seen
    return sorted(seen)


@functools.cache
def content(file: pathlib.Path) -> bytes:
    return hashlib.sha256(file.read_bytes()).digest()


def state(entry: dict[str, str], build: pathlib.Path, rules: str) -> str:
    """Of all that an outcome depends on; equal if nothing changed."""
    whole = hashlib.sha256(f"{rules}\0{entry['file']}\0{entry['command']}".encode())
    for file in inputs(pathlib.Path(entry["file"]), build):
        whole.update(content(file))
    return whole.hexdigest()


def tidy(file: str, build: pathlib.Path) -> tuple[bool, str]:
    done = subprocess.run([TOOL, "-p", str(build), "--quiet", "--warnings-as-errors=*", *SHALLOW, file], cwd=ROOT,
                          capture_output=True, text=True, errors="replace")
    return done.returncode == 0, done.stdout or done.stderr


def main() -> int:
    arguments = argparse.ArgumentParser(description="clang-tidy over what a build compiles.")
    arguments.add_argument("build", type=pathlib.Path)
    arguments.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    arguments.add_argument("words", nargs="*")
    chosen = arguments.parse_intermixed_args()
    build = chosen.build.resolve()
    rules = (ROOT / ".clang-tidy").read_text() + " ".join(SHALLOW) + subprocess.run([TOOL, "--version"], capture_output=True, text=True, check=True).stdout
    states = {state(entry, build, rules): entry["file"] for entry in json.loads((build / "compile_commands.json").read_text())}
    memory = build / "tidy.passed"
    passed = set(memory.read_text().split()) & set(states) if memory.exists() else set()
    memory.write_text("".join(f"{one}\n" for one in sorted(passed)))
    wanted = [one for one, file in states.items() if one not in passed and (not chosen.words or any(word in file for word in chosen.words))]

    told: set[str] = set()
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool, memory.open("a") as remembered:
        outcomes = {pool.submit(tidy, states[one], build): one for one in wanted}
        for count, outcome in enumerate(concurrent.futures.as_completed(outcomes), 1):
            one = outcomes[outcome]
            good, said = outcome.result()
            print(f"[{count}/{len(wanted)}] {pathlib.Path(states[one]).relative_to(ROOT)}", flush=True)
            if good:
                print(one, file=remembered, flush=True)
                continue
            failed += 1
            for finding in FINDING.split(said):
                if (first := finding.partition("\n")[0]) not in told:
                    told.add(first)
                    print(finding.rstrip(), flush=True)
    print(f"{len(wanted)} files read, {failed} of them with findings, {len(states) - len(wanted)} not read")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
