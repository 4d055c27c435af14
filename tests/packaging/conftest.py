"""The core installed, once a session for each kind of library."""

from pathlib import Path

import pytest
from packaging_kit import CORE, Prefix, configure, run


@pytest.fixture(scope="session")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Prefix:
    """The core installed from its own folder, 'static' or 'shared', and moved after that: packages are relocatable."""
    made: dict[str, Path] = {}

    def install(kind: str) -> Path:
        if kind not in made:
            folder = tmp_path_factory.mktemp(kind)
            configure(CORE, folder / "build", f"-DBUILD_SHARED_LIBS={'ON' if kind == 'shared' else 'OFF'}")
            run("cmake", "--build", folder / "build", "-j2")
            run("cmake", "--install", folder / "build", "--prefix", folder / "as_installed")
            made[kind] = (folder / "as_installed").rename(folder / "as_used")
        return made[kind]

    return install
