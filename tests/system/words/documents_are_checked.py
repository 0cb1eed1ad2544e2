"""Every script in the guides is checked and run, what it is said to print is compared, and links lead somewhere.

To accept new texts: LAPWING_REFRESH_GOLDEN=1 in front, and read the diff.
"""

import os
import pathlib
import re
import subprocess
import tempfile

import documents
import harness

PAGES = [harness.ROOT / "README.md", harness.ROOT / "examples/README.md", *sorted((harness.ROOT / "docs").glob("*.md")),
         *sorted((harness.ROOT / "docs/guide").glob("*.md"))]
STAMP = re.compile(r"^\d\d:\d\d:\d\d\.\d{3} +")
LINK = re.compile(r"\[[^\]\[]*\]\(([^)\s]+)\)")


def lines_of(text: str) -> list[str]:
    return [line.rstrip() for line in text.rstrip("\n").split("\n")] if text else []


def checked(script: pathlib.Path, block: documents.Block) -> list[str]:
    done = subprocess.run([harness.LAPWING, "check", script.name], cwd=script.parent, capture_output=True, text=True, timeout=60)
    expected = 2 if "mistake" in block.words else 0
    assert done.returncode == expected, f"{block.place}: check ends with {done.returncode}\n{done.stdout}{done.stderr}"
    said = lines_of(done.stderr) + lines_of(done.stdout)
    if expected == 0 and "warns" not in block.words:
        assert said == [f"{script.name}: no mistakes found"], f"{block.place}: {said}"
    return said


def run(script: pathlib.Path, block: documents.Block) -> list[str]:
    command = [harness.LAPWING, "run", "--platform", "test", "--seed", "1", script.name]
    if "events" in block.words:
        command += ["--events", "-"]
    answers = block.words.get("input", "").replace("|", "\n") + "\n" if "input" in block.words else ""
    done = subprocess.run(command, cwd=script.parent, input=answers, capture_output=True, text=True, timeout=60)
    expected = int(block.words.get("exit", 0))
    assert done.returncode == expected, f"{block.place}: run ends with {done.returncode}\n{done.stdout}{done.stderr}"
    log = [STAMP.sub("", line) for line in lines_of(done.stderr) if STAMP.match(line)]
    out = [line for line in lines_of(done.stdout) if '"event":"ALLOC"' not in line]
    return out + [line for line in log if line.startswith(("warning ", "error "))]


def printed(block: documents.Block, folder: pathlib.Path) -> list[str]:
    """What the document should show behind the block; checks and runs it on the way."""
    script = folder / "my.dolphin"
    script.write_text(block.script)
    said = checked(script, block)
    if "warns" in block.words:
        run(script, block)
    if "mistake" in block.words or "warns" in block.words:
        return said
    if "picture" in block.words:
        harness.expect_exit(0, "plan", str(script))
    if "flown" in block.words or "driven" in block.words:  # the_guides_run_to_their_ends.py
        return []
    out = run(script, block)
    if not block.before:
        return out
    script.write_text(block.before.script)
    earlier = run(script, block.before)
    assert out[: len(earlier)] == earlier, f"{block.place}: the block before prints something else now"
    return out[len(earlier):]


def anchors(page: pathlib.Path) -> set[str]:
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(page: pathlib.Path) -> list[str]:
    broken = []
    for link in LINK.findall(page.read_text()):
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        if "://" not in link and (not target.exists() or (anchor and anchor not in anchors(target))):
            broken.append(f"{page.relative_to(harness.ROOT)}: there is no {link}")
    return broken


refreshes = os.environ.get("LAPWING_REFRESH_GOLDEN") == "1"
wrong, broken, count = [], [], 0
with tempfile.TemporaryDirectory() as name:
    for page in {*PAGES, *(harness.ROOT / "docs").rglob("*.md"), harness.ROOT / "CONTRIBUTING.md"}:
        broken += broken_links(page)
    for page in PAGES:
        fresh = {}
        for block in documents.blocks_of(page):
            count += 1
            try:
                actual = printed(block, pathlib.Path(name))
            except AssertionError as mistake:
                broken.append(str(mistake))
                continue
            if block.text is None or [line.rstrip() for line in block.text] == actual:
                continue
            fresh[block.text_line] = actual
            wrong.append("\n".join([f"{page.name}:{block.text_line}: it prints", *actual]))
        if refreshes and fresh:
            documents.replace_texts(page, fresh)
assert not broken, "\n".join(broken)
assert refreshes or not wrong, "\n".join(wrong)
assert count > 25, f"only {count} scripts were found"
print(f"{count} scripts of the documents are checked")
