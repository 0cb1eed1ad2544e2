"""What runs on a microcontroller compiles for one, and calls nothing but arithmetic and copying. usage: firmware_needs_no_heap.py REPO COMPILER"""

import pathlib
import subprocess
import sys
import tempfile

# No exceptions, no types at run time, no guards around statics, no hosted library: what a bare-metal build has.
FLAGS = ["-std=c++23", "-Os", "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics", "-Wall", "-Wextra", "-Werror"]
# A C library's arithmetic and what the compiler itself calls for. Neither `malloc` nor `operator new`, no stream, no `throw`.
ALLOWED = {"memcpy", "memset", "memmove", "memcmp", "abort", "__stack_chk_fail", "_GLOBAL_OFFSET_TABLE_",
           "atan2f", "cosf", "sinf", "sincosf", "remainderf", "sqrtf", "lround", "lroundf"}


def calls(compiler: str, repo: pathlib.Path, source: pathlib.Path, folder: str) -> set[str]:
    made = pathlib.Path(folder) / "made.o"
    subprocess.run([compiler, *FLAGS, "-I", str(repo / "src"), "-c", str(source), "-o", str(made)], check=True)
    listed = subprocess.run(["nm", "-u", str(made)], check=True, capture_output=True, text=True).stdout
    return {line.split()[-1] for line in listed.splitlines()}


def main() -> int:
    repo, compiler = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    sources = [path for path in sorted((repo / "src/firmware").rglob("*.cpp")) if not path.stem.endswith("_test") and path.parent.name != "testing"]
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        planted = pathlib.Path(folder) / "planted.cpp"
        planted.write_text("int* made(int n) { return new int[static_cast<unsigned>(n)]; }\n")
        assert any(name.startswith("_Zna") for name in calls(compiler, repo, planted, folder)), "the check sees no operator new"
        for source in sources:
            # Its own functions are defined in the room's other files.
            others = {name for name in calls(compiler, repo, source, folder) if "7lapwing8firmware" not in name}
            wrong += [f"{source.relative_to(repo)}: calls {name}" for name in sorted(others - ALLOWED)]
    print("\n".join(wrong) if wrong else f"{len(sources)} files of the firmware need no heap, exceptions or streams")
    return 1 if wrong or len(sources) < 5 else 0


if __name__ == "__main__":
    sys.exit(main())
