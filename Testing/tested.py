"""Counts the tests in files of ctest's --output-junit, and names those that failed or were skipped.

Usage: tested.py FILE... [--row SUITE VERSIONS README]

With --row it also writes the line of the suite in the README's table: the suite, the versions of its packages and
the counts. The status is 1 if a test failed.
"""
import collections
import pathlib
import re
import sys
import xml.etree.ElementTree as ET

STATES = {"run": "passed", "fail": "failed", "notrun": "skipped", "disabled": "skipped"}


def reason(case):
    """Returns what a skipped test has said, or what ctest says of it."""
    said = case.findtext("system-out") or ""
    words = re.search(r"skipped:? *(.+)|Skipped\n(.+)", said)
    if words:
        return (words.group(1) or words.group(2)).strip()
    skipped = case.find("skipped")
    return skipped.get("message", "") if skipped is not None else ""


def read(files):
    """Returns the names of tests by their state, with the reasons of the skipped ones."""
    tests = collections.defaultdict(dict)
    for file in files:
        for case in ET.parse(file).getroot().iter("testcase"):
            tests[STATES[case.get("status")]][case.get("name")] = reason(case)
    return tests


def summary(tests):
    """Returns the counts, and the names of tests that did not pass."""
    text = ", ".join(f"{len(tests[state])} {state}" for state in ("passed", "failed", "skipped"))
    for state in ("failed", "skipped"):
        for name, why in tests[state].items():
            text += f"\n   {state}: {name}" + (f" ({why})" if why else "")
    return text


def write_row(tests, suite, versions, readme):
    """Replaces the row of a suite."""
    path = pathlib.Path(readme)
    counts = ", ".join(f"{len(tests[state])} {state}" for state in ("passed", "failed", "skipped"))
    text, rows = re.subn(rf"^\| {re.escape(suite)} \|.*$", f"| {suite} | {versions} | {counts} |", path.read_text(),
                         flags=re.MULTILINE)
    if rows != 1:
        sys.exit(f"{readme} has {rows} rows that begin with {suite}")
    path.write_text(text)


def main():
    """Reads the command line."""
    files = sys.argv[1:]
    row = None
    if "--row" in files:
        at = files.index("--row")
        row = files[at + 1:at + 4]
        files = files[:at]
    tests = read(files)
    print(summary(tests))
    if row:
        write_row(tests, *row)
    sys.exit(1 if tests["failed"] else 0)


main()
