"""The package's page and the repository's README have the same ten lines."""

import re
from pathlib import Path


def test_both_readmes_have_the_same_ten_lines():
    package = Path(__file__).parents[1] / "README.md"
    pages = [package, package.parents[2] / "README.md"]
    one, other = (re.search(r"```python\n(.*?)```", page.read_text(), re.S).group(1) for page in pages)
    assert one == other
