"""Tables of cases that are tried through the whole program, several at once. Not a test itself."""

import concurrent.futures


def failures(judge, cases, at_once: int = 3) -> list[str]:
    """What `judge` has to say against each case: an AssertionError of it, in words."""
    found = []
    with concurrent.futures.ThreadPoolExecutor(at_once) as several:
        for case, tried in [(case, several.submit(judge, case)) for case in cases]:
            try:
                tried.result()
            except AssertionError as failure:
                found.append(f"{case[0]}: {failure}")
    return found
