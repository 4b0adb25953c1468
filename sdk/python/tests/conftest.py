import os
from pathlib import Path

import pytest

pytest_plugins = ["gsv.testing"]


@pytest.fixture
def examples():
    """Returns the folder examples/python."""
    return Path(os.environ["GSV_SOURCE_DIR"]) / "examples" / "python"
