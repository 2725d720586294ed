"""Reading a design file; whatever is wrong with it comes out as one `DesignError`."""

from __future__ import annotations

import tomllib
from pathlib import Path

from hypoid.design import Spec
from hypoid.geometry import DesignError, Problem

from ._design_file import DesignFile
from ._problems import form_of, problems_of
from ._request_file import RequestFile
from ._request_of import request_of
from ._sheet_file import SummarySheetFile
from ._sheet_spec_of import sheet_spec_of
from ._spec_of import spec_of

_WANTED = "a design file: TOML text in UTF-8"
_EXAMPLE = "examples/gonzalez-fuentes-2022.toml (`hypoid examples --copy-to .` writes it)"


def read_spec(path: str | Path) -> Spec:
    """What a design file asks for, in mm and rad."""
    return parse_spec(_text(Path(path)), str(path))


def parse_spec(text: str, name: str = "design file") -> Spec:
    """What the text of a design file asks for; `name` is what messages call it."""
    try:
        document = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # line and column are in TOML's own message
        raise _unreadable(name, f"text that is not TOML ({error})") from None
    form = form_of(document)
    if isinstance(form, tuple):
        raise DesignError(form)
    if problems := problems_of(document, form):
        raise DesignError(problems)
    file = form.model.model_validate(document)
    if isinstance(file, SummarySheetFile):
        return sheet_spec_of(file)
    if isinstance(file, RequestFile):
        return request_of(file)
    assert isinstance(file, DesignFile)
    return spec_of(file)


def _text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig").replace("\r\n", "\n")
    except FileNotFoundError:
        raise _unreadable(str(path), "a path where no file is") from None
    except IsADirectoryError:
        raise _unreadable(str(path), "a folder") from None
    except UnicodeDecodeError as error:
        raise _unreadable(str(path), f"bytes that are not UTF-8, at byte {error.start}") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise _unreadable(str(path), f"a file that cannot be read ({reason})") from None


def _unreadable(name: str, given: str) -> DesignError:
    return DesignError([Problem(name, given, _WANTED, _EXAMPLE)])
