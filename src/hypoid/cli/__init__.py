"""The commands. Nothing that computes lives here, and nothing heavy is imported before it is used."""

from ._main import main as main
