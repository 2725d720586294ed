"""Files: design files in, grids and texts out. Units and notation live here and nowhere else."""

from ._design_file import json_schema as json_schema
from ._examples import example_files as example_files
from ._grid import FlankGrid as FlankGrid
from ._grid import grid_csv as grid_csv
from ._grid import grid_json as grid_json
from ._quantity import Kind as Kind
from ._quantity import QuantityError as QuantityError
from ._quantity import parse as parse
from ._read import parse_spec as parse_spec
from ._read import read_spec as read_spec
from ._write import write_text as write_text
