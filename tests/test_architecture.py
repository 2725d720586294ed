"""The house rules that a machine can see; the rooms themselves are import-linter's."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
CAP = 500

QUICK = {
    "import hypoid": "import hypoid",
    "import hypoid.blank": "import hypoid.blank",
    "hypoid blank": "from hypoid.cli import main; assert main(['blank', sys.argv[1]]) == 0",
    "hypoid examples": "from hypoid.cli import main; assert main(['examples']) == 0",
}


@pytest.mark.parametrize("path", SOURCES, ids=lambda p: str(p.relative_to(ROOT)))
def test_a_file_fits_in_the_head(path: Path) -> None:
    assert len(path.read_text(encoding="utf-8").splitlines()) <= CAP


@pytest.mark.parametrize("path", SOURCES, ids=lambda p: str(p.relative_to(ROOT)))
def test_a_module_is_private_or_a_room(path: Path) -> None:
    assert path.name.startswith("_")
    assert path.stem not in {"_utils", "_helpers", "_misc"}


@pytest.mark.parametrize("code", QUICK.values(), ids=QUICK.keys())
def test_starts_without_jax(code: str) -> None:
    example = ROOT / "examples" / "gonzalez-fuentes-2022.toml"
    watched = f"import sys; {code}; sys.exit('jax' in sys.modules)"
    result = subprocess.run(
        [sys.executable, "-c", watched, str(example)], capture_output=True, check=False
    )
    assert result.returncode == 0, result.stderr.decode()
