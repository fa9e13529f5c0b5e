"""Keeps what benchmarks print, and writes it into README.md beside this script.

    page.py keep GROUP < OUTPUT   keeps the output with day, processor and commit in Measured/GROUP.txt
    page.py                       writes all kept outputs between their markers in README.md

The markers of a group are the lines `<!-- measured GROUP -->` and `<!-- end GROUP -->`.
"""
import datetime
import os
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
KEPT = FOLDER / "Measured"
PAGE = FOLDER / "README.md"


def origin():
    """Day, processor and commit of a measurement that ends now."""
    processor = re.search(r"model name\s*: (.+)", pathlib.Path("/proc/cpuinfo").read_text()).group(1)
    commit = subprocess.run(["git", "-C", FOLDER, "rev-parse", "--short", "HEAD"], check=True,
                            capture_output=True, text=True).stdout.strip()
    day = datetime.date.today()
    return f"{day.day} {day:%B %Y}, {processor.strip()}, {os.cpu_count()} processors, at {commit}"


def row(line):
    """A line of a table without the spaces that align it on a terminal."""
    cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
    if all(re.fullmatch(r":?-+:?", cell) for cell in cells):
        return "|" + "---|" * len(cells)
    return "| " + " | ".join(cells) + " |"


def written(group, kept):
    """The lines of the page for a kept output. Every table begins with its origin."""
    first, *lines = kept.splitlines()
    page = []
    before = None  # the kind of the line above; none below an empty line
    for line in lines:
        if not line.strip():
            before = None
            continue
        kind = "table" if line.startswith("|") else "ratio" if line.startswith("RATIO ") else "text"
        if kind != before or kind == "text":
            page.append("")
        if kind == "table" and before != "table":
            page += [f"*{first}: `./Testing/benchmark.sh {group}`*", ""]
        page.append({"table": row, "ratio": "    {}".format, "text": str.strip}[kind](line))
        before = kind
    return [f"<!-- measured {group} -->", *page, "", f"<!-- end {group} -->"]


def filled(page, outputs):
    """The page with all outputs between their markers. KeyError names a group without markers."""
    for group, kept in outputs.items():
        block = re.compile(rf"<!-- measured {group} -->\n.*?<!-- end {group} -->", re.DOTALL)
        if not block.search(page):
            raise KeyError(group)
        text = "\n".join(written(group, kept))
        page = block.sub(lambda found: text, page)
    return page


def kept_outputs():
    return {path.stem: path.read_text() for path in sorted(KEPT.glob("*.txt"))}


def main(arguments):
    if arguments[:1] == ["keep"]:
        KEPT.mkdir(exist_ok=True)
        (KEPT / f"{arguments[1]}.txt").write_text(origin() + "\n" + sys.stdin.read())
        return 0
    try:
        PAGE.write_text(filled(PAGE.read_text(), kept_outputs()))
    except KeyError as missing:
        print(f"README.md has no markers of the group {missing}; see page.py", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
