"""The commands. Nothing that computes lives here; what is heavy is imported when it is used."""

from ._main import main as main
