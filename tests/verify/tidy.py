"""clang-tidy over what a build compiles, one process a core. usage: tidy.py BUILD [--jobs N] [WORD ...]

A file that passed is not read again until it, something that it includes, its command, the rules or the tool change.
With words only files with one of them in their path are read. What a header has wrong is told once, not for each file that includes it.

Most of the time would go into headers, the same ones for each file: a dozen files of a room are read as one, which takes a seventh of it.
"""

import argparse
import concurrent.futures
import dataclasses
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake"))
import together  # noqa: E402

# More take more memory than they save time.
MOST_FILES = 12
TOOL = str(ROOT / ".venv/bin/clang-tidy")
# The analyzer's usual depth takes longer than all other checks together; what it alone finds, the sanitizers' runs show as well.
SHALLOW = ["-Xclang", "-analyzer-config", "-Xclang", "mode=shallow"]
# The command is that of the compiler, which is older and knows options that the tool does not.
EXTRA = [f"--extra-arg={word}" for word in (*SHALLOW, "-Wno-unknown-warning-option")]
# Debian's Boost counts one below an enumeration's least value, which newer compilers than ours take for an error that cannot be turned off. No rule
# hangs on it, so that it is not among what an outcome depends on.
BOOST = ["-DBOOST_MPL_AUX_STATIC_CAST_HPP_INCLUDED",
         "-DBOOST_MPL_AUX_STATIC_CAST(T,expr)=static_cast<T>(__is_enum(T)&&((expr)<0||(expr)>3)?0:(expr))"]
FINDING = re.compile(r"^(?=\S+:\d+:\d+: (?:warning|error): )", re.MULTILINE)
# Of files read as one these may be findings of nobody: what one of them uses is what another one brought.
APART = re.compile(r"\[(clang-diagnostic-|misc-unused-using-decls)")
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


def room(file: str) -> tuple[str, ...]:
    return pathlib.Path(file).relative_to(ROOT).parts[:2]


def state(entry: dict[str, str], build: pathlib.Path, rules: str) -> str:
    """Of all that an outcome depends on; equal if nothing changed."""
    whole = hashlib.sha256(f"{rules}\0{entry['file']}\0{entry['command']}".encode())
    for file in inputs(pathlib.Path(entry["file"]), build):
        whole.update(content(file))
    return whole.hexdigest()


@dataclasses.dataclass(frozen=True)
class Outcome:
    """Of files that were read as one: what was said, and which of them it is not about."""

    said: str
    good: frozenset[str]


def command(entries: list[dict[str, str]], text: pathlib.Path) -> list[str]:
    """What any of the files is compiled with, once each."""
    options: dict[tuple[str, ...], None] = {}
    for entry in entries:
        words = iter(shlex.split(entry["command"])[1:])
        for word in words:
            if word == "-o":
                next(words)
            elif word not in ("-c", entry["file"]):
                options[(word, next(words)) if word in ("-isystem", "-I", "-D") else (word,)] = None
    return [TOOL, "--quiet", "--warnings-as-errors=*", *EXTRA, str(text), "--", *BOOST, *(word for option in options for word in option)]


def tidy(entries: list[dict[str, str]], folder: pathlib.Path) -> Outcome:
    """Reads files as one. Where the compiler has something against it, the fault may be that they are together: then one by one."""
    files = [entry["file"] for entry in entries]
    text = pathlib.Path(files[0])
    if len(files) > 1:
        text = folder / f"{hashlib.sha256(' '.join(files).encode()).hexdigest()[:16]}.cpp"
        # The rules have it that nobody includes a source.
        text.write_text("".join(f'#include "{file}"  // NOLINT\n' for file in files))
    done = subprocess.run(command(entries, text), cwd=entries[0]["directory"], capture_output=True, text=True, errors="replace")
    if done.returncode == 0:
        return Outcome("", frozenset(files))
    said = done.stdout or done.stderr
    if len(files) > 1 and (APART.search(said) or not FINDING.search(said)):
        apart = [tidy([entry], folder) for entry in entries]
        return Outcome("".join(one.said for one in apart), frozenset().union(*(one.good for one in apart)))
    wrong = {finding.partition(":")[0] for finding in FINDING.split(said) if FINDING.match(finding)}
    # What a header has wrong may come from any of them.
    return Outcome(said, frozenset(files) - wrong if wrong < set(files) else frozenset())


def main() -> int:
    arguments = argparse.ArgumentParser(description="clang-tidy over what a build compiles.")
    arguments.add_argument("build", type=pathlib.Path)
    arguments.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    arguments.add_argument("words", nargs="*")
    chosen = arguments.parse_intermixed_args()
    build = chosen.build.resolve()
    rules = (ROOT / ".clang-tidy").read_text() + " ".join(EXTRA) + subprocess.run([TOOL, "--version"], capture_output=True, text=True, check=True).stdout
    commands = json.loads((build / "compile_commands.json").read_text())
    # What the build itself writes has nobody to mend it.
    entries = {entry["file"]: entry for entry in commands if not pathlib.Path(entry["file"]).is_relative_to(build)}
    states = {file: state(entry, build, rules) for file, entry in entries.items()}
    memory = build / "tidy.passed"
    passed = set(memory.read_text().split()) & set(states.values()) if memory.exists() else set()
    memory.write_text("".join(f"{one}\n" for one in sorted(passed)))
    wanted = sorted(file for file, one in states.items() if one not in passed and (not chosen.words or any(word in file for word in chosen.words)))

    told: set[str] = set()
    good: set[str] = set()
    read = 0
    read_as_one = sorted(together.groups(wanted, room, MOST_FILES), key=len, reverse=True)
    with (tempfile.TemporaryDirectory(dir=build) as folder, concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool,
          memory.open("a") as remembered):
        jobs = {pool.submit(tidy, [entries[file] for file in group], pathlib.Path(folder)): group for group in read_as_one}
        for job in concurrent.futures.as_completed(jobs):
            outcome = job.result()
            read += len(jobs[job])
            print(f"[{read}/{len(wanted)}] {' '.join(str(pathlib.Path(file).relative_to(ROOT)) for file in jobs[job])}", flush=True)
            good |= outcome.good
            remembered.write("".join(f"{states[file]}\n" for file in sorted(outcome.good)))
            remembered.flush()
            for finding in FINDING.split(outcome.said):
                if FINDING.match(finding) and (first := finding.partition("\n")[0]) not in told:
                    told.add(first)
                    print(finding.rstrip(), flush=True)
    failed = len(wanted) - len(good)
    print(f"{len(wanted)} files read, {failed} of them with findings, {len(states) - len(wanted)} not read")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
