"""Prints the share of lines below a folder that have run, as gcov has counted in a build.

coverage.py BUILD FOLDER PERCENT exits with 1 if the share is less than PERCENT.
"""
import collections
import json
import pathlib
import subprocess
import sys


def lines_that_ran(build, folder):
    """Returns for each file below the folder: line number -> whether it ran, in any program that
    has the file."""
    found = collections.defaultdict(dict)
    for counts in sorted(build.rglob("*.gcda")):
        text = subprocess.run(["gcov", "--json-format", "--stdout", str(counts)], cwd=build,
                              check=True, capture_output=True, text=True).stdout
        for report in map(json.loads, text.splitlines()):
            start = pathlib.Path(report["current_working_directory"])
            for entry in report["files"]:
                path = (start / entry["file"]).resolve()
                if folder in path.parents:
                    lines = found[path.relative_to(folder)]
                    for line in entry["lines"]:
                        number = line["line_number"]
                        lines[number] = lines.get(number, False) or line["count"] > 0
    return found


def main():
    build, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    found = lines_that_ran(build, folder)
    if not found:
        sys.exit(f"nothing below {folder} has run in {build}")
    folders = collections.defaultdict(list)
    for path, lines in found.items():
        folders[path.parts[0]] += lines.values()
        folders["all"] += lines.values()
    for name, ran in sorted(folders.items(), key=lambda entry: entry[0] == "all"):
        print(f"{name:12} {100 * sum(ran) / len(ran):5.1f} % of {len(ran)} lines")
    parts = {path: 100 * sum(lines.values()) / len(lines) for path, lines in found.items() if lines}
    print("least:", ", ".join(f"{path} {parts[path]:.0f} %" for path in sorted(parts, key=parts.get)[:5]))
    sys.exit(100 * sum(folders["all"]) / len(folders["all"]) < float(sys.argv[3]))


if __name__ == "__main__":
    main()
