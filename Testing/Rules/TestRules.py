"""Rules of the source text that no compiler checks.

    python3 TestRules.py [GROUP...]

Exit code 77 when nothing could be checked.
"""

import ast
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "Testing"), str(ROOT / "Testing/Benchmarks")]

import mutants
import page
import results

DOCUMENTATION = ROOT / "Plugin/Documentation"
FOLDERS = ("Filters", "Plugin", "Testing", "Examples", "CMake")
SOURCE_SUFFIXES = (".h", ".cxx")

# The layers of Core from the bottom up, a folder each. An include goes to its own folder or to a
# lower one; so the cycle, which sees matrices and lists of unknowns only, cannot reach a mesh.
CORE_LAYERS = (
    "Base", "Algebra", "Multigrid", "Krylov", "Grid", "Integrals", "Spaces",
    "Equations", "Spectrum", "Distance", "Shape", "Solvers")

# The folders that work in every function space.
PROBLEMS = ("Filters/Core/Equations", "Filters/Core/Spectrum", "Filters/Core/Distance",
            "Filters/Core/Shape", "Filters/Core/Krylov", "Filters/VTK")


def sources(folder, suffixes=SOURCE_SUFFIXES):
    return sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in suffixes and p.is_file())


def relative(path):
    return str(path.relative_to(ROOT))


def included(path):
    """Names in the include lines of a file, as they stand there."""
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(), re.MULTILINE)


def without_comments(text):
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.DOTALL)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    return re.sub(r"//[^\n]*", " ", text)


CORE = ROOT / "Filters/Core"
ABSTRACT_CLASSES = ("vtkSurfaceFEMAlgorithm", "vtkPoissonAlgorithm", "vtkSurfaceBasisHolder")


class Rule(unittest.TestCase):
    def assertNothing(self, offences, rule):
        self.assertFalse(offences, rule + "\n  " + "\n  ".join(offences))


class Layers(Rule):
    def test_core_knows_no_vtk(self):
        offences = [f"{relative(p)} includes {name}" for p in sources("Filters/Core")
                    for name in included(p) if name.startswith("vtk")]
        self.assertNothing(offences, "Core includes no VTK header.")

    def test_public_vtk_headers_hide_core(self):
        offences = [f"{relative(p)} includes {name}" for p in (ROOT / "Filters/VTK").glob("*.h")
                    for name in included(p)
                    if name.startswith(("Eigen", "omp", "Private") + CORE_LAYERS)]
        self.assertNothing(offences, "The headers of the filters include no Core header.")

    def test_core_is_its_layers(self):
        offences = [relative(p) for p in sources("Filters/Core")
                    if p.parent.parent != CORE or p.parent.name not in CORE_LAYERS]
        offences += [relative(p) for p in sources("Testing/Core")
                     if p.parent.name not in CORE_LAYERS]
        self.assertNothing(offences, "Not in the folder of a layer " + str(CORE_LAYERS))

    def test_parallel_knows_core_alone(self):
        allowed = CORE_LAYERS + ("Parallel",)
        offences = [f"{relative(p)} includes {name}" for p in sources("Filters/Parallel")
                    for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', p.read_text(), re.MULTILINE)
                    if pathlib.PurePath(name).parts[0] not in allowed]
        offences += [f"{relative(p)} includes {name}" for p in sources("Filters/Core")
                     for name in included(p) if name.startswith(("Parallel/", "petsc", "mpi"))]
        self.assertNothing(offences, "Parallel stands on Core, and Core on nothing.")

    def test_device_knows_one_header_of_core(self):
        offences = [f"{relative(p)} includes {name}" for p in sources("Filters/Device", (".h", ".cxx", ".cu"))
                    for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', p.read_text(), re.MULTILINE)
                    if name != "Multigrid/Device.h" and not (p.parent / name).exists()]
        offences += [relative(p) for p in sources("Filters") if p.name != "Memory.h" or p.parent.name != "Device"
                     if re.search(r"\bcuda[A-Z]|cuda_runtime", without_comments(p.read_text()))]
        self.assertNothing(offences, "The library of devices stands on its interface, and Memory.h alone knows CUDA.")

    def test_core_includes_go_one_way(self):
        offences = []
        for path in sources("Filters/Core"):
            for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', path.read_text(), re.MULTILINE):
                folder = pathlib.PurePath(name).parent.name
                if folder not in CORE_LAYERS:
                    offences.append(f"{relative(path)} includes {name} without its folder")
                elif CORE_LAYERS.index(folder) > CORE_LAYERS.index(path.parent.name):
                    offences.append(f"{relative(path)} includes {name}")
        self.assertNothing(offences, "Files of Core include only their own layer and those below.")


class Spaces(Rule):
    KINDS = re.compile(r"\b(?:GridSpace|HatSpace|HatLevel|HatMatrices|LevelOperators)\b")
    MAKERS = ("SurfaceBasis",)  # where a filter's space is made
    QUESTION = re.compile(r"FunctionSpace *[!=]=|[!=]= *(?:gridfem::)?FunctionKind::|"
                          r"FunctionKind::\w+ *[!=]=|case (?:gridfem::)?FunctionKind::")
    # They make spaces, estimate their memory before there are any, or say what would help.
    KNOW_THE_KIND = MAKERS + ("vtkSurfaceFEMAlgorithm", "Requirements", "SolveWarnings")

    def test_nobody_asks_which_space_there_is(self):
        offences = [f"{relative(p)}: {match.group()}"
                    for folder in PROBLEMS
                    for p in sources(folder) if p.stem not in self.MAKERS
                    for match in self.KINDS.finditer(without_comments(p.read_text()))]
        self.assertNothing(offences, "Problems and filters know a FiniteElementSpace alone.")

    def test_nobody_asks_which_space_was_chosen(self):
        offences = [relative(p)
                    for folder in PROBLEMS + ("Filters/Python",)
                    for p in sources(folder) if p.stem not in self.KNOW_THE_KIND
                    and self.QUESTION.search(without_comments(p.read_text()))]
        self.assertNothing(offences, "Problems and filters do the same in both function spaces.")


class Filters(Rule):
    def test_tests_of_all_filters_have_each_of_the_plugin(self):
        """Tests in Python find the filters in the plugin's XML; a list in C++ has to be kept."""
        listed = (ROOT / "Testing/VTK/AllFilters.h").read_text()
        names = [re.search(r'<SourceProxy name="(\w+)"', p.read_text()).group(1)
                 for p in (ROOT / "Plugin").glob("*.xml")]
        self.assertGreater(len(names), 10)
        offences = [name for name in names if f'FilterCase{{ "{name}"' not in listed]
        self.assertNothing(offences, "Testing/VTK/AllFilters.h lists every filter.")


class Core(Rule):
    FORBIDDEN = re.compile(
        r"std::(?:cout|cerr|clog|terminate|exit|abort|quick_exit)\b|#\s*include\s*<iostream>"
        r"|(?<![\w.>])f?(?:printf|puts)\s*\(|(?<![\w:.>])(?:exit|abort|_Exit)\s*\(")

    def test_core_neither_prints_nor_ends_the_program(self):
        offences = [f"{relative(p)}: {match.group().strip()}"
                    for folder in ("Filters/Core", "Filters/Parallel") for p in sources(folder)
                    for match in self.FORBIDDEN.finditer(without_comments(p.read_text()))]
        self.assertNothing(offences, "Core returns or throws; it never prints, exits or aborts.")


class Text(Rule):
    OPEN_ENDS = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|X" r"XX|HA" r"CK)\b")
    MACHINE_PATHS = re.compile(r"(?<![\w.$}\]/])/(?:work|tmp|home|root)/")

    def find(self, pattern):
        suffixes = SOURCE_SUFFIXES + (".py", ".sh", ".txt", ".cmake", ".in", ".xml", ".md")
        return [f"{relative(p)}:{number}: {line.strip()}"
                for folder in FOLDERS for p in sources(folder, suffixes)
                for number, line in enumerate(p.read_text().splitlines(), 1)
                if pattern.search(line)]

    def test_nothing_is_left_open(self):
        self.assertNothing(self.find(self.OPEN_ENDS), "What is left to do is an issue, not a comment.")

    def test_the_package_exports_its_functions(self):
        module = ast.parse((ROOT / "Filters/Python/__init__.py").read_text())
        functions = {node.name for node in module.body
                     if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")}
        exported = next(ast.literal_eval(node.value) for node in module.body
                        if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
        self.assertEqual(exported, sorted(exported))
        self.assertEqual(set(exported), functions | {"Error"})

    def test_no_paths_of_one_machine(self):
        paths = [line for line in self.find(self.MACHINE_PATHS) if "TestRules.py" not in line]
        self.assertNothing(paths, "The sources name no folder of somebody's machine.")

    def test_newer_libraries_have_the_same_names(self):
        """CI compiles with the libraries of Debian 12. Those of other Debians lack these names."""
        gone = re.compile(r"\bEigen::(?:placeholders::)?(?:all|last|lastp1)\b|vtkVectorOperators\.h")
        names = [line for line in self.find(gone) if "TestRules.py" not in line]
        self.assertNothing(names, "Eigen::seqN(0, n) is in Eigen 3.4 and 5; operators of vtkVector are written out.")


def properties_of_panels():
    """Names of several words."""
    panels = [*(ROOT / "Plugin").glob("*.xml"), *(ROOT / "Plugin/Shared").glob("*.xml")]
    return {name for p in panels for name in re.findall(r'Property name="(\w+)"', p.read_text())
            if re.search("[a-z][A-Z]", name)}


def choices_of_panel(path):
    """Returns the texts of each choice in a panel, without spaces and hyphens."""
    text = re.sub(r"^@(\w+)@$", lambda shared: (ROOT / f"Plugin/Shared/{shared[1]}.xml").read_text(),
                  path.read_text(), flags=re.M)
    return {name: re.sub("[ -]", "", ",".join(re.findall(r'<Entry value="\d+" text="([^"]*)"', body))).split(",")
            for name, body in re.findall(
                r'<IntVectorProperty name="(\w+)"(.*?)</IntVectorProperty>', text, re.DOTALL)
            if "<Entry" in body}


class Choices(Rule):
    def test_names_in_python_are_those_of_the_panels(self):
        """Some panels offer only the first of the choices."""
        text = (ROOT / "Filters/Python/_inputs.py").read_text()
        choices = ast.literal_eval(re.search(r"^CHOICES = (\{.*?\})", text, re.M | re.DOTALL)[1])
        panels = [choices_of_panel(p) for p in sorted((ROOT / "Plugin").glob("*.xml"))]
        offences = [f"{name}: {panel[name]}" for name, names in choices.items() for panel in panels
                    if panel.get(name, []) != list(names)[:len(panel.get(name, []))]]
        offences += [f"{name}: no panel has all of {names}" for name, names in choices.items()
                     if not any(panel.get(name) == list(names) for panel in panels)]
        self.assertNothing(offences, "Choices in Python that have other names in the panel:")


class Messages(Rule):
    def test_messages_name_labels(self):
        """A panel shows "Screening Weight" and never the name of the script, ScreeningWeight."""
        names = properties_of_panels()
        offences = []
        for path in [p for folder in ("Core", "Parallel", "VTK") for p in sources("Filters/" + folder)]:
            text = re.sub(r"//[^\n]*|/\*.*?\*/|#include[^\n]*|os << indent[^\n]*", " ", path.read_text(), flags=re.DOTALL)
            for literal in re.findall(r'"((?:\\.|[^"\\\n])*)"', text):
                offences += [f"{relative(path)}: {word}" for word in re.findall(r"\w+", literal)
                             if word in names and word != literal]
        self.assertNothing(offences, "Messages that name a property by its name in scripts:")


class Format(Rule):
    def test_sources_are_formatted(self):
        program = shutil.which("clang-format-14") or shutil.which("clang-format")
        if not program:
            self.skipTest("clang-format is not installed")
        version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
        if not re.search(r"version 14\.", version):
            self.skipTest("the format is that of clang-format 14, here is " + version.strip())
        files = [str(p) for folder in FOLDERS for p in sources(folder)]
        # One process for all: most of its time is its start.
        check = subprocess.run([program, "--style=file", "--dry-run", "--Werror", *files],
                               capture_output=True, text=True)
        offences = sorted({relative(pathlib.Path(name)) for name in re.findall(
            r"^(.+?):\d+:\d+: error: code should be clang-formatted", check.stderr, re.M)})
        self.assertEqual(check.returncode == 0, not offences, check.stderr)
        self.assertNothing(offences, "Run clang-format -i on:")


class Tests(Rule):
    def test_every_test_file_is_registered(self):
        """Test files are found by their names, so each needs the right name and folder."""
        offences = [relative(p) for p in sources("Testing", (".cxx",))
                    if re.search(r"\bTEST(?:_F|_P)?\s*\(", p.read_text())
                    and not (p.name.startswith("Test")
                             and (p.parent.name in ("VTK", "Parallel") or p.parent.parent.name == "Core"))]
        offences += [relative(p) for folder in ("Plugin", "Ranks")
                     for p in sources("Testing/" + folder, (".py", ".sh"))
                     if not p.name.startswith("Test") and not self.is_used(p)]
        self.assertNothing(offences, "These are not found by the build (Test<Concept>.cxx):")

    def test_comparisons_see_nan(self):
        """std::max(a, NaN) is a, and so is Eigen's maxCoeff(): a result of NaN would have no error."""
        blind = re.compile(r"\b([\w.]+)\s=\s[^;{}]*std::max\(\{?\s*\1,[^;]*(?:std::abs|acos|\.norm\()|\.maxCoeff\(\)")
        offences = []
        for folder in ("Benchmarks", "Core", "Fuzz", "Parallel", "Support", "VTK"):
            for p in sources(f"Testing/{folder}"):
                text = p.read_text()
                offences += [f"{relative(p)}:{text.count(chr(10), 0, found.start()) + 1}"
                             for found in blind.finditer(text)]
        self.assertNothing(offences, "These drop NaN; Larger (Support/Largest.h) and PropagateNaN do not:")

    def is_used(self, module):
        """Whether another file of the folder imports or runs this one."""
        return any(re.search(rf"\b{module.stem}\b", other.read_text())
                   for folder in ("Plugin", "Ranks")
                   for other in sources("Testing/" + folder, (".py", ".sh", ".txt"))
                   if other != module)

    def test_every_filter_has_a_panel_and_every_fragment_is_used(self):
        panels = "".join(p.read_text() for p in (ROOT / "Plugin").glob("*.xml"))
        classes = (ROOT / "Filters/VTK/CMakeLists.txt").read_text()
        offences = [f"Filters/VTK/{name}: no panel" for name in re.findall(r"^  (vtk[A-Z]\w+)", classes, re.M)
                    if name not in ABSTRACT_CLASSES
                    and f'class="{name}"' not in panels]
        offences += [f"{relative(p)}: not used" for p in (ROOT / "Plugin/Shared").glob("*.xml")
                     if f"@{p.stem}@" not in panels]
        offences += [f"@{name}@: there is no such fragment"
                     for name in set(re.findall(r"^@(\w+)@$", panels, re.M))
                     if not (ROOT / f"Plugin/Shared/{name}.xml").exists()]
        self.assertNothing(offences, "Classes, panels and fragments belong together:")


class Checks(Rule):
    """The scripts that check the tests themselves."""

    def test_deliberate_errors_fit_the_sources(self):
        lines = [(name, (ROOT / file).read_text().count(line + "\n"), test)
                 for name, file, line, _, test in mutants.MUTANTS]
        offences = [f"{name}: the line is there {count} times" for name, count, _ in lines if count != 1]
        offences += [f"{name}: no test {test}" for name, _, test in lines
                     if "." not in test and not any((ROOT / "Testing").rglob(f"{test}.cxx"))]
        self.assertNothing(offences, "Testing/mutants.py names lines and tests that are not there:")

    def said(self, cases, is_whole):
        """What results.py says of a run, and whether continuous integration fails."""
        with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
            file.write("<testsuite>" + "".join(cases) + "</testsuite>")
            file.flush()
            return results.check(file.name, is_whole, True)

    def test_skipped_and_missing_tests_are_seen(self):
        ran = [f'<testcase name="{group}Any" status="run"/>' for group in results.GROUPS]
        skip = '<testcase name="Odd" status="notrun"><skipped/><system-out>{}</system-out></testcase>'
        self.assertEqual(self.said(ran, True), ([f"{len(ran)} tests, 0 of them skipped"], False))
        self.assertEqual(self.said(ran[1:], False)[1], False)
        lines, failed = self.said(ran[1:], True)
        self.assertTrue(failed and results.GROUPS[0] in lines[-1])
        lines, failed = self.said(ran + [skip.format("a.cxx:5: Skipped\nno program of that name\n")], True)
        self.assertTrue(failed)
        self.assertIn("1 skipped: no program of that name", lines)
        self.assertTrue(self.said([], False)[1])
        with unittest.mock.patch.dict("os.environ", {"GRIDFEM_DATA_DIR": "/nowhere"}):
            lines, failed = self.said(ran + [skip.format("Skipped\nno real mesh knot.ply\n")], True)
        self.assertFalse(failed)
        self.assertIn("1 skipped: " + results.WITHOUT_MESHES, lines)
        with unittest.mock.patch.dict("os.environ", {"GRIDFEM_DATA_DIR": str(ROOT)}):
            self.assertTrue(self.said(ran + [skip.format("Skipped\nno real mesh knot.ply\n")], True)[1])


class Benchmarks(Rule):
    """The page of the benchmarks has the numbers that they printed."""

    def test_the_page_is_what_the_script_writes(self):
        text = page.PAGE.read_text()
        outputs = page.kept_outputs()
        self.assertEqual(page.filled(text, outputs), text, "Run Testing/Benchmarks/page.py.")
        groups = sorted(p.stem[len("Benchmark"):].lower()
                        for p in (ROOT / "Testing/Benchmarks").glob("Benchmark*.cxx"))
        self.assertEqual(groups, sorted(re.findall(r"^<!-- measured (\w+) -->$", text, re.M)))
        self.assertEqual([], sorted(set(outputs) - set(groups)))
        unmeasured = re.findall(r"^<!-- measured (\w+) -->\n<!-- end \1 -->$", text, re.M)
        self.assertEqual(sorted(set(groups) - set(outputs)), sorted(unmeasured), "These blocks were typed by hand.")

    def test_every_table_names_day_processor_and_command(self):
        lines = page.PAGE.read_text().splitlines()
        origin = re.compile(r"\s*\*\d+ \w+ 20\d\d, [^:]+: .+\*")
        offences = [f"line {k + 1}: {line}" for k, line in enumerate(lines)
                    if re.match(r"\s*\|", line) and not re.match(r"\s*\|", lines[k - 1])
                    and not origin.fullmatch(lines[k - 2])]
        self.assertNothing(offences, "Tables without a line of their day, processor and command:")

    def test_what_programs_print_becomes_tables(self):
        kept = "1 May 2030, Chip, 2 processors, at abc\n\nCycle of 3 | 4\n\n| mesh   | s   |\n|--------|-----|\n" \
               "| knot   | 0.5 |\n| a, b   |     |\n\n| n |\n|---|\n| 7 |\nRATIO odd/one 1 <= 2\nRATIO two 3 >= 2\nIt ends.\n"
        written = page.filled("A\n<!-- measured odd -->\nold\n<!-- end odd -->\nB", {"odd": kept})
        self.assertEqual(written, "\n".join((
            "A", "<!-- measured odd -->", "", "Cycle of 3 | 4", "",
            "*1 May 2030, Chip, 2 processors, at abc: `./Testing/benchmark.sh odd`*", "",
            "| mesh | s |", "|---|---|", "| knot | 0.5 |", "| a, b |  |", "",
            "*1 May 2030, Chip, 2 processors, at abc: `./Testing/benchmark.sh odd`*", "",
            "| n |", "|---|", "| 7 |", "",
            "    RATIO odd/one 1 <= 2", "    RATIO two 3 >= 2", "", "It ends.", "", "<!-- end odd -->", "B")))
        self.assertEqual(page.filled(written, {"odd": kept}), written)
        self.assertRaises(KeyError, page.filled, "A", {"odd": kept})


class Examples(Rule):
    def test_every_filter_has_a_state_and_a_script(self):
        offences = []
        for panel in (ROOT / "Plugin").glob("*.xml"):
            name = re.search(r'<SourceProxy name="(\w+)"', panel.read_text()).group(1)
            offences += [f"{name}: none in Examples/{folder}" for folder in ("States", "Python")
                         if not any(f"{name}(" in p.read_text()
                                    for p in (ROOT / "Examples" / folder).glob("*.py"))]
        self.assertNothing(offences, "Filters without an example:")

    def test_every_state_is_loaded_by_the_tests(self):
        tests = (ROOT / "Examples/States/check_states.py").read_text()
        offences = [relative(p) for p in (ROOT / "Examples/States").glob("*.py")
                    if p.name != "check_states.py" and f'    "{p.stem}": (' not in tests]
        self.assertNothing(offences, "States that no test loads:")


class Readme(Rule):
    def test_both_commands_are_named(self):
        text = (ROOT / "README.md").read_text()
        offences = [c for c in ("./Examples/run.sh", "./Testing/run.sh") if c not in text]
        self.assertNothing(offences, "README.md does not name:")

    def test_linked_files_exist(self):
        offences = []
        for page in [*ROOT.glob("*.md"), *DOCUMENTATION.glob("*.md"), *(ROOT / "Examples").rglob("*.md")]:
            for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text()):
                if "://" not in target and not (page.parent / target).exists():
                    offences.append(f"{relative(page)} links to {target}")
        self.assertNothing(offences, "A link leads nowhere.")

    def test_every_property_is_on_the_page_of_its_filter(self):
        shared = (DOCUMENTATION / "SharedProperties.md").read_text()
        offences = []
        for panel in (ROOT / "Plugin").glob("*.xml"):
            page = DOCUMENTATION / f"{panel.stem}.md"
            text = shared + (page.read_text() if page.exists() else "")
            proxy = panel.read_text().split("</SourceProxy>")[0]
            for tag, name in re.findall(r'<(\w+VectorProperty) name="(\w+)"', proxy):
                if name != "TimestepValues" and f"`{name}`" not in text:
                    offences.append(f"{relative(page)}: {name}")
        self.assertNothing(offences, "Properties that are not described:")


def main():
    program = unittest.main(argv=sys.argv, exit=False, verbosity=2)
    result = program.result
    if not result.wasSuccessful():
        return 1
    return 77 if result.testsRun == len(result.skipped) else 0


if __name__ == "__main__":
    sys.exit(main())
