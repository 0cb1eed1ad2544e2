"""Every file or folder of the sources that a page names in `backticks` exists. usage: check_pages.py REPO"""

import pathlib
import re
import sys

# A path from the checkout's root or from the page's own folder. Patterns and places of the reader's own (`src/<room>`, `*`, `{a,b}`) name no file.
PATH = re.compile(r"`((?:src|tests|web|bench|fuzz|docs|setup|cmake|examples|editors)/[\w./-]+)`")


def missing(repo: pathlib.Path, name: str, text: str) -> list[str]:
    found = []
    own = (repo / name).parent
    for number, line in enumerate(text.splitlines(), 1):
        found += [f"{name}:{number}: there is no {path}" for path in PATH.findall(line) if not ((repo / path).exists() or (own / path).exists())]
    return found


def main() -> int:
    repo = pathlib.Path(sys.argv[1]).resolve()
    assert missing(repo, "page", "one `src/no/such.cpp`\ntwo `src/apps/verb.cpp`") == ["page:1: there is no src/no/such.cpp"]
    pages = [repo / "README.md", repo / "CONTRIBUTING.md", *sorted((repo / "docs").glob("*.md")), *sorted((repo / "docs/guide").glob("*.md")),
             *sorted((repo / "docs/reference").glob("*.md")), *sorted((repo / "src").glob("*/README.md")), repo / "web/README.md"]
    wrong = [word for page in pages for word in missing(repo, str(page.relative_to(repo)), page.read_text())]
    named = sum(len(PATH.findall(page.read_text())) for page in pages)
    print("\n".join(wrong) if wrong else f"{named} files are named on {len(pages)} pages, and all are there")
    return 1 if wrong or named < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
