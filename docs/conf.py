"""Sphinx: MyST notebooks executed at every build, furo, nothing loaded from the network."""

from __future__ import annotations

import os
from importlib.metadata import version as installed_version
from pathlib import Path

project = "hypoid"
author = "the hypoid authors"
copyright = "the hypoid authors, Apache-2.0"
release = version = installed_version("hypoid")

extensions = ["myst_nb"]
exclude_patterns = ["_build", "jupyter_execute"]

myst_enable_extensions = ["amsmath", "deflist", "dollarmath"]
myst_heading_anchors = 3
# The pages' cells import cells.py, which stands beside this file.
search = [str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")]
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, search))
nb_execution_mode = "force"
nb_execution_in_temp = True
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_render_markdown_format = "myst"
nb_merge_streams = True

html_theme = "furo"
html_title = f"hypoid {release}"
html_static_path = ["_static"]
html_show_sphinx = False

# MathJax ships with the pages (_static/mathjax-LICENSE.txt says where it is from). Its menu could
# fetch speech and exploring tools from the network, so it is off.
mathjax_path = "mathjax-tex-svg.js"
mathjax3_config = {
    "options": {"enableMenu": False},
    # Extensions outside the one file are not there to be loaded: an unknown macro shows in red.
    "tex": {"packages": {"[-]": ["autoload", "require"]}},
}
