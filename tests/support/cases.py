"""Tables of cases that are tried through the whole program, several at once. Not a test itself."""

import concurrent.futures


def failures(judge, cases, at_once: int = 3) -> list[str]:
    """What `judge` has to say against each case: the words of its AssertionErrors."""
    found = []
    with concurrent.futures.ThreadPoolExecutor(at_once) as several:
        for tried in [several.submit(judge, case) for case in cases]:
            try:
                tried.result()
            except AssertionError as failure:
                found.append(str(failure))
    return found
