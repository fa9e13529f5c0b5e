"""Tests the help of the plugin: every filter has a page, and every link leads to one."""
import os
import re
import sqlite3
import sys
import unittest
import zlib

HELP = os.path.join(os.environ["GRIDFEM_BINARY_DIR"], "Plugin", "paraview_help", "GridFEM.qch")
PANELS = os.path.join(os.environ["GRIDFEM_SOURCE_DIR"], "Plugin")


class TestHelp(unittest.TestCase):
    def setUp(self):
        self.database = sqlite3.connect(HELP)
        rows = self.database.execute("SELECT Name, Data FROM FileNameTable, FileDataTable WHERE "
                                     "FileNameTable.FileId = FileDataTable.Id AND Name != ''")
        # Qt writes four bytes with the length in front of the data from zlib.
        self.files = {name: zlib.decompress(data[4:]) for name, data in rows}
        self.pages = {name: data.decode() for name, data in self.files.items()
                      if name.endswith(".html")}

    def tearDown(self):
        self.database.close()

    def of_filters(self):
        """Returns name and page of every filter."""
        for panel in os.listdir(PANELS):
            name, extension = os.path.splitext(panel)
            if extension == ".xml":
                yield name, self.pages[f"filters.{name}.html"]

    def test_every_filter_has_the_page_that_its_panel_opens(self):
        for name, page in self.of_filters():
            with open(os.path.join(PANELS, "Documentation", name + ".md"), encoding="utf-8") as file:
                title = file.readline().lstrip("# ").strip()
            self.assertIn(f"<h1>{title}</h1>", page)
            self.assertIn("<table", page)

    def test_the_equation_stands_before_the_properties(self):
        for name, page in self.of_filters():
            shown = re.findall("<pre><code>(.*?)</code></pre>", page[:page.index("<table")], re.S)
            with self.subTest(filter=name):
                self.assertTrue(shown)
                for line in "".join(shown).splitlines():
                    self.assertLess(len(line), 90)  # what ParaView's window of help is wide

    def test_links_and_pictures_are_there(self):
        count = 0
        for name, page in self.pages.items():
            for link in re.findall(r'(?:href|src)="([^"#]+)', page):
                if link.startswith("http"):
                    continue
                count += 1
                self.assertTrue(link in self.files, f"{name} leads to {link}")
        self.assertGreater(count, len(self.pages))

    def test_the_first_page_leads_to_all_others(self):
        for name in self.pages:
            if name != "index.html":
                self.assertIn(f'href="{name}"', self.pages["index.html"])


if __name__ == "__main__":
    if not os.path.exists(HELP):
        print("skipped: built without the tools for help pages")
        sys.exit(77)
    unittest.main()
