import os
from pathlib import Path

import pytest

pytest_plugins = ["gsv.testing"]


@pytest.fixture
def examples():
    """Where examples/python lies."""
    return Path(os.environ["GSV_SOURCE_DIR"]) / "examples" / "python"
