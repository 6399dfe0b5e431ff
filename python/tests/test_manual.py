"""What the manual and the doc strings show runs as it stands there."""

import doctest
import re
from pathlib import Path

import pytest

import windlass

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "docs" / "python.md", ROOT / "python" / "README.md"]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_blocks_of_page_run_in_order(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(), re.DOTALL)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, page.name, "exec"), names)


def test_doc_string_of_solve_holds():
    finder, runner = doctest.DocTestFinder(), doctest.DocTestRunner()
    for test in finder.find(windlass.catenary.solve, globs={"solve": windlass.catenary.solve}):
        assert runner.run(test).failed == 0
