"""Says what a run of the tests has not tested. Usage: results.py TESTS.XML [whole]

Prints the number of skipped tests for each reason. If CI=true, a skipped test is a failure, unless the
folder of real meshes is missing. In a whole run, a missing group of tests is a failure as well, for
example because mpiexec was not found when the build was configured.
"""
import collections
import os
import pathlib
import re
import sys
import xml.etree.ElementTree

GROUPS = ("Fuzz.", "Parallel.", "Plugin.", "Ranks.", "Rules.")  # of the names that CMake gives
WITHOUT_MESHES = "the folder of real meshes is not there"


def folder_of_meshes():
    """As RealMesh() in Support/MeshFiles.cxx finds it."""
    given = os.environ.get("GRIDFEM_DATA_DIR")
    beside = pathlib.Path(__file__).resolve().parents[2] / "shared" / "data"
    return pathlib.Path(given) if given else beside


def reason_of(case):
    """The reason of a skipped test; None for a test that ran."""
    if case.find("skipped") is None and case.get("status") not in ("notrun", "disabled"):
        return None
    text = "".join(case.itertext())
    if re.search(r"real mesh", text) and not folder_of_meshes().is_dir():
        return WITHOUT_MESHES
    # The line that GTEST_SKIP or a script has written.
    said = re.search(r"Skipped\n(.+)|\bskipped[: ](.+)", text)
    return next((part.strip() for part in said.groups() if part), "skipped") if said else "no reason given"


def check(tests, is_whole, is_ci):
    """Returns what is said, and whether it is a failure."""
    cases = list(xml.etree.ElementTree.parse(tests).getroot().iter("testcase"))
    reasons = [reason_of(case) for case in cases]
    counts = collections.Counter(reason for reason in reasons if reason)
    lines = [f"{len(cases)} tests, {sum(counts.values())} of them skipped"]
    lines += [f"{count} skipped: {reason}" for reason, count in counts.most_common()]
    failed = not cases or any(reason != WITHOUT_MESHES for reason in counts)
    if is_whole:
        names = [case.get("name") for case, reason in zip(cases, reasons) if not reason]
        for group in GROUPS:
            if not any(name.startswith(group) for name in names):
                lines.append(f"No test of the group {group} ran")
                failed = True
    return lines, failed and is_ci


def main():
    lines, failed = check(sys.argv[1], "whole" in sys.argv[2:], os.environ.get("CI") == "true")
    for line in lines:
        print("--", line, file=sys.stderr)
    if failed:
        print("-- Continuous integration must not leave these out", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
